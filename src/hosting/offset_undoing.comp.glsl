// SPDX-License-Identifier: Apache-2.0
#version 450
// Depths as they were before glPolygonOffset (offset_undoing.h). The offset is the same all over a triangle, so that
// differences between its pixels are its true slope; where triangles are smaller than a few pixels their normal tells it.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/hosting/offset_undoing_io.h"

uniform sampler2D depths;
uniform sampler2D normals;
uniform writeonly image2D undone;
layout(std140) uniform Constants { OffsetUndoingConstants offset; };

const float slopeRounding = 1e-4;

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

// Of the plane through what the pixel shows; steps of x and y are a pixel wide.
float slopeOfPlane(ivec2 pixel, float depth) {
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(offset.size_px) - 1.0;
    vec4 pos = offset.worldFromDepth * vec4(ndc, depth, 1.0);
    vec3 normal = texelFetch(normals, pixel, 0).xyz;
    vec4 plane = offset.depthPlaneFromWorld * vec4(normal, -dot(normal, pos.xyz / pos.w));
    vec2 slope = abs(plane.xy / (plane.z == 0.0 ? 1e-30 : plane.z)) * 2.0 / vec2(offset.size_px);
    return max(slope.x, slope.y);
}

// Of floats: one step of the last place of a number as large (section 14.6.5).
float stepOf(float depth) { return offset.leastDifference > 0.0 ? offset.leastDifference : exp2(floor(log2(max(depth, 1e-30))) - 23.0); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, offset.size_px))) return;
    float depth = depthAt(pixel);
    if (depth != offset.background) {
        float units = offset.units * stepOf(depth), slope, before = depth;
        if (offset.hasNormals) {
            // The offset has moved the plane, too, and with it its slope.
            for (int i = 0; i < 3; ++i) {
                slope = slopeOfPlane(pixel, before);
                before = depth - offset.factor * slope - units;
            }
        } else {
            slope = max(slopeAlong(ivec2(1, 0), pixel, depth), slopeAlong(ivec2(0, 1), pixel, depth));
            before = depth - offset.factor * slope - units;
        }
        // What rasterisers round in their slopes and offsets must not leave the surface behind itself.
        float away = offset.background == 1.0 ? 1.0 : -1.0;
        before -= away * (slopeRounding * abs(offset.factor) * slope + 2.0 * stepOf(depth));
        // Not onto the background, which is no surface.
        depth = offset.background == 1.0 ? min(before, 1.0 - exp2(-24.0)) : max(before, exp2(-126.0));
    }
    imageStore(undone, pixel, vec4(depth));
}
