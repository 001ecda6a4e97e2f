// SPDX-License-Identifier: Apache-2.0
#version 450
// A textured light: which part of each channel's radiance lies on one side of a line across the picture, for lines of all
// directions (one a workgroup) and offsets (one an invocation). See light_profile.glsl.
layout(local_size_x = 64) in;

#include "src/techniques/smoothies/smoothies_io.h"

uniform sampler2D radiance;
layout(rgba32f) uniform writeonly image2D profile;

const int cellsAcross = 16;  // of the light; the mean radiance of each counts
const int taps = 8;          // across a cell

shared vec3 cells[cellsAcross * cellsAcross];

vec3 meanRadiance(ivec2 cell) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < taps * taps; ++i) {
        vec2 uv = (vec2(cell) + (vec2(i % taps, i / taps) + 0.5) / float(taps)) / float(cellsAcross);
        sum += max(textureLod(radiance, uv, 0.0).rgb, 0.0);
    }
    return sum / float(taps * taps);
}

void main() {
    int lane = int(gl_LocalInvocationIndex);
    for (int i = lane; i < cellsAcross * cellsAcross; i += 64) {
        cells[i] = meanRadiance(ivec2(i % cellsAcross, i / cellsAcross));
    }
    barrier();

    // The direction that the column stands for, |x| + |y| = 1.
    float turn = 4.0 * float(gl_WorkGroupID.x) / float(profileDirections);
    vec2 along = vec2(turn < 2.0 ? 1.0 - turn : turn - 3.0, turn < 2.0 ? 1.0 - abs(1.0 - turn) : abs(turn - 3.0) - 1.0);
    float offset = 2.0 * float(lane) / float(profileOffsets - 1) - 1.0;
    vec3 total = vec3(0.0), part = vec3(0.0);
    float area = 0.0;
    for (int i = 0; i < cellsAcross * cellsAcross; ++i) {
        vec2 place = 2.0 * (vec2(i % cellsAcross, i / cellsAcross) + 0.5) / float(cellsAcross) - 1.0;
        // A cell is a box across the line, 2 / cellsAcross wide.
        float share = clamp(0.5 + 0.5 * float(cellsAcross) * (dot(place, along) + offset), 0.0, 1.0);
        total += cells[i];
        part += share * cells[i];
        area += share;
    }
    // A channel that is black has no parts; its area stands for it.
    for (int i = 0; i < 3; ++i) part[i] = total[i] > 0.0 ? part[i] / total[i] : area / float(cellsAcross * cellsAcross);
    imageStore(profile, ivec2(gl_WorkGroupID.x, lane), vec4(part, 1.0));
}
