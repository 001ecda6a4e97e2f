// SPDX-License-Identifier: Apache-2.0
// Shared by C++ and GLSL: the fixed point of vertex normals, and the vertices of a smoothie.
#ifndef PENUMBRA_VERTEX_NORMALS_IO_H
#define PENUMBRA_VERTEX_NORMALS_IO_H

#ifdef __cplusplus
namespace penumbra {
#endif

const float vertexNormalScale = 1048576.0f;
const int verticesPerSmoothie = 18;  // a rectangle and two corners, two triangles each

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
