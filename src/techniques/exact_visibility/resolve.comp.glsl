// SPDX-License-Identifier: Apache-2.0
#version 450
#extension GL_ARB_shader_group_vote : enable
// For each receiver of a busy tile, the samples of the light that no candidate of its tile hides. Defines: ROWS, the rows
// of a lattice; WITH_PARTS, where parts of tiles are busy; WITH_HOLES, where casters have alpha masks; WITH_WEIGHTS, where samples
// do not count alike; CELLS, along each side of a rectangle that are answered for, too; PANE_STEPS, where casters let light through, how often samples are taken until there are no more.
// (llvmpipe runs both sides of a branch, and every loop once.)
layout(local_size_x = 8, local_size_y = 8) in;
#ifndef ROWS
#define ROWS 11
#endif

#include "src/techniques/exact_visibility/receivers.glsl"
#include "src/techniques/exact_visibility/light.glsl"
#include "src/techniques/exact_visibility/tree.glsl"
#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/underfoot.glsl"
#include "src/techniques/exact_visibility/coverage.glsl"
#ifdef WITH_HOLES
#include "src/techniques/exact_visibility/masks.glsl"
#endif
#include "src/techniques/exact_visibility/weights.glsl"

layout(std140) uniform Constants { ExactRound round_; };
layout(std430) readonly buffer Candidates { uint candidates[]; };
layout(std430) readonly buffer TileLists { TileList tileLists[]; };
layout(std430) readonly buffer Busy { BusyTiles busy; uint busyTiles[]; };
layout(std430) readonly buffer Weights { uint weightsChangedAt; vec4 weights[]; };
uniform writeonly image2D visibility;
layout(r16f) uniform writeonly image2D errorBound;
uniform sampler2D radiance;

// Work is done in rounds, each of a bounded number of iterations: those who are not done leave what they know here and
// ask for another round. Rounds come in turns, one after the other for each group of alpha textures: as many as can be
// bound at a time. A part of the work is one window, one lattice, one step and one group; the first step is for all that
// lets no light through, the others take some of the samples each through the panes.
layout(std430) buffer States { uint states[]; };
layout(std430) buffer Rounds { uint roundGroups[]; };  // three numbers a round, for indirect dispatch
#ifdef PANE_STEPS
const int stepsOfWindow = 1 + PANE_STEPS;
#define STATE_WORDS (EXACT_STATE_WORDS + ROWS + EXACT_PANE_WORDS)
#else
const int stepsOfWindow = 1;
#define STATE_WORDS (EXACT_STATE_WORDS + ROWS)
#endif
int work = 0;

// Receivers that run together look at the same triangle at a time.
#ifdef GL_ARB_shader_group_vote
bool anyOfUs(bool value) { return anyInvocationARB(value); }
#else
bool anyOfUs(bool value) { return value; }
#endif

// Samples that are hidden, or are none of the light's, or lie below the horizon: bit i of row j.
uint hidden[ROWS];
// The same before any blocker is looked at.
uint unlit[ROWS];
// What one triangle hides.
uint spot[ROWS];

#include "src/techniques/exact_visibility/blockers.glsl"
#ifdef CELLS
#include "src/techniques/exact_visibility/cells.glsl"
#endif
#include "src/techniques/exact_visibility/sums.glsl"
#include "src/techniques/exact_visibility/progress.glsl"

void projectRow(Blocker t, int j) {
    if (j < ROWS) spot[min(j, ROWS - 1)] = hiddenInRow(t.onA, t.onB, t.onC, float(j));
}
void project(Blocker t) {
#define PROJECT_ROW(j) projectRow(t, j);
    EACH_ROW(PROJECT_ROW)
}

void hideRow(bool counts, int j) {
    if (j < ROWS) hidden[min(j, ROWS - 1)] |= counts ? spot[min(j, ROWS - 1)] : 0u;
}
void hide(bool counts) {
#define HIDE_ROW(j) hideRow(counts, j);
    EACH_ROW(HIDE_ROW)
}

uint hiddenOfRow(int j) { return j < ROWS ? hidden[min(j, ROWS - 1)] : 0xffffffffu; }
bool isAllHidden() {
    uint all_ = 0xffffffffu;
#define AND_ROW(j) all_ &= hiddenOfRow(j);
    EACH_ROW(AND_ROW)
    return all_ == 0xffffffffu;
}

// Where the way to a sample meets a triangle.
struct Crossing {
    vec3 normal;
    float height;
    float nearest, farthest;  // shares of the way: rounding must not carry a point beyond its triangle
    vec3 acrossA, acrossB, acrossC;
};

Crossing crossingOf(Blocker t) {
    vec3 normal = cross(t.b - t.a, t.c - t.a);
    return Crossing(normal, dot(normal, t.a), min(t.uvwA.z, min(t.uvwB.z, t.uvwC.z)),
                    max(t.uvwA.z, max(t.uvwB.z, t.uvwC.z)), cross(t.b, t.c), cross(t.c, t.a), cross(t.a, t.b));
}

// Whether a triangle is in the way of a sample that it covers, and has no hole there.
bool blocksSample(Crossing t, SeenLight seen, Patch patch_, vec2 uv, uint triangle, bool hasHoles) {
    vec3 direction = patch_.center + uv.x * patch_.across + uv.y * patch_.along;
    float w = clamp(t.height / dot(t.normal, direction), t.nearest, t.farthest);
    bool blocks = w < endOfRay(seen, direction);
#ifdef WITH_HOLES
    if (hasHoles) {
        vec3 share = vec3(dot(t.acrossA, direction), dot(t.acrossB, direction), dot(t.acrossC, direction));
        blocks = blocks && isSolid(triangle, share / (share.x + share.y + share.z));
    }
#endif
    return blocks;
}

// The same for a triangle that has holes, or may stand at the light: each sample that it seems to hide is looked at.
void hideSamples(Blocker t, SeenLight seen, Patch patch_, vec2 offset, uint triangle, bool hasHoles, bool counts) {
    Crossing crossing = crossingOf(t);
    for (int j = 0; j < ROWS && anyOfUs(counts); ++j) {
        uint bits = counts ? spot[j] & ~hidden[j] : 0u;
        uint stays = 0u;
        ++work;
        while (anyOfUs(bits != 0u)) {
            ++work;
            int i = max(findLSB(bits), 0);
            uint bit = bits & (0u - bits);
            stays |= blocksSample(crossing, seen, patch_, uvOf(vec2(i, j), offset), triangle, hasHoles) ? bit : 0u;
            bits &= ~bit;
        }
        hidden[j] |= stays;
    }
}

// Whether the triangle blocks whatever it covers, without a look at each sample.
bool isPlain(Blocker t, SeenLight seen, bool hasHoles) {
    if (hasHoles) return false;
    if (light.emitter.shape == shapeDistant) return true;
    if (isFlat()) return max(t.uvwA.z, max(t.uvwB.z, t.uvwC.z)) < rayEnd;
    float farthest_m = max(dot(seen.axis, t.a), max(dot(seen.axis, t.b), dot(seen.axis, t.c)));
    if (isTube()) return farthest_m < rayEnd * (seen.away_m - light.emitter.halfSize.y);
    return farthest_m < rayEnd * (length(seen.toCenter) - light.emitter.halfSize.x);
}

// Marks what cannot be seen even without blockers: no sample, or below the horizon.
void beginWith(SeenLight seen, Patch patch_, vec3 normal, int lattice, vec2 offset, vec3 toSurface) {
    // How high the sample (i, j) is above the receiver's plane, times something: linear in i and j.
    vec3 center = patch_.center - toSurface;
    float rise = dot(normal, patch_.across), fall = dot(normal, patch_.along);
    float perI = rise * light.uvFromI.x + fall * light.uvFromI.y;
    float perJ = rise * light.uvFromJ.x + fall * light.uvFromJ.y;
    float base = dot(normal, center) - perI * offset.x - perJ * offset.y;
    perI = abs(perI) < 1e-30 ? 1e-30 : perI;
    for (int j = 0; j < ROWS; ++j) {
        float meets = -(base + perJ * float(j)) / perI;
        uint above = perI > 0.0 ? ~((2u << uint(clamp(floor(meets), -1.0, 30.0) + 1.0) >> 1) - 1u) : bitsBefore(meets);
        uint row = uint(lattice * EXACT_MAX_ROWS + j);
        unlit[j] = ~(light.valid[row >> 2][row & 3u] & above);
        for (uint bits = patch_.isCut || isTube() ? ~unlit[j] : 0u; bits != 0u; bits &= bits - 1u) {
            int i = findLSB(bits);
            vec2 uv = uvOf(vec2(i, j), offset);
            vec2 place = onLight(patch_, uv);
            bool isOff = isTube() ? !meetsTube(seen, patch_.center + uv.x * patch_.across + uv.y * patch_.along)
                                  : dot(place, place) >= 1.0;
            if (isOff) unlit[j] |= 1u << uint(i);
        }
        hidden[j] = unlit[j];
    }
}

#ifdef PANE_STEPS
#include "src/techniques/exact_visibility/panes.glsl"
#endif

void save(uint base, Progress progress, Sums sums) {
    states[base] = uint(progress.part) + 1u;
    states[base + 1u] = progress.next;
    states[base + 2u] = progress.walk.node;
    states[base + 3u] = progress.walk.returnTo;
    for (int i = 0; i < 3; ++i) {
        states[base + 4u + uint(i)] = floatBitsToUint(sums.seen[i]);
        states[base + 7u + uint(i)] = floatBitsToUint(sums.whole[i]);
    }
    states[base + 10u] = floatBitsToUint(sums.borders);
    states[base + 11u] = floatBitsToUint(sums.samples);
    for (int j = 0; j < ROWS; ++j) states[base + uint(EXACT_STATE_WORDS + j)] = hidden[j];
#ifdef PANE_STEPS
    savePanes(base + uint(EXACT_STATE_WORDS + ROWS));
#endif
}

void load(uint base, out Progress progress, out Sums sums) {
    progress.part = int(states[base]) - 1;
    progress.next = states[base + 1u];
    progress.walk = Walk(states[base + 2u], states[base + 3u]);
    for (int i = 0; i < 3; ++i) {
        sums.seen[i] = uintBitsToFloat(states[base + 4u + uint(i)]);
        sums.whole[i] = uintBitsToFloat(states[base + 7u + uint(i)]);
    }
    sums.borders = uintBitsToFloat(states[base + 10u]);
    sums.samples = uintBitsToFloat(states[base + 11u]);
#ifdef PANE_STEPS
    loadPanes(base + uint(EXACT_STATE_WORDS + ROWS));
#endif
}

// In which of the group's turns a triangle is looked at: one with holes when its texture is bound, all others first.
bool belongsTo(int group, bool isOfPanes, uint leaf) {
#ifdef PANE_STEPS
    if (((leaf & EXACT_PANE) != 0u) != isOfPanes) return false;
#endif
#ifdef WITH_HOLES
    return round_.groups == 1 || ((leaf & EXACT_MASKED) != 0u ? groupOf(firstTriangle(leaf)) : 0) == group;
#else
    return true;
#endif
}

int groupOfRound() { return round_.number / round_.turnRounds % round_.groups; }

// The next round in which the group's textures are bound.
int roundFor(int group) {
    int turn = round_.number / round_.turnRounds;
    int wait = (group - turn % round_.groups + round_.groups) % round_.groups;
    if (wait == 0 && (round_.number + 1) / round_.turnRounds == turn) return round_.number + 1;
    return (turn + (wait == 0 ? round_.groups : wait)) * round_.turnRounds;
}

Shaft shaftFrom(vec3 apex) {
    bool isDistant = light.emitter.shape == shapeDistant;
    Shaft shaft;
    shaft.fromMin = apex - 1e-6 * abs(apex);
    shaft.fromMax = apex + 1e-6 * abs(apex);
    shaft.inverseLower = inverseSlope(isDistant ? light.boxMin : light.boxMin - shaft.fromMin);
    shaft.inverseUpper = inverseSlope(isDistant ? light.boxMax : light.boxMax - shaft.fromMax);
    shaft.end = isDistant ? 3e37 : 1.0;
    return shaft;
}

// The receivers together, and the light as they see it.
struct Look {
    Projection projection;
    Shaft shaft;
    vec3 normal, apex;
    TileList list;
    uint first, last;  // the tile's part of the lists
    int group;
    bool isOfPanes;
    Leeway leeway;
};

// The next node on the way: one of the tile's list, or below such a one, or beyond the list; or none, where a leaf has
// triangles that wait.
void visitNode(Look look, bool isPlainPart, inout Progress progress, inout Leaf leaf) {
    bool waits = leaf.next < leaf.end;
    if (!isPlainPart) progress = leaveList(progress, look.list);
    bool isListed = isPlainPart || !isListOver(progress, look.list);
    bool begins = isListed && isBetweenNodes(progress) && !waits;
    uint place = progress.next < look.list.plain ? look.first + progress.next : look.last - (progress.next - look.list.plain);
    uint at = begins ? candidates[min(place, look.last)] : progress.walk.node;
    TreeNode node = loadNode(at == EXACT_END ? 0u : at);
    bool isHit = mayBoxHide(look.projection, look.normal, look.apex, node.boxMin, node.boxMax);
    if (!isPlainPart) isHit = isHit && (isListed || mayBlock(look.shaft, node.boxMin, node.boxMax));
    isHit = anyOfUs(isHit);
    ++work;
    if (waits || at == EXACT_END) return;
    if (begins) {
        ++progress.next;
        progress.walk.returnTo = node.skip;
    }
    if (isListed) progress.walk.node = isHit && isInner(node) ? firstBelow(at, node, look.leeway) : node.skip;
    else progress.walk = advance(progress.walk, node, isHit, look.leeway);
    if (isHit && hasTriangles(node) && (isPlainPart || belongsTo(look.group, look.isOfPanes, node.leaf))) {
        uint triangle = firstTriangle(node.leaf);
        leaf = Leaf(triangle, triangle + triangleCount(node.leaf), (node.leaf & EXACT_MASKED) != 0u);
    }
}

void main() {
    uint place = gl_WorkGroupID.y * EXACT_GROUPS_ACROSS + gl_WorkGroupID.x;
    ivec2 thread = ivec2(gl_LocalInvocationID.xy);
#ifdef WITH_PARTS
    place = EXACT_TILE_PARTS * place + uint(thread.y);
    if (place >= busy.count) return;
    uint tileIndex = busyTiles[place] / EXACT_TILE_PARTS;
    thread.y = int(busyTiles[place] % EXACT_TILE_PARTS);
#else
    if (place >= busy.count) return;
    uint tileIndex = busyTiles[place];
#endif
    ivec2 tile = ivec2(int(tileIndex) % frame.tilesAcross, int(tileIndex) / frame.tilesAcross);
    ivec2 pixel = EXACT_TILE * tile + placeInTile(thread);
    bool inside = all(lessThan(pixel, view.size_px));
    uint base = uint(min(pixel.y, view.size_px.y - 1) * view.size_px.x + min(pixel.x, view.size_px.x - 1)) * STATE_WORDS;
    TileList list = tileLists[tileIndex];
    Leeway leeway = Leeway(list.low, list.high, list.leewayPerMetre);

#ifdef CELLS
    beginCells();
#endif
#ifdef PANE_STEPS
    beginPanes();
#endif
    Progress progress = startOf(0, 0u);
    Sums sums = Sums(vec3(0.0), vec3(0.0), 0.0, 0.0);
    bool resumes = round_.number > 0;
    if (resumes) {
        if (states[base] == 0u || !inside) return;
        load(base, progress, sums);
        if (progress.part % round_.groups != groupOfRound()) return;  // has asked for a later round
    }

    Receiver receiver;
    bool receives = loadReceiver(min(pixel, view.size_px - 1), receiver) && inside;
    vec3 apex = apexOf(receiver);
    Footing footing = footingOf(min(pixel, view.size_px - 1), receiver);
    SeenLight seen = seeLight(apex);
    vec3 toSurface = isFlat() || isTube() ? receiver.posLight - apex : vec3(0.0);
    int patches = receives ? seen.patches : 0;

    bool isPaused = false;
    for (; progress.part < 6 * light.latticeCount * stepsOfWindow * round_.groups; ++progress.part) {
        int turn = progress.part / round_.groups, group = progress.part - turn * round_.groups;
        int window = turn / stepsOfWindow, step_ = turn - window * stepsOfWindow;
        int face = window / light.latticeCount, lattice = window - face * light.latticeCount;
        bool isOn = face < patches;
        if (!anyOfUs(isOn)) break;
        isPaused = group != groupOfRound() || (step_ > 0 && work >= round_.work);
        if (isPaused) break;
        Patch patch_ = patchOf(seen, face, receiver.normalLight, toSurface);
        vec2 offset = light.offsets[lattice].xy;
        if (step_ == 0 || resumes) beginWith(seen, patch_, receiver.normalLight, lattice, offset, toSurface);
        for (int j = 0; j < ROWS && resumes; ++j) hidden[j] |= states[base + uint(EXACT_STATE_WORDS + j)];

        uint first = tileIndex * uint(frame.tileCapacity);
        Look look = Look(projectionOf(patch_, offset), shaftFrom(apex), receiver.normalLight, apex, list, first,
                         first + uint(frame.tileCapacity) - 1u, group, step_ > 0, leeway);
        if (!isOn) {
            for (int j = 0; j < ROWS; ++j) hidden[j] = 0xffffffffu;
        }
#ifdef PANE_STEPS
        if (step_ > 0) {
            if (resumes) opaque = hidden;
            takeSamples(step_, isOn);
        }
#endif
        resumes = false;
        bool isDark = isAllHidden();
        Leaf leaf = Leaf(0u, 0u, false);
        Blocker blocker;
        while ((leaf.next < leaf.end || (!isPlainOver(progress, list) && work < round_.work)) && anyOfUs(!isDark)) {
            // The next triangle that matters to anyone.
            bool counts = false;
            do {
                do visitNode(look, true, progress, leaf);
                while (leaf.next == leaf.end && !isPlainOver(progress, list) && work < round_.work);
                do {
                    blocker = loadBlocker(leaf.next, apex, patch_, offset);
                    counts = leaf.next < leaf.end && mayHide(blocker, receiver.normalLight);
                    leaf.next = min(leaf.next + 1u, leaf.end);
                    ++work;
                } while (leaf.next < leaf.end && !anyOfUs(counts));
                ++work;
            } while (!isPlainOver(progress, list) && work < round_.work && !anyOfUs(counts));
            counts = counts && !isUnderfoot(footing, receiver.normalLight, apex, blocker.a, blocker.b, blocker.c);
            project(blocker);
            hide(counts);
            isDark = isAllHidden();
            work += 2;
        }

        // Special candidates, then whatever did not fit into the lists.
        progress = leaveList(progress, list);
        while ((leaf.next < leaf.end || (!isOver(progress, list) && work < round_.work)) && anyOfUs(!isDark)) {
            bool counts = false;
            uint triangle = 0u;
            do {
                do visitNode(look, false, progress, leaf);
                while (leaf.next == leaf.end && !isOver(progress, list) && work < round_.work);
                do {
                    triangle = leaf.next;
                    blocker = loadBlocker(triangle, apex, patch_, offset);
                    counts = triangle < leaf.end && mayHide(blocker, receiver.normalLight);
                    leaf.next = min(triangle + 1u, leaf.end);
                    ++work;
                } while (leaf.next < leaf.end && !anyOfUs(counts));
                ++work;
            } while (!isOver(progress, list) && work < round_.work && !anyOfUs(counts));
            counts = counts && !isInLightPlane(triangle) &&
                     !isUnderfoot(footing, receiver.normalLight, apex, blocker.a, blocker.b, blocker.c);
#ifdef PANE_STEPS
            if (look.isOfPanes) crossPane(blocker, seen, patch_, offset, triangle, leaf.hasHoles, counts);
            counts = counts && !look.isOfPanes;
#endif
            project(blocker);
            bool plain = isPlain(blocker, seen, leaf.hasHoles);
            hide(counts && plain);
            hideSamples(blocker, seen, patch_, offset, triangle, leaf.hasHoles, counts && !plain);
            isDark = isAllHidden();
            work += 4;
        }
        isPaused = !isOver(progress, list) && anyOfUs(!isDark);
#ifdef PANE_STEPS
        if (step_ > 0) hidden = opaque;
#endif
        if (isPaused) break;

        // What is all hidden stays so: the other groups need not be asked.
        bool isLast = group == round_.groups - 1 || !anyOfUs(!isDark), isWindowOver = isLast;
        if (isLast && step_ == 0) {
            bool isOnly = patches * light.latticeCount == 1;
#ifdef PANE_STEPS
            isOnly = isOnly && !mayListPanes(list);  // they take from what is weighed
#endif
            addUp(sums, seen, patch_, receiver.normalLight, lattice, offset, isOn, isOnly);
            work += 32 * ROWS;
        }
#ifdef PANE_STEPS
        if (isLast) {
            if (step_ == 0) opaque = hidden;
            else addPanes(sums, seen, patch_, receiver.normalLight, lattice, offset);
            beginPanes();
            work += 4 * ROWS + 10 * EXACT_PANE_SAMPLES;
            // Whether there may be samples that are left, and panes.
            bool goesOn = step_ == 0 ? !isDark && mayListPanes(list) : placeCount == EXACT_PANE_SAMPLES;
            isWindowOver = step_ == PANE_STEPS || !anyOfUs(goesOn);
        }
#endif
        if (isLast) progress.part += round_.groups - 1 - group;
        if (isWindowOver) {
            progress.part = (window + 1) * stepsOfWindow * round_.groups - 1;
            for (int j = 0; j < ROWS; ++j) hidden[j] = 0u;  // what is saved of a window that has not begun
        }
        progress = startOf(progress.part, isWindowOver ? 0u : list.plain);
    }

    if (!inside) return;
#ifdef CELLS
    saveCells(pixel);
#endif
    if (isPaused) {
        save(base, progress, sums);
        int next = 3 * roundFor(progress.part % round_.groups);
        atomicMax(roundGroups[next], busy.groupsX);
        atomicMax(roundGroups[next + 1], busy.groupsY);
        atomicMax(roundGroups[next + 2], 1u);
        return;
    }
    states[base] = 0u;
    vec3 value = mix(vec3(0.0), sums.seen / max(sums.whole, vec3(1e-37)), greaterThan(sums.whole, vec3(0.0)));
    if (!receives) value = vec3(1.0);
    imageStore(visibility, pixel, vec4(clamp(value, 0.0, 1.0), 1.0));
    float ofEdge = 0.5 + (leeway.perMetre > 0.0 ? EXACT_STAND_IN_SHIFT : 0.0);
    float bound = sums.samples > 0.0 ? min(ofEdge * sums.borders / sums.samples, 1.0) : 0.0;
    imageStore(errorBound, pixel, vec4(bound));
}
