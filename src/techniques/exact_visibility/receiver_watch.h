// SPDX-License-Identifier: Apache-2.0
// What in the host's picture has changed, tile by tile, found on the device: hosts draw into the same
// textures from frame to frame, and nobody says what there is another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "penumbra/view.h"
#include "src/gl/buffer.h"
#include "src/gl/program.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra::exact_visibility {

class ReceiverWatch {
  public:
    explicit ReceiverWatch(gl::ShaderLibrary& shaders);

    /// Takes in the view of a frame, and makes room. False where the camera, or the kind of its textures, is
    /// another than in the last frame, so that nothing can be as it was.
    bool follow(const View& view);

    /// Compares what pixels are with what they were at the last look, and keeps it. `serial`, larger from
    /// look to look, becomes the revision of each tile in which a pixel changed, or one whose depth tells a
    /// normal there.
    void look(const View& view, const ViewBinding& binding, std::uint32_t serial);

    /// One a tile of 8 x 8 pixels; 0 where none has changed since the camera was another.
    const gl::Buffer& tileRevisions() const { return tileRevisions_; }
    std::size_t size_bytes() const { return seen_.size_bytes() + tileRevisions_.size_bytes(); }

  private:
    gl::Program compare_;
    std::vector<std::byte> view_, lastView_;
    gl::Buffer seen_, tileRevisions_;
};

}  // namespace penumbra::exact_visibility
