// SPDX-License-Identifier: Apache-2.0
#version 450
// The half of the penumbra within the blocker, which the paper does without. What the receivers behind the blocker lie
// at is not known here, so the texel remembers the edge: the one whose penumbra, on the surface that shows beyond the
// edge, has its border deepest in the shadow, as told by the depth test.
#include "src/techniques/smoothies/smoothie_fragment.glsl"

layout(location = 0) out vec4 closestEdge;  // xy: the way to it, in the window; z: its nearness; w: 1

const float beyondTexels = 1.5;

void main() {
    vec2 along = normalize(edge.zw - edge.xy);
    Fragment f = fragment(vec2(-along.y, along.x));
    vec2 beyond = f.closest - beyondTexels * lightCameras[camera].depth.w * f.normal;
    float receiver;
    if (!findReceiver(texelOf(camera, beyond, textureSize(depthMaps, 0).x), f.blocker, receiver)) discard;
    LightExtent extent = lightExtent(camera, f.place, f.normal);
    float depthInPenumbra = f.distance_ / smoothieWidth(camera, extent.half_m, f.blocker, receiver);
    closestEdge = vec4(f.closest - f.place, f.blocker, 1.0);
    gl_FragDepth = depthInPenumbra / (1.0 + depthInPenumbra);
}
