// SPDX-License-Identifier: Apache-2.0
// What a receiver sees of the light, added up over samples. Includer defines ROWS, unlit[], hidden[], weights[] and radiance,
// and includes cells.glsl where CELLS is defined.

vec2 uvOf(vec2 ij, vec2 offset) {
    vec2 p = ij - offset;
    return p.x * light.uvFromI + p.y * light.uvFromJ;
}

struct Sums {
    vec3 seen, whole;
    float borders, samples;  // neighbouring samples of which one is seen and one is not; samples above the horizon
};

// Whether samples are where the light's weights were made for: windows fitted to the horizon have samples of their own.
bool isWhole(Patch patch_) { return patch_.lightAcross.x == 1.0 && patch_.lightAlong.y == 1.0; }

vec3 weightOf(SeenLight seen, Patch patch_, vec3 normal, vec2 uv, int index, bool isOnWhole) {
    vec3 direction = patch_.center + uv.x * patch_.across + uv.y * patch_.along;
    float length2 = dot(direction, direction);
    vec3 weight = vec3(1.0);
    if (isFlat() || isTube()) {
        // cos(receiver) cos(light) / distance^2, up to a factor that is the same for all samples. (A tube looks like what
        // it covers of its plane.)
        if (light.isWeightedByIrradiance) weight *= max(dot(normal, direction), 0.0) / (length2 * length2) * dot(seen.toCenter, seen.toCenter);
        if (light.emitter.isTextured)
            weight *= isOnWhole ? weights[index].rgb
                                : emitted(textureLod(radiance, 0.5 * onLight(patch_, uv) + 0.5, 0.0).rgb);
    } else {
        weight *= coneWeight(seen, uv, direction);
        if (light.isWeightedByIrradiance) weight *= max(dot(normal, direction), 0.0) * inversesqrt(length2);
    }
    return weight;
}

// For receivers of one kind at a time, so that textures are read where nothing else will do.
void addWeights(inout Sums sums, SeenLight seen, Patch patch_, vec3 normal, int lattice, vec2 offset, bool counts, bool isOnWhole) {
    for (int j = 0; j < ROWS && anyOfUs(counts); ++j) {
        for (uint bits = counts ? ~unlit[j] : 0u; bits != 0u; bits &= bits - 1u) {
            int i = findLSB(bits);
            vec2 uv = uvOf(vec2(i, j), offset);
            vec3 weight = weightOf(seen, patch_, normal, uv, weightIndex(lattice, i, j), isOnWhole);
            bool isSeen = (hidden[j] >> uint(i) & 1u) == 0u;
            sums.whole += weight;
            sums.seen += isSeen ? weight : vec3(0.0);
#ifdef CELLS
            addToCell(onLight(patch_, uv), weight.r, isSeen);
#endif
        }
    }
}

// `isOnly`: one window on one lattice is all that the receiver sees the light through.
void addUp(inout Sums sums, SeenLight seen, Patch patch_, vec3 normal, int lattice, vec2 offset, bool counts, bool isOnly) {
#ifdef WITH_WEIGHTS
    const bool uneven = true;
    bool isAnySeen = false, isAnyHidden = false;
    for (int j = 0; j < ROWS; ++j) {
        isAnySeen = isAnySeen || hidden[j] != 0xffffffffu;
        isAnyHidden = isAnyHidden || hidden[j] != unlit[j];
    }
    // Of what is seen as a whole, or not at all, nothing need be weighed. (A texture may emit nothing, of which nobody sees
    // anything.)
    bool isAlike = counts && isOnly && !(isAnySeen && (isAnyHidden || light.emitter.isTextured));
    addWeights(sums, seen, patch_, normal, lattice, offset, counts && !isAlike && isWhole(patch_), true);
    addWeights(sums, seen, patch_, normal, lattice, offset, counts && !isAlike && !isWhole(patch_), false);
    if (isAlike) {
        sums.seen = vec3(isAnySeen ? 1.0 : 0.0);
        sums.whole = vec3(1.0);
    }
#else
    const bool uneven = false;
#endif
    for (int j = 0; j < ROWS; ++j) {
        uint seenRow = counts ? ~hidden[j] : 0u, wholeRow = counts ? ~unlit[j] : 0u;
        if (!uneven) {
            sums.seen += vec3(bitCount(seenRow));
            sums.whole += vec3(bitCount(wholeRow));
        }
        sums.samples += float(bitCount(wholeRow));
        sums.borders += float(bitCount((seenRow ^ (seenRow >> 1)) & wholeRow & (wholeRow >> 1)));
        if (j > 0) sums.borders += float(bitCount((seenRow ^ ~hidden[j - 1]) & wholeRow & ~unlit[j - 1]));
    }
}
