// SPDX-License-Identifier: Apache-2.0
#version 450
// Depths as they were before glPolygonOffset (offset_undoing.h). The offset is the same all over a triangle, so that
// differences between its pixels are its true slope; where triangles are smaller than a few pixels their normal tells it, or
// the caster that is seen there.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/hosting/offset_undoing_io.h"

uniform sampler2D depths;
uniform sampler2D normals;
uniform sampler2D casterPixels;
uniform sampler2D casterSlopes;
uniform writeonly image2D undone;
uniform writeonly image2D undoneNormals;  // where there are none
layout(std140) uniform Constants { OffsetUndoingConstants offset; };

const float slopeRounding = 1e-4;
// Depths that are in line differ from it by roundings, four of which may add up, and by no hundredth of a slope.
const float bendRoundings = 4.0;
const float leastBend = 0.01;
// From one facet of a round thing to the next slopes grow by less, but for those at its outline.
const float otherSurface = 4.0;

float depthAt(ivec2 pixel) { return texelFetch(depths, clamp(pixel, ivec2(0), offset.size_px - 1), 0).r; }

// Of floats: one step of the last place of a number as large (section 14.6.5).
float stepOf(float depth) { return offset.leastDifference > 0.0 ? offset.leastDifference : exp2(floor(log2(max(depth, 1e-30))) - 23.0); }

struct Slope {
    float own;    // of what the pixel shows, a pixel to the right or up
    float steep;  // the most that its triangle's may be
};

// Three pixels in line lie on the same triangle, most likely: two on either side with this one, or one on each. Where
// there are none the triangle is narrower, and between two others whose slopes its own lies between: the steeper one is
// taken, since what is lifted too little lies behind itself and is dark. But what is far steeper is another surface.
Slope slopeAlong(ivec2 axis, ivec2 pixel, float depth) {
    float before = depthAt(pixel - axis), after = depthAt(pixel + axis);
    float bendBefore = abs(2.0 * before - depthAt(pixel - 2 * axis) - depth);
    float bendAfter = abs(2.0 * after - depthAt(pixel + 2 * axis) - depth);
    float slopeBefore = depth - before, slopeAfter = after - depth;
    if (any(lessThan(pixel - axis, ivec2(0)))) return Slope(slopeAfter, abs(slopeAfter));
    if (any(greaterThanEqual(pixel + axis, offset.size_px))) return Slope(slopeBefore, abs(slopeBefore));
    float own = bendAfter < bendBefore ? slopeAfter : slopeBefore;
    float steep = max(abs(slopeBefore), abs(slopeAfter)), gentle = min(abs(slopeBefore), abs(slopeAfter));
    float bend = min(abs(before + after - 2.0 * depth), min(bendBefore, bendAfter));
    if (bend > bendRoundings * stepOf(depth) + leastBend * gentle) return Slope(own, min(steep, otherSurface * gentle));
    return Slope(own, abs(own));
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

// Whether a caster of these slopes is what the pixel shows, its depth being this one. Vertices lie on a grid of a 256th of a
// pixel, on which host and we may place them a step apart.
const float gridRounding_px = 3.0 / 256.0;
bool isCaster(ivec2 pixel, float depth, vec2 slopes) {
    vec4 caster = texelFetch(casterPixels, pixel, 0);
    if (caster.b < 0.0) return false;
    float slope = max(abs(slopes.x), abs(slopes.y));
    float expected = caster.r + offset.factor * slope + offset.units * stepOf(depth);
    float tolerance = gridRounding_px * (1.0 + abs(offset.factor)) * slope +
                      bendRoundings * (1.0 + abs(offset.factor)) * max(stepOf(depth), exp2(-23.0) * depth);
    return abs(depth - expected) <= tolerance;
}

// Towards the camera, of the plane with these slopes. The offset moves a triangle and does not turn it: slopes are the
// triangle's own before it, while after it is taken out neighbours differ by what was guessed of each.
vec3 normalOf(ivec2 pixel, float depth, vec2 slope) {
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(offset.size_px) - 1.0;
    vec2 gradient = slope * vec2(offset.size_px) / 2.0;
    vec3 away = (offset.worldPlaneFromDepth * vec4(-gradient, 1.0, dot(gradient, ndc) - depth)).xyz;
    return normalize(offset.background == 1.0 ? -away : away);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, offset.size_px))) return;
    float depth = depthAt(pixel);
    vec3 normal = vec3(0.0);
    if (depth != offset.background) {
        float units = offset.units * stepOf(depth), slope, before = depth;
        if (offset.hasNormals) {
            // The offset has moved the plane, too, and with it its slope.
            for (int i = 0; i < 3; ++i) {
                slope = slopeOfPlane(pixel, before);
                before = depth - offset.factor * slope - units;
            }
        } else {
            vec2 own = offset.hasCasters ? texelFetch(casterSlopes, pixel, 0).xy : vec2(0.0);
            slope = max(abs(own.x), abs(own.y));
            if (!offset.hasCasters || !isCaster(pixel, depth, own)) {
                Slope right = slopeAlong(ivec2(1, 0), pixel, depth), up = slopeAlong(ivec2(0, 1), pixel, depth);
                own = vec2(right.own, up.own);
                slope = max(right.steep, up.steep);
            }
            before = depth - offset.factor * slope - units;
            normal = normalOf(pixel, before, own);
        }
        // What rasterisers round in their slopes and offsets must not leave the surface behind itself.
        float away = offset.background == 1.0 ? 1.0 : -1.0;
        before -= away * (slopeRounding * abs(offset.factor) * slope + 2.0 * stepOf(depth));
        // Not onto the background, which is no surface.
        depth = offset.background == 1.0 ? min(before, 1.0 - exp2(-24.0)) : max(before, exp2(-126.0));
    }
    imageStore(undone, pixel, vec4(depth));
    if (!offset.hasNormals) imageStore(undoneNormals, pixel, vec4(normal, 0.0));
}
