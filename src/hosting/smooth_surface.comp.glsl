// SPDX-License-Identifier: Apache-2.0
#version 450
// Receivers on the smooth surface that shading normals tell of (smooth_surface.h).
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/hosting/smooth_surface_io.h"

uniform sampler2D depths;
uniform sampler2D normals;
uniform sampler2D shadingNormals;
uniform writeonly image2D smoothDepths;
uniform writeonly image2D smoothNormals;
layout(std140) uniform Constants {
    SmoothSurfaceConstants surface;
};

// A quarter of a degree: half floats tell no less. Flat faces keep their own normals and depths, bit by bit.
const float flatCosine = 0.99999;
// Towards outlines the line of sight grazes the surface. No receiver is moved further than ten times its
// height, nor by more of its distance than a hundredth, beyond which it would leave what it stands on.
const float leastCosine = 0.1;
const float greatestShare = 0.01;
// Where surfaces meet, at corners and along the edges of saddles, the facets beyond must not reach a receiver's horizon:
// half a pixel's width is not seen.
const float least_px = 0.5;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, surface.size_px))) return;
    float depth = texelFetch(depths, pixel, 0).r;
    vec3 normal = texelFetch(normals, pixel, 0).xyz;
    vec4 shading = texelFetch(shadingNormals, pixel, 0);
    float size = length(shading.xyz);
    bool isFlat = size == 0.0 || dot(normal, shading.xyz) > flatCosine * size;
    if (depth != surface.background && !isFlat) {
        normal = shading.xyz / size;
        vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(surface.size_px) - 1.0;
        vec4 stored = surface.viewFromDepth * vec4(ndc, depth, 1.0);
        vec3 posView = stored.xyz / stored.w;
        // Along the line of sight, so that it stays in its pixel.
        vec3 towardsEye = surface.isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-posView);
        float cosine = max(dot(mat3(surface.viewFromWorld) * normal, towardsEye), leastCosine);
        vec4 beside = surface.viewFromDepth * vec4(ndc + vec2(2.0 / float(surface.size_px.x), 0.0), depth, 1.0);
        float least = least_px * length(beside.xyz / beside.w - posView);
        float along = clamp(shading.w / cosine, least, max(least, greatestShare * length(posView)));
        vec4 moved = surface.depthFromView * vec4(posView + along * towardsEye, 1.0);
        depth = moved.z / moved.w;
    }
    imageStore(smoothDepths, pixel, vec4(depth));
    imageStore(smoothNormals, pixel, vec4(normal, 0.0));
}
