// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "penumbra/caster.h"
#include "penumbra/view.h"
#include "src/device/device_internals.h"
#include "src/gl/framebuffer.h"
#include "src/gl/texture.h"

namespace penumbra {

/// How depths and casters are read: what a host has stated, or what it may have meant.
struct Reading {
    glm::dmat4 viewFromWorld{1}, clipFromView{1};
    std::vector<glm::dmat4> worldFromMesh;  ///< one a caster
    DepthConvention depth;
    bool isUpsideDown = false;  ///< the depths' rows
};

/// What the casters look like, row by row from the bottom.
struct CasterPicture {
    struct Pixel {
        float depth;     ///< as the host's texture would hold it
        float distance;  ///< clip-space w: metres from the eye, in perspective
        float caster;    ///< which; -1: none
        float unused;
    };
    int width_px = 0, height_px = 0;
    std::vector<Pixel> pixels;
    const Pixel& at(int x, int y) const {
        return pixels[std::size_t(y) * std::size_t(width_px) + std::size_t(x)];
    }
};

class CasterPainter {
  public:
    CasterPainter(Device::Internals& device, int width_px, int height_px);

    /// Into textures that are kept until the next call.
    void paint(std::span<const Caster> casters, const Reading& reading);
    const gl::Texture& pixels() const { return color_; }   ///< RGBA32F: CasterPicture::Pixel
    const gl::Texture& slopes() const { return slopes_; }  ///< RG32F: of that depth, a pixel to the right, up

    /// Paints, and reads back.
    CasterPicture draw(std::span<const Caster> casters, const Reading& reading);

  private:
    gl::Program program_;
    gl::Texture color_, slopes_, depth_;
    gl::Framebuffer framebuffer_;
};

}  // namespace penumbra
