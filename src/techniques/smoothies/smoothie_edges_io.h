// SPDX-License-Identifier: Apache-2.0
// What the passes that build smoothies share; one struct for C++ and GLSL (std430).
#ifndef PENUMBRA_SMOOTHIE_EDGES_IO_H
#define PENUMBRA_SMOOTHIE_EDGES_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra::smoothies {
using glm::vec2;
using glm::vec4;
#endif

const float vertexNormalScale = 1048576.0f;  // fixed point
const int tilesAcross = 32;                  // the map of the farthest surfaces

// A silhouette edge as a light camera sees it, clipped to what its smoothie may reach.
struct SmoothieEdge {
    vec4 ends;      // in the window, the blocker to the left
    vec4 normals;   // of the vertices at both ends, outward, unit length
    vec2 nearness;  // at both ends
    vec2 widths;    // at both ends; 0: nothing is drawn
};

#ifdef __cplusplus
static_assert(sizeof(SmoothieEdge) == 48);
}  // namespace penumbra::smoothies
#endif
#endif
