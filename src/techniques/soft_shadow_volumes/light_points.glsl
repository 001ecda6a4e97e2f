// SPDX-License-Identifier: Apache-2.0
// Points of the light (light_points.h).

// xy: place in unit space; z: rank from the centre; w: direction in turns, rising
layout(std430) readonly buffer Samples { vec4 samples[]; };
// What a textured light radiates around each of them.
layout(std430) readonly buffer Radiances { vec4 radiances[]; };
