// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 4: of all smoothies over a texel minimum blending keeps the least alpha, remapped
// by equation 1 for the surface that the light sees. Here the depth test does, and what is kept is the edge: pixels work
// out visibility for their own receivers. The inner half, which the paper does without, is drawn likewise; what the
// receivers behind the blocker lie at is not known, and the surface that shows beyond the edge stands for them.
#include "src/techniques/smoothies/layers.glsl"
#include "src/techniques/smoothies/smoothies.glsl"
#include "src/techniques/smoothies/surfaces.glsl"

const int camera = 0;  // the block begins with the one that is drawn, since constant indices are read once for all

layout(location = 0) flat in uint edgeNumber;
layout(location = 1) flat in vec2 outward;
layout(location = 2) flat in int isInner;
layout(location = 3) in vec2 place;
layout(location = 4) in vec2 closest;
layout(location = 5) in float blocker;

layout(location = 0) out uint deepestEdge;

void main() {
    bool inner = isInner == 1;
    float towards = inner ? -1.0 : 1.0;
    float texel = smoothies[camera].camera.depth.texelSize;
    vec2 offset = towards * (place - closest);
    float distance_ = length(offset);
    vec2 normal = distance_ > 1e-3 * texel ? offset / distance_ : outward;
    bool across = dot(offset, outward) < 0.0 && distance_ < 1.5 * smoothieTexel_px * texel;
    if (across) normal = outward;

    // A blocker that hides the edge here (or, of the inner half, just beyond the edge) hides its penumbra.
    vec2 beyond = closest + max(inner ? 0.0 : distance_, beyondTexels * texel) * normal;
    ivec2 surface = texelOf(camera, beyond, textureSize(depthMaps, 0).x);
    float receiver = blockerNearness(camera, construction.drawnCamera, surface);
    if (receiver >= blocker) discard;
    float other = receiverNearness(camera, construction.drawnCamera, surface);
    if (other < blocker) receiver = max(receiver, other);

    // Across the edge (smoothie.geom.glsl, overlapTexels) it is better than none, no more, and the closest is the
    // best of those.
    float width = smoothieWidth(camera, lightExtent(camera, place, normal).half_m, blocker, receiver);
    float alpha = across ? 1.0 - 0.01 / (1.0 + distance_ / texel) : distance_ / width;
    if (!inner && alpha > 1.0) discard;
    deepestEdge = edgeNumber;
    gl_FragDepth = alpha / (1.0 + alpha);
}
