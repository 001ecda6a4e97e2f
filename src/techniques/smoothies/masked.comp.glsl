// SPDX-License-Identifier: Apache-2.0
#version 450
// Blockers with holes: their silhouettes are in a texture and not in a mesh, so they get no smoothies. They have a depth
// map of their own, which is filtered over the light's shadow of itself: a search for the blockers' mean nearness, then the
// share of the light that blockers there hide (after Fernando 2005, with the widths of smoothies.glsl). The lesser of this
// visibility and the other blockers' counts, as among smoothies. Variants: COLORED, for textured lights.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"
#include "src/techniques/smoothies/glances.glsl"

#ifdef COLORED
layout(rgba16f) uniform image2D visibility;
#else
layout(r32f) uniform image2D visibility;
#endif

const int taps = 48;

float visibilityAt(Receiver pixel) {
    Lookup l;
    if (!findCamera(pixel, l)) return 1.0;
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    if (receiver >= picture.nearestNearness) return 1.0;
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < taps; ++i) {
        Glance glance = glanceAt(l, i, picture.nearestNearness);
        if (glance.isHidden) sum += glance.nearness;
        if (glance.isHidden) count += 1.0;
    }
    if (count == 0.0) return 1.0;
    float mean = max(sum / count, receiver);
    float hidden = 0.0;
    for (int i = 0; i < taps; ++i) {
        if (glanceAt(l, i, mean).isHidden) hidden += 1.0;
    }
    return 1.0 - hidden / float(taps);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    if (!loadReceiver(pixel, receiver)) return;
    imageStore(visibility, pixel, min(imageLoad(visibility, pixel), visibilityAt(receiver)));
}
