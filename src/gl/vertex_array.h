// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/gl/gl.h"

namespace penumbra::gl {

inline void deleteVertexArray(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
using VertexArrayHandle = Handle<deleteVertexArray>;

inline VertexArrayHandle makeVertexArray() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArrayHandle(name);
}

}  // namespace penumbra::gl
