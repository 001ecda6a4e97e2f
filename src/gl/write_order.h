// SPDX-License-Identifier: Apache-2.0
// OpenGL orders all commands but one kind by itself: what shaders write to buffers and images is seen by
// later commands only behind a memory barrier (OpenGL 4.5, 7.13.2). These give each use the barrier that it
// needs, so that no pass has to think of it.
#pragma once

#include <array>
#include <cstdint>

#include "src/gl/gl.h"

namespace penumbra::gl {

/// Knows which passes wrote before which barrier; one a context.
class WriteOrder {
  public:
    /// A pass's number: later passes have larger ones.
    using Serial = std::uint64_t;

    Serial beginPass() { return ++newest_; }
    Serial newest() const { return newest_; }

    /// Those bits of `uses` (glMemoryBarrier's) by which pass `reader` would not see what pass `writer`
    /// wrote.
    GLbitfield missing(Serial writer, GLbitfield uses, Serial reader) const;

    /// Makes everything written before pass `reader` visible to `uses`.
    void makeVisible(GLbitfield uses, Serial reader);

    /// Makes everything written so far visible to every use, a host's too.
    void makeAllVisible();

  private:
    Serial newest_ = 0;
    std::array<Serial, 32> visible_{};  ///< by bit: what was written up to here is seen
};

/// Which pass wrote a buffer or texture last; kept with each.
struct WriteRecord {
    WriteOrder* order = nullptr;  ///< null: no shader has written
    WriteOrder::Serial writer = 0;

    /// Before a command that is no pass uses it.
    void makeVisible(GLbitfield uses) const;
};

}  // namespace penumbra::gl
