// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

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

enum class Compare : GLenum {
    always = GL_ALWAYS,
    less = GL_LESS,
    lessEqual = GL_LEQUAL,
    greater = GL_GREATER,
    greaterEqual = GL_GEQUAL,
    notEqual = GL_NOTEQUAL,
};
enum class Cull : GLenum { none = GL_NONE, front = GL_FRONT, back = GL_BACK };
/// Of what is drawn and what is there.
enum class Blend : GLenum {
    none = GL_NONE,
    sum = GL_FUNC_ADD,
    smallest = GL_MIN,
    largest = GL_MAX,
    product = GL_SRC_COLOR
};
enum class StencilOperation : GLenum {
    keep = GL_KEEP,
    zero = GL_ZERO,
    increment = GL_INCR_WRAP,
    decrement = GL_DECR_WRAP,
};

/// The stencil test compares with 0, over eight bits.
struct StencilState {
    Compare compare = Compare::always;
    struct Face {
        StencilOperation depthFails = StencilOperation::keep;
        StencilOperation passes = StencilOperation::keep;
        bool operator==(const Face&) const = default;
    };
    Face front, back;
    bool operator==(const StencilState&) const = default;
};

/// All the fixed-function state that a drawing pass depends on, stated whole: a pass inherits nothing.
/// Clip space is zero-to-one with the origin at the lower left throughout Penumbra.
struct RasterState {
    int width_px = 1;  ///< viewport, from (0, 0)
    int height_px = 1;
    Compare depthTest = Compare::always;  ///< `always` without depthWrite turns the test off
    bool depthWrite = false;
    bool depthClamp = false;
    Cull cull = Cull::none;  ///< counter-clockwise is front
    bool colorWrite = true;
    Blend blend = Blend::none;
    std::optional<StencilState> stencil;
    bool wireframe = false;
};

/// Makes `framebuffer` the one drawn to, with `state`.
void beginPass(GLuint framebuffer, const RasterState& state);

/// Changes the pass that was begun with `before` to `state`, which has the same viewport.
void changePass(const RasterState& before, const RasterState& state);

}  // namespace penumbra::gl
