// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 4, and passes 2 and 3 of section 4: a texel keeps the least alpha of all smoothies
// over it, remapped by equation 1 for the surface that the light sees there, and the depth of the nearest. Minimum blending
// does both at once.
#include "src/techniques/smoothies/smoothies.glsl"
#include "src/techniques/smoothies/surfaces.glsl"

const int camera = 0;  // the block begins with the one that is drawn, since constant indices are read once for all

layout(location = 0) flat in uint edgeNumber;
layout(location = 1) flat in vec2 outward;
layout(location = 2) flat in int isInner;
layout(location = 3) in vec2 place;
layout(location = 4) in vec2 closest;
layout(location = 5) in float blocker;

layout(location = 0) out vec2 alphaAndDepth_m;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float receiver = blockerNearness(camera, construction.drawnCamera, texel);
    if (receiver >= blocker) discard;  // it lies behind a blocker
    float other = receiverNearness(camera, construction.drawnCamera, texel);
    if (other < blocker) receiver = max(receiver, other);

    vec2 offset = place - closest;
    float distance_ = length(offset);
    vec2 normal = distance_ > 1e-3 * smoothies[camera].camera.depth.texelSize ? offset / distance_ : outward;
    float width = smoothieWidth(camera, lightExtent(camera, place, normal).half_m, blocker, receiver);
    float alpha = dot(offset, outward) < 0.0 ? 0.0 : min(distance_ / width, 1.0);
    alphaAndDepth_m = vec2(alpha, isOrthographic(camera) ? -blocker : 1.0 / blocker);
}
