// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "src/gl/gl.h"

namespace penumbra::gl {

/// What no pass of ours uses and each switches off, whatever a host has switched on.
inline constexpr std::array<GLenum, 22> unusedCapabilities = {GL_STENCIL_TEST,
                                                              GL_RASTERIZER_DISCARD,
                                                              GL_POLYGON_OFFSET_FILL,
                                                              GL_POLYGON_SMOOTH,
                                                              GL_COLOR_LOGIC_OP,
                                                              GL_PROGRAM_POINT_SIZE,
                                                              GL_DITHER,
                                                              GL_FRAMEBUFFER_SRGB,
                                                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                              GL_SAMPLE_ALPHA_TO_ONE,
                                                              GL_SAMPLE_COVERAGE,
                                                              GL_SAMPLE_MASK,
                                                              GL_PRIMITIVE_RESTART,
                                                              GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                                              GL_CLIP_DISTANCE0,
                                                              GL_CLIP_DISTANCE1,
                                                              GL_CLIP_DISTANCE2,
                                                              GL_CLIP_DISTANCE3,
                                                              GL_CLIP_DISTANCE4,
                                                              GL_CLIP_DISTANCE5,
                                                              GL_CLIP_DISTANCE6,
                                                              GL_CLIP_DISTANCE7};

/// All the fixed-function state that a drawing pass depends on, stated whole: a pass inherits nothing.
/// Clip space is zero-to-one with the origin at the lower left throughout Penumbra.
struct RasterState {
    int width_px = 1;  ///< viewport, from (0, 0)
    int height_px = 1;
    GLenum depthTest = GL_ALWAYS;  ///< comparison; GL_ALWAYS without depthWrite turns the test off
    bool depthWrite = false;
    bool depthClamp = false;
    GLenum cull = GL_NONE;  ///< GL_NONE, GL_FRONT or GL_BACK; counter-clockwise is front
    bool colorWrite = true;
    GLenum blendEquation = GL_NONE;  ///< GL_NONE: no blending; else GL_FUNC_ADD, GL_MIN, ...
    GLenum blendSource = GL_ONE;
    GLenum blendDestination = GL_ONE;
};

/// Makes `framebuffer` the one drawn to, with `state`.
void beginPass(GLuint framebuffer, const RasterState& state);

}  // namespace penumbra::gl
