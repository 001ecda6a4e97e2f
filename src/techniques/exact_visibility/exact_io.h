// SPDX-License-Identifier: Apache-2.0
// What the shaders are told; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_EXACT_IO_H
#define PENUMBRA_EXACT_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::ivec4;
using glm::uvec4;
using glm::vec4;
#endif

// Nodes of the tree: what stands in the fourth words.
#define EXACT_END 0xffffffffu      // skip: the tree, or a caster's subtree, ends here
#define EXACT_INNER 0xffffffffu    // leaf: none; the first child is the next node
#define EXACT_SUBTREE 0x80000000u  // leaf: a caster's subtree begins at the node in the other bits
#define EXACT_MASKED 0x40000000u   // leaf: the triangle in the other bits has holes

// Shapes of lights.
#define EXACT_RECT 0
#define EXACT_DISK 1
#define EXACT_SPHERE 2
#define EXACT_DISTANT 3

#define EXACT_MAX_ROWS 24     // of a lattice, and bits in a row
#define EXACT_MAX_LATTICES 4  // what more than 256 samples are split into

#define EXACT_GROUP_TEXTURES 8  // alpha textures that are bound at a time

#define EXACT_STATE_WORDS 13  // of a receiver whose work is not done, before the rows

struct ExactLight {
    vec4 center;   // scene space; w: shape
    vec4 axisX;    // scene space, unit; w: half of the width (flat), radius (sphere), tan of the half angle
                   // (distant)
    vec4 axisY;    // w: half of the height (flat), cosine of the half angle (distant)
    vec4 axisZ;    // light is emitted along -Z; w: 1 if along +Z too
    vec4 boxMin;   // of the light in scene space (flat, sphere), of unit vectors towards it (distant); w: 1
                   // for a point
    vec4 boxMax;   // w: 1 if weighted by irradiance
    vec4 eye;      // scene space; w: 1 if a texture weights the samples
    vec4 sight;    // of the point (x, y, z, 1), its dot product is clip-space w: the distance along the view
    vec4 lattice;  // lattice from uv, columns: a 2 x 2 matrix
    vec4 uvFromLattice;                // its inverse
    ivec4 counts;                      // x: lattices; y: tiles in a row; z: candidates a tile; w: nodes
    vec4 offsets[EXACT_MAX_LATTICES];  // xy: where uv = 0 lies in lattice coordinates
    uvec4 valid[EXACT_MAX_LATTICES * EXACT_MAX_ROWS / 4];  // bit i of row j: (i, j) is a sample
};

#ifdef __cplusplus
static_assert(sizeof(ExactLight) == 16 * (11 + EXACT_MAX_LATTICES + EXACT_MAX_LATTICES * EXACT_MAX_ROWS / 4));
}  // namespace penumbra
#endif
#endif
