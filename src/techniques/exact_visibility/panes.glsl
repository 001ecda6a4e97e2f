// SPDX-License-Identifier: Apache-2.0
// Panes: casters that let a share of the light pass. When the opaque casters have been looked at, those samples that they
// leave are taken EXACT_PANE_SAMPLES at a time, each with what has passed so far, through one pane after the other. Triangles
// of one caster follow each other in the tree, so that a sample which is behind several of them passes its pane once.
// Includer defines ROWS, hidden[].
layout(std430) readonly buffer Panes { vec4 transmittances[]; };

uint opaque[ROWS];  // what is hidden without panes: meanwhile hidden[] is all but the samples that are taken, and their neighbours
ivec2 places[EXACT_PANE_SAMPLES];   // i, j of a sample
int placeCount = 0;
uint besideIsOpen, aboveIsOpen;     // bit k: the sample k has a neighbour that no opaque caster hides, in its row, in the next
uvec2 passing[EXACT_PANE_SAMPLES];  // 16 bits a channel
// Bit k: the pane that is looked at stands before the sample k, that neighbour in its row, that in the next.
uint crossed, crossedBeside, crossedAbove;
uint paneLookedAt;
float paneBorders;  // pairs of neighbours of which one is behind a pane and one is not, by how much more passes the one

vec3 unpackShare(uvec2 share) { return vec3(unpackUnorm2x16(share.x), unpackUnorm2x16(share.y).x); }
uvec2 packShare(vec3 share) { return uvec2(packUnorm2x16(share.xy), packUnorm2x16(vec2(share.z, 0.0))); }

// Whether a tile's candidates, or what did not fit into their list, may be panes.
bool mayListPanes(TileList list) { return list.special > 0u || list.stoppedAt != EXACT_END; }

void beginPanes() {
    for (int k = 0; k < EXACT_PANE_SAMPLES; ++k) passing[k] = packShare(vec3(1.0));
    crossed = crossedBeside = crossedAbove = 0u;
    paneLookedAt = 0u;
    paneBorders = 0.0;
}

// Takes the samples of a step, in the order of the rows; none where `counts` is false.
void takeSamples(int step_, bool counts) {
    int first = (step_ - 1) * EXACT_PANE_SAMPLES, before = 0;
    uint below = 0u;
    placeCount = 0;
    besideIsOpen = aboveIsOpen = 0u;
    for (int j = 0; j < ROWS; ++j) {
        uint row = ~opaque[j], above = j + 1 < ROWS ? ~opaque[min(j + 1, ROWS - 1)] : 0u;
        uint open_ = counts ? row : 0u, taken = 0u;
        int end = before + bitCount(open_);
        if (end <= first) open_ = 0u;
        for (; open_ != 0u && before < first; ++before) open_ &= open_ - 1u;
        for (; open_ != 0u && placeCount < EXACT_PANE_SAMPLES; open_ &= open_ - 1u) {
            int i = findLSB(open_);
            taken |= 1u << uint(i);
            besideIsOpen |= (row >> uint(i + 1) & 1u) << uint(placeCount);
            aboveIsOpen |= (above >> uint(i) & 1u) << uint(placeCount);
            places[placeCount++] = ivec2(i, j);
        }
        before = end;
        hidden[j] = ~(taken | ((taken << 1 | below) & row));
        below = taken;
    }
}

// The pane that was looked at is behind us.
void passPane() {
    if ((crossed | crossedBeside | crossedAbove) == 0u) return;
    vec3 share = transmittances[paneLookedAt].rgb;
    uint beside = (crossed ^ crossedBeside) & besideIsOpen, above = (crossed ^ crossedAbove) & aboveIsOpen;
    for (int k = 0; k < placeCount; ++k) {
        vec3 before = unpackShare(passing[k]), taken = before * (1.0 - share);
        paneBorders += float((beside >> uint(k) & 1u) + (above >> uint(k) & 1u)) * max(taken.r, max(taken.g, taken.b));
        if ((crossed >> uint(k) & 1u) != 0u) passing[k] = packShare(before * share);
    }
    crossed = crossedBeside = crossedAbove = 0u;
}

uint paneOf(uint triangle) { return imageLoad(triangles, int(3u * triangle + 1u)).w; }

// Notes which samples are behind a triangle of a pane.
void crossPane(Blocker t, SeenLight seen, Patch patch_, vec2 offset, uint triangle, bool hasHoles, bool counts) {
    uint pane = paneOf(triangle);
    if (counts && pane != paneLookedAt) {
        passPane();
        paneLookedAt = pane;
    }
    Crossing crossing = crossingOf(t);
    bool plain = isPlain(t, seen, hasHoles);
    work += 2 * EXACT_PANE_SAMPLES;
    for (int k = 0; k < placeCount && counts; ++k) {
        ivec2 place = places[k];
        uint row = hiddenInRow(t.onA, t.onB, t.onC, float(place.y)) >> uint(place.x);
        uint nextRow = hiddenInRow(t.onA, t.onB, t.onC, float(place.y + 1)) >> uint(place.x);
        bool isBehind = (row & 1u) != 0u;
        if (isBehind && !plain) isBehind = blocksSample(crossing, seen, patch_, uvOf(vec2(place), offset), triangle, hasHoles);
        crossed |= isBehind ? 1u << uint(k) : 0u;
        crossedBeside |= (row >> 1 & 1u) << uint(k);
        crossedAbove |= (nextRow & 1u) << uint(k);
    }
}

// Takes from what is seen of the light what the panes have taken.
void addPanes(inout Sums sums, SeenLight seen, Patch patch_, vec3 normal, int lattice, vec2 offset) {
    passPane();
    sums.borders += paneBorders;
    for (int k = 0; k < placeCount; ++k) {
        vec3 weight = vec3(1.0);
#ifdef WITH_WEIGHTS
        ivec2 place = places[k];
        weight = weightOf(seen, patch_, normal, uvOf(vec2(place), offset), weightIndex(lattice, place.x, place.y), isWhole(patch_));
#endif
        sums.seen -= weight * (1.0 - unpackShare(passing[k]));
    }
}

void savePanes(uint base) {
    states[base] = crossed;
    states[base + 1u] = crossedBeside;
    states[base + 2u] = crossedAbove;
    states[base + 3u] = paneLookedAt;
    states[base + 4u] = floatBitsToUint(paneBorders);
    for (uint k = 0u; k < EXACT_PANE_SAMPLES; ++k) {
        states[base + 5u + 2u * k] = passing[k].x;
        states[base + 6u + 2u * k] = passing[k].y;
    }
}

void loadPanes(uint base) {
    crossed = states[base];
    crossedBeside = states[base + 1u];
    crossedAbove = states[base + 2u];
    paneLookedAt = states[base + 3u];
    paneBorders = uintBitsToFloat(states[base + 4u]);
    for (uint k = 0u; k < EXACT_PANE_SAMPLES; ++k)
        passing[k] = uvec2(states[base + 5u + 2u * k], states[base + 6u + 2u * k]);
}
