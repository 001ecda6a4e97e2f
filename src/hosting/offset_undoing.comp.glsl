// SPDX-License-Identifier: Apache-2.0
#version 450
// Depths as they were before glPolygonOffset (offset_undoing.h). The offset is the same all over a triangle, so that
// differences between its pixels are its true slope.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/hosting/offset_undoing_io.h"

uniform sampler2D depths;
uniform writeonly image2D undone;
layout(std140) uniform Constants { OffsetUndoingConstants offset; };

float depthAt(ivec2 pixel) { return texelFetch(depths, clamp(pixel, ivec2(0), offset.size_px - 1), 0).r; }

// On the side whose next two pixels lie in line with this one: the same triangle, most likely.
float slopeAlong(ivec2 axis, ivec2 pixel, float depth) {
    float before = depthAt(pixel - axis), after = depthAt(pixel + axis);
    float bendBefore = abs(2.0 * before - depthAt(pixel - 2 * axis) - depth);
    float bendAfter = abs(2.0 * after - depthAt(pixel + 2 * axis) - depth);
    bool isFirst = any(lessThan(pixel - axis, ivec2(0)));
    bool isLast = any(greaterThanEqual(pixel + axis, offset.size_px));
    return abs(isFirst || (!isLast && bendAfter < bendBefore) ? after - depth : depth - before);
}

// Of floats: one step of the last place of a number as large (section 14.6.5).
float stepOf(float depth) { return offset.leastDifference > 0.0 ? offset.leastDifference : exp2(floor(log2(max(depth, 1e-30))) - 23.0); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, offset.size_px))) return;
    float depth = depthAt(pixel);
    if (depth != offset.background) {
        float slope = max(slopeAlong(ivec2(1, 0), pixel, depth), slopeAlong(ivec2(0, 1), pixel, depth));
        float before = depth - offset.factor * slope - offset.units * stepOf(depth);
        // Not onto the background, which is no surface.
        depth = offset.background == 1.0 ? min(before, 1.0 - exp2(-24.0)) : max(before, exp2(-126.0));
    }
    imageStore(undone, pixel, vec4(depth));
}
