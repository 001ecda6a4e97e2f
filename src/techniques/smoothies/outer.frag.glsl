// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 4 and equation 1: the smoothie's depth and its remapped alpha, of which minimum
// blending keeps the least. Alpha is stored as the visibility that it stands for.
#include "src/techniques/smoothies/smoothie_fragment.glsl"
#define INNER_UNIT 2
#include "src/techniques/smoothies/opposite.glsl"

layout(location = 0) out vec2 depthAndVisibility;

void main() {
    vec2 along = normalize(edge.zw - edge.xy);
    Fragment f = fragment(vec2(along.y, -along.x));
    float receiver;
    if (!findReceiver(ivec2(gl_FragCoord.xy), f.blocker, receiver)) discard;
    LightExtent extent = lightExtent(camera, f.place, f.normal);
    float width = smoothieWidth(camera, extent.half_m, f.blocker, receiver);
    float alpha = f.distance_ / width;
    if (alpha >= 1.0) discard;
    // With the inner half, this one spans the outer half of the penumbra; alone, it stands for all of it.
    bool hasInner = smoothies[camera].settings.w == 1;
    float seen = falloff(camera, hasInner ? alpha : 2.0 * alpha - 1.0, extent.spread);
    if (hasInner) {
        seen += oppositeVisibility(camera, f.place, f.closest, f.normal, width, receiver);
    }
    depthAndVisibility = vec2(isOrthographic(camera) ? -f.blocker : 1.0 / f.blocker, min(seen, 1.0));
}
