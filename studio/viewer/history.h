// SPDX-License-Identifier: Apache-2.0
// Undo and redo by whole states: whatever has changed is undone, whoever changed it.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace penumbra::studio::viewer {

/// Of states that can be copied and compared.
template <typename State>
class History {
  public:
    /// Forgets everything; `now` is where undo ends.
    void start(State now) {
        states_ = {std::move(now)};
        at_ = 0;
    }

    /// To be told between the user's doings, not within a drag, how things are: what differs is a step.
    void note(State now) {
        if (states_.empty()) return start(std::move(now));
        if (now == states_[at_]) return;
        states_.resize(at_ + 1, states_[at_]);
        states_.push_back(std::move(now));
        if (states_.size() > most) states_.erase(states_.begin());
        at_ = states_.size() - 1;
    }

    bool canUndo() const { return at_ > 0; }
    bool canRedo() const { return at_ + 1 < states_.size(); }
    const State& undo() { return states_[--at_]; }  ///< canUndo()
    const State& redo() { return states_[++at_]; }  ///< canRedo()

  private:
    static constexpr std::size_t most = 500;
    std::vector<State> states_;
    std::size_t at_ = 0;  ///< the state that holds
};

}  // namespace penumbra::studio::viewer
