// SPDX-License-Identifier: Apache-2.0
// A filter where bands would show: where the shadows of neighbouring samples lie more than `widest_px` apart, a sample is
// asked for its cell of the light instead of its point. The kernel is what the cell's points would see of the blockers:
// it is as wide as the shadows are apart, so that they meet without a step and nothing is blurred further. How high the
// blockers are, the samples in shadow know.
layout(location = 17) uniform int taps;         // of the kernel, a power of two
layout(location = 18) uniform float widest_px;  // distance between shadows that needs no filter

struct Bands {
    float nearness;   // of the blockers, see blockerNearness; 0: no blocker
    float perSpan_px; // distance in pixels of shadows of points one metre apart on the light, or one radian
};

Bands findBands(Comparison comparison, Receiver receiver, Lookup lookup, ivec2 pixel) {
    float sum = 0.0;
    int blocked = 0;
    for (int word = 0; word < 3; ++word) {
        for (uint rest = comparison.border[word] & comparison.shadows[word]; rest != 0u; rest &= rest - 1u) {
            int slot = subdivision.slotOfVertex[vertexOf(word, findLSB(rest))];
            sum += max(blockerNearness(layerOf(slot), lookup), 0.0);
            ++blocked;
        }
    }
    if (blocked == 0) return Bands(0.0, 0.0);
    float nearness = sum / float(blocked);
    vec3 beside = positionLight(vec2(pixel) + vec2(1.0, 0.0), texelFetch(viewDepth, pixel, 0).r);
    float pixel_m = distance(receiver.posLight, beside);
#ifdef DISTANT
    float perSpan_m = nearness;
#else
    float perSpan_m = nearness * lookup.pos.z;
#endif
    return Bands(nearness, pixel_m > 0.0 ? perSpan_m / pixel_m : 0.0);
}

bool isBanded(Bands bands, int vertex) {
    LightSample light = samples[vertex];
    float span = max(length(light.spanU.xyz), length(light.spanV.xyz));
    return bands.nearness > 0.0 && light.normal.w * span * bands.perSpan_px > widest_px;
}

// Share of the sample's cell that the receiver sees, at the points of a Hammersley set.
float cellLit(Bands bands, int vertex, Lookup lookup) {
    LightSample light = samples[vertex];
    int layer = layerOf(subdivision.slotOfVertex[vertex]);
    float lit = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 at = vec2(float(i) / float(taps), float(bitfieldReverse(uint(i))) / 4294967296.0) + 0.5 / float(taps) - 0.5;
        at = light.normal.w * at + vec2(light.spanU.w, light.spanV.w);
        vec3 step = at.x * light.spanU.xyz + at.y * light.spanV.xyz;
        lit += besideSampleLit(layer, lookup, light.place.xyz, step, bands.nearness);
    }
    return lit / float(taps);
}
