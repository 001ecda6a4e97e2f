// SPDX-License-Identifier: Apache-2.0
// Where the numbers of edges are kept: for each texel of a light camera the edge in whose penumbra's outer half the texel
// lies deepest, and the same for the inner half, there once for each third of all directions that an edge may face. Light
// comes past a thin blocker on two sides, past the tip of one on three; edges that face away from each other by more than
// 120 degrees are never in the same layer.
const int layerOuter = 0, firstInnerLayer = 1, innerLayers = 3;
const uint noEdge = 0xffffffffu;

// Turned by 22 degrees, so that the borders of the thirds are not where edges of boxes lie.
const vec2 thirds[innerLayers] = {vec2(0.9272, 0.3746), vec2(-0.7880, 0.6157), vec2(-0.1392, -0.9903)};

int innerLayer(vec2 outward) {
    vec3 along = vec3(dot(outward, thirds[0]), dot(outward, thirds[1]), dot(outward, thirds[2]));
    int third = along.x >= along.y && along.x >= along.z ? 0 : (along.y >= along.z ? 1 : 2);
    return firstInnerLayer + third;
}

// Where to look for what an edge does not hide, in texels of the depth map past it.
const float beyondTexels = 1.5;
