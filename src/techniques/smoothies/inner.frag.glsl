// SPDX-License-Identifier: Apache-2.0
#version 450
// The half of the penumbra within the blocker, which the paper does without. What the receivers behind the blocker lie
// at is not known here, so the texel remembers the edge: the one whose penumbra, on the surface that shows beyond the
// edge, has its border deepest in the shadow, as told by the depth test.
#include "src/techniques/smoothies/smoothie_fragment.glsl"

layout(location = 0) out vec4 closestEdge;  // xy: the way to it, in texels; z: its nearness; w: 1

const float beyondTexels = 1.5;

void main() {
    vec2 along = normalize(edge.zw - edge.xy);
    Fragment f = fragment(vec2(-along.y, along.x));
    float texel = lightCameras[camera].depth.w;
    vec2 beyond = f.closest - beyondTexels * texel * f.normal;
    vec2 uvBeyond = (beyond - lightCameras[camera].window.xy) * lightCameras[camera].window.zw;
    float receiver;
    if (!findReceiver(ivec2(floor(uvBeyond * vec2(textureSize(depthMaps, 0).xy))), f.blocker, receiver)) discard;
    LightExtent extent = lightExtent(camera, f.place, f.normal);
    float depthInPenumbra = f.distance_ / smoothieWidth(camera, extent.half_m, f.blocker, receiver);
    closestEdge = vec4((f.closest - f.place) / texel, f.blocker, 1.0);
    gl_FragDepth = depthInPenumbra / (1.0 + depthInPenumbra);
}
