// SPDX-License-Identifier: Apache-2.0
// Whether a picture can be drawn again more finely in the time that there is.
#pragma once

#include <algorithm>

namespace penumbra::studio::viewer {

/// A first drawing takes longer than those after it by all that has to be compiled: what seems too dear is
/// measured again, so that compiling, of which there is no second time, does not count.
class RefiningCost {
  public:
    /// A picture has been drawn that way. Forgets what was known of the one before.
    void drawn(double milliseconds) {
        least_ms_ = milliseconds;
        probes_ = 0;
    }

    /// Whether `times` as many samples take at most `budget_ms`. `probe(n)` draws the picture for the n-th
    /// time once more, and tells how long that took; at most twice for a picture.
    template <typename Probe>
    bool isWithin(double budget_ms, double times, const Probe& probe) {
        while (times * least_ms_ > budget_ms && probes_ < mostProbes && budget_ms > 0) {
            ++probes_;
            least_ms_ = std::min(least_ms_, double(probe(probes_)));
        }
        return times * least_ms_ <= budget_ms;
    }

  private:
    static constexpr int mostProbes = 2;
    double least_ms_ = 0;
    int probes_ = 0;
};

}  // namespace penumbra::studio::viewer
