// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "src/gl/gl.h"

namespace penumbra::gl {

struct TextureTarget {
    GLenum target, binding;
};

/// All that a texture unit can hold, each with what tells which texture it holds.
inline constexpr std::array<TextureTarget, 11> textureTargets = {{
    {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    {GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
    {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
}};

/// What kind of texture `texture` is: GL_TEXTURE_2D, ...; GL_NONE where the name is no texture's. Leaves
/// texture unit 0 the active one, with nothing bound to it.
GLenum targetOf(GLuint texture);

}  // namespace penumbra::gl
