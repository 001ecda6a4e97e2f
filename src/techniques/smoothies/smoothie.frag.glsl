// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 4: of all smoothies over a texel minimum blending keeps the least alpha, remapped
// by equation 1 for the surface that the light sees. Here the depth test does, and what is kept is the edge: pixels work
// out visibility for their own receivers. The inner half, which the paper does without, is drawn likewise; what the
// receivers behind the blocker lie at is not known, and the surface that shows beyond the edge stands for them.
#include "src/techniques/smoothies/layers.glsl"
#include "src/techniques/smoothies/smoothies.glsl"
#include "src/techniques/smoothies/surfaces.glsl"

layout(location = 1) uniform int camera;
layout(location = 2) uniform int layer;

layout(location = 0) flat in uint edgeNumber;
layout(location = 1) flat in vec2 outward;
layout(location = 2) in vec2 place;
layout(location = 3) in vec2 closest;
layout(location = 4) in float blocker;

layout(location = 0) out uint deepestEdge;

const float beyondTexels = 1.5;

void main() {
    float texel = smoothies[camera].camera.depth.w;
    vec2 offset = place - closest;
    float distance_ = length(offset);
    bool inner = layer != layerOuter;
    vec2 normal = distance_ > 1e-3 * texel ? (inner ? -offset : offset) / distance_ : outward;

    // A blocker that hides the edge here (or, of the inner half, just beyond the edge) hides its penumbra.
    ivec2 surface = inner ? texelOf(camera, closest + beyondTexels * texel * normal, textureSize(depthMaps, 0).x)
                          : ivec2(gl_FragCoord.xy);
    float receiver = blockerNearness(camera, surface);
    if (receiver >= blocker) discard;
    float other = receiverNearness(camera, surface);
    if (other < blocker) receiver = max(receiver, other);

    float alpha = distance_ / smoothieWidth(camera, lightExtent(camera, place, normal).half_m, blocker, receiver);
    if (!inner && alpha >= 1.0) discard;
    deepestEdge = edgeNumber;
    gl_FragDepth = alpha / (1.0 + alpha);
}
