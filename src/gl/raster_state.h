// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/gl/gl.h"

namespace penumbra::gl {

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
