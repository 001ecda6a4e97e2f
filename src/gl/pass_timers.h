// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <string_view>
#include <vector>

#include "src/gl/gl.h"

namespace penumbra::gl {

inline void deleteQuery(GLuint name) {
    glDeleteQueries(1, &name);
}

/// Device time of named passes, read some frames later so that nothing waits.
class PassTimers {
  public:
    /// A pass: a debug group and a pair of timestamps, from construction to destruction.
    class Scope {
      public:
        Scope(PassTimers& timers, std::string_view name);
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope();

      private:
        DebugGroup group_;
        GLuint end_;
    };

    /// `name` must be a literal: it is kept.
    Scope pass(std::string_view name) { return Scope(*this, name); }

    struct Result {
        std::string_view name;
        double milliseconds = 0;
    };
    /// The newest finished time of every pass, in the order in which the passes first ran.
    std::vector<Result> latest() const;

  private:
    static constexpr int framesInFlight = 4;
    struct Pair {
        Handle<deleteQuery> begin, end;
        bool pending = false;
    };
    struct Pass {
        std::string_view name;
        std::array<Pair, framesInFlight> ring;
        int next = 0;
        double milliseconds = 0;
    };
    static void collect(Pass& pass);
    Pass& find(std::string_view name);

    // latest() only moves finished results from the driver to us.
    mutable std::deque<Pass> passes_;
};

}  // namespace penumbra::gl
