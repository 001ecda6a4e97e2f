// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "penumbra/math.h"

namespace penumbra {

/// How the values in a depth texture map to clip space. Stated by the host, never guessed.
struct DepthConvention {
    enum class Range {
        zeroToOne,      ///< clip-space z/w in [0, 1], stored as it is (glClipControl with GL_ZERO_TO_ONE)
        minusOneToOne,  ///< clip-space z/w in [-1, 1], stored as 0.5 * z/w + 0.5 (OpenGL's default)
    };
    Range range = Range::zeroToOne;
    /// True: larger is nearer and 0 is background. False: smaller is nearer and 1 is background. Whether the
    /// far plane is finite or infinite follows from `View::clipFromView` and need not be said.
    bool reversed = true;
};

/// `glPolygonOffset(factor, units)`, as it was set, and on, while a host's depths were drawn: many CAD hosts
/// have (1, 1) for ever, so that lines on surfaces are seen. Both 0: none.
struct PolygonOffset {
    float factor = 0, units = 0;
    bool operator==(const PolygonOffset&) const = default;
};

/// The receivers: what the host's camera sees, one surface point a pixel.
struct View {
    int width_px = 0;   ///< of the picture, >= 1
    int height_px = 0;  ///< >= 1

    /// Lower left corner of the picture in every texture below, for hosts that draw into a part of them.
    int x_px = 0, y_px = 0;

    /// Which sample of multisampled textures is looked at. Visibility is that of the surface at the sample's
    /// place; a host that shades every sample calls once for each.
    int sample = 0;

    /// Where in the pixel that sample lies, from the pixel's lower left corner, in [0, 1]. None: where OpenGL
    /// says of the texture. To be stated where the samples were copied out of a window's framebuffer, whose
    /// places Mesa mirrors: there it is (x, 1 - y) of what GL_SAMPLE_POSITION says of the texture.
    std::optional<Vec2> samplePlace{};

    Mat4 viewFromWorld{};  ///< rigid: rotation and translation only
    Mat4 clipFromView{};   ///< perspective or orthographic, finite or infinite; must be invertible

    /// GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE, borrowed, with a depth or depth-stencil format, or a float
    /// format whose red channel holds such depths. Its sampling parameters do not matter.
    std::uint32_t depthTexture = 0;
    DepthConvention depth{};
    PolygonOffset polygonOffset{};  ///< is taken out of the depths again

    /// As the depth texture, single- or multisampled, borrowed, optional (0: normals are derived from the
    /// depth). RGB is the *geometric* world-space normal of the surface, unit length, on the side that the
    /// camera sees. Interpolated shading normals make surfaces shadow themselves near the terminator.
    std::uint32_t normalTexture = 0;

    /// As the depth texture, single- or multisampled, borrowed, optional (0: shadows are those of the
    /// facets). For coarse meshes that are shaded smoothly, whose own shadow is a zigzag along the
    /// terminator: what receives is then the smooth surface that the normals tell of, and its horizon counts.
    /// RGB is the interpolated normal of the triangle's corners (no normal map), world space, of any length,
    /// on the side of the geometric one; alpha is how far above the triangle, along that normal and in
    /// metres, the smooth surface lies: depth.md has the lines of a shader for it. (0, 0, 0): not smooth.
    /// Where it is the geometric normal nothing changes; so normalTexture must be there, too.
    std::uint32_t shadingNormalTexture = 0;

    /// As the depth texture, single- or multisampled, borrowed, optional (0: everything receives). A pixel
    /// whose red channel is below 0.5 belongs to a surface that receives no shadow: its visibility is 1.
    std::uint32_t receiverTexture = 0;

    /// True: there is no picture and no camera. Each pixel is a point that the host has chosen, such as a
    /// plan's grid or a lightmap's texels. The depth texture is then a GL_RGBA32F of the view's size whose
    /// red channel is 1 where there is a point and 0 where there is none, and whose green, blue and alpha
    /// channels are its position in world space; normalTexture must be there; matrices, depth convention and
    /// polygon offset are not looked at. `Points` makes such a view. Points that lie near each other should
    /// lie near each other in the texture, within 8 x 8 pixels: it costs less. For techniques that can answer
    /// without a picture (Technique::answersAtPoints).
    bool isOfPoints = false;
};

}  // namespace penumbra
