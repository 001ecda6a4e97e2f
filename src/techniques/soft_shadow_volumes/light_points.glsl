// SPDX-License-Identifier: Apache-2.0
// Points of the light (light_points.h), and which of them lie beyond an edge.

// xy: place in unit space; z: rank from the centre; w: direction in turns, rising
layout(std430, binding = 4) readonly buffer Samples { vec4 samples[]; };
// What a textured light radiates around each of them.
layout(std430, binding = 5) readonly buffer Radiances { vec4 radiances[]; };

// Whether the way from the light's centre to `s` crosses the edge from `a` to `b`. What is asked of each end is asked in
// the same way of the other edges there, so that one of them is crossed and no more.
bool isCrossed(vec2 a, vec2 b, float turn, vec2 s) {
    bool isBetween = (a.x * s.y - a.y * s.x >= 0.0) != (b.x * s.y - b.y * s.x >= 0.0);
    float beyond = (b.x - a.x) * (s.y - a.y) - (b.y - a.y) * (s.x - a.x);
    return isBetween && beyond * turn < 0.0;
}
