// SPDX-License-Identifier: Apache-2.0
// What all lights of a frame ask of its receivers, tile by tile: made once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "penumbra/view.h"
#include "src/gl/buffer.h"
#include "src/gl/program.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/receiver_watch.h"

namespace penumbra::exact_visibility {

class ReceiverTiles {
  public:
    explicit ReceiverTiles(gl::ShaderLibrary& shaders);

    /// Takes in the receivers of a view, in axes whose origin lies at `originWorld`. `changed` is the
    /// revision in `watch` of what has changed since its last look; 0: it has not looked. Where it has for
    /// this call and the one before, other tiles stay.
    void look(const View& view, const ViewBinding& binding, const gl::ConstantBuffer<ExactFrame>& frame,
              const glm::dvec3& originWorld, const ReceiverWatch& watch, std::uint32_t changed);

    /// A TileBounds a tile.
    const gl::Buffer& bounds() const { return bounds_; }
    std::size_t size_bytes() const { return bounds_.size_bytes(); }

  private:
    gl::Program look_;
    gl::Buffer bounds_;
    // Of the last call.
    glm::dvec3 originWorld_{0};
    std::uint32_t changed_ = 0;
};

}  // namespace penumbra::exact_visibility
