// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "src/gl/gl.h"
#include "src/gl/pass_timers.h"

namespace penumbra::gl {

/// An occlusion query: how many samples the draws between begin() and end() pass. OpenGL has room for one
/// such query at a time, the host's included.
class SampleQuery {
  public:
    SampleQuery() {
        GLuint name = 0;
        glCreateQueries(GL_SAMPLES_PASSED, 1, &name);
        query_ = Handle<deleteQuery>(name);
    }

    void begin() { glBeginQuery(GL_SAMPLES_PASSED, query_.name()); }
    void end() { glEndQuery(GL_SAMPLES_PASSED); }
    /// Waits for the device.
    std::uint64_t passed() const {
        GLuint64 samples = 0;
        glGetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &samples);
        return samples;
    }
    /// Whether another query, which can only be the host's, is under way.
    static bool isTaken() {
        GLint current = 0;
        glGetQueryiv(GL_SAMPLES_PASSED, GL_CURRENT_QUERY, &current);
        return current != 0;
    }

  private:
    Handle<deleteQuery> query_;
};

}  // namespace penumbra::gl
