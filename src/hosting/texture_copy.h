// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "src/device/device_internals.h"
#include "src/gl/texture.h"

namespace penumbra {

/// Copies rectangles between textures that may differ in format and number of samples, which
/// glCopyImageSubData cannot.
class TextureCopy {
  public:
    explicit TextureCopy(Device::Internals& device);

    struct Source {
        gl::TextureRef texture;
        glm::ivec2 corner_px{0};
        bool multisampled = false;
        int sample = 0;
        bool isGray = false;  ///< red is all its colours
    };
    struct Target {
        gl::TextureRef texture;  ///< its record says that it was written
        glm::ivec2 corner_px{0};
    };
    void run(const Source& source, const Target& target, const glm::ivec2& size_px) const;

  private:
    gl::Program plain_, multisampled_;
};

}  // namespace penumbra
