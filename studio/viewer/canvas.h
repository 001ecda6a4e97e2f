// SPDX-License-Identifier: Apache-2.0
// What is shown of the frame: a picture, two with a line between them, or numbers as colours.
#pragma once

#include <glm/glm.hpp>

#include "src/gl/buffer.h"
#include "src/gl/program.h"
#include "studio/metrics/false_color.h"
#include "studio/viewer/sides.h"

namespace penumbra::studio::viewer {

/// Numbered as in canvas_io.h.
enum class Shown {
    picture,
    difference,   ///< of one light's visibility, A - B: red where A is lighter
    error,        ///< its amount
    visibility,   ///< of one light
    illuminance,  ///< lux of all lights
};

struct CanvasOptions {
    Shown shown = Shown::picture;
    ValueRange range;  ///< of the false colours; of a difference its end alone counts
    bool logarithmic = false;
    bool isolines = true;
    int firstColumnOfB = 1 << 20;  ///< pixels from here on show side B
    std::size_t light = 0;         ///< whose visibility is meant
};

class Canvas {
  public:
    explicit Canvas(gl::ShaderLibrary& shaders);

    /// `b` may be the same as `a`.
    void compose(const FrameRenderer& frame, const Side& a, const Side& b, const CanvasOptions& options);
    /// One layer of a texture, from its `black` to its `white`, or stretched from the least to the largest
    /// number in it: reversed depth without a far plane lies all near 0.
    void inspect(const InspectedTexture& texture, int layer, bool stretched);
    /// What the surface point at `posWorld` sees of the light: `frame` was drawn from there.
    void lookAtLight(const FrameRenderer& frame, const AreaLight& light, const glm::dmat4& worldFromLight);

    const gl::Texture& texture() const { return texture_; }
    /// Of the illuminance composed last: the level (lux) of the line that runs through a pixel, or noIsoline;
    /// R32F.
    const gl::Texture& isolines() const { return isolines_; }

  private:
    void resize(int width_px, int height_px);

    std::shared_ptr<gl::WriteOrder> order_;
    gl::Program compose_, inspect_, inspectLayer_, inspectRange_, inspectLayerRange_, lightView_;
    gl::Buffer inspectedRange_;
    gl::Texture orderedMap_, divergingMap_, nothing_;
    gl::Texture texture_, isolines_;
};

}  // namespace penumbra::studio::viewer
