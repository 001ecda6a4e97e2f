// SPDX-License-Identifier: Apache-2.0
// A filter between the shadows of neighbouring samples: where they disagree, a sample is asked for its cell of the
// light instead of its point. The kernel is what the cell's points would see of the blockers: it is as wide as the
// shadows are apart, so that they meet without a step and nothing is blurred further. How near the blockers are, the
// samples in shadow know. Includer declares `constants`.
// The mean over samples in shadow that disagree with a neighbour, see blockerNearness; 0: there are none.
float meanNearness(Comparison comparison, Lookup lookup) {
    float sum = 0.0;
    int blocked = 0;
    for (int word = 0; word < 3; ++word) {
        for (uint rest = comparison.border[word] & comparison.shadows[word]; rest != 0u; rest &= rest - 1u) {
            int slot = subdivision.slotOfVertex[vertexOf(word, findLSB(rest))];
            sum += max(blockerNearness(layerOf(slot), lookup), 0.0);
            ++blocked;
        }
    }
    return blocked > 0 ? sum / float(blocked) : 0.0;
}

// A tree that stops at 5 x 5 samples or fewer, as under narrow suns, has few points in all: there more of them are taken.
const float largeCell = 0.19;  // a side, of the unit square's
const int tapsOfLargeCell = 16;

// Share of the sample's cell that the receiver sees, at the points of a Hammersley set.
float cellLit(int vertex, Lookup lookup, float nearness) {
    LightSample light = samples[vertex];
    int taps = light.cellSide > largeCell ? max(constants.taps, tapsOfLargeCell) : constants.taps;
    int layer = layerOf(subdivision.slotOfVertex[vertex]);
    float lit = 0.0, own = -1.0;
    for (int i = 0; i < taps; ++i) {
        vec2 at = vec2(float(i) / float(taps), float(bitfieldReverse(uint(i))) / 4294967296.0);
        at += 0.5 / float(taps) - 0.5;
        at = light.cellSide * at + vec2(light.cellMiddleU, light.cellMiddleV);
        vec3 step = at.x * light.spanU + at.y * light.spanV;
        float beside = besideSampleLit(layer, lookup, light.place, step, nearness);
        if (beside < 0.0) {
            // Blockers close to the light make kernels larger than the map: there the sample's own point has to do.
            if (own < 0.0) own = sampleLit(layer, lookup);
            beside = own;
        }
        lit += beside;
    }
    return lit / float(taps);
}
