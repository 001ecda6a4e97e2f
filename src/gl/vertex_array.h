// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/gl/gl.h"

namespace penumbra::gl {

inline void deleteVertexArray(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
using VertexArrayHandle = Handle<deleteVertexArray>;

/// A vertex array whose attribute i, read from binding i, has `componentCounts[i]` floats.
template <typename... Counts>
VertexArrayHandle makeFloatVertexArray(Counts... componentCounts) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    GLuint attribute = 0;
    [[maybe_unused]] const auto add = [&](int components) {
        glVertexArrayAttribFormat(name, attribute, components, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(name, attribute, attribute);
        ++attribute;
    };
    (add(componentCounts), ...);
    return VertexArrayHandle(name);
}

/// Attribute `attribute` reads tightly packed floats from `buffer`; switched off where that is 0.
inline void attachFloats(GLuint vertexArray, GLuint attribute, GLuint buffer, int components) {
    if (buffer == 0) {
        glDisableVertexArrayAttrib(vertexArray, attribute);
        return;
    }
    glEnableVertexArrayAttrib(vertexArray, attribute);
    glVertexArrayVertexBuffer(vertexArray, attribute, buffer, 0, components * GLsizei(sizeof(GLfloat)));
}

}  // namespace penumbra::gl
