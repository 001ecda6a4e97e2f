// SPDX-License-Identifier: Apache-2.0
#version 450
// For each tile of 8 x 8 receivers, the nodes of the tree that may stand between them and the light; and, where there are
// none and no horizon cuts the light, or none of it can be seen, what its pixels see. One invocation a tile.
layout(local_size_x = 32) in;

#include "src/techniques/exact_visibility/receivers.glsl"
#include "src/techniques/exact_visibility/light.glsl"
#include "src/techniques/exact_visibility/tree.glsl"
#include "src/techniques/exact_visibility/underfoot.glsl"
#include "src/techniques/exact_visibility/shafts.glsl"
#include "src/techniques/exact_visibility/exact_io.h"

layout(std430) buffer Candidates { uint candidates[]; };  // frame.tileCapacity a tile
layout(std430) writeonly buffer TileLists { TileList tileLists[]; };
layout(std430) buffer Busy { BusyTiles busy; uint busyTiles[]; };
layout(std140) uniform Constants { ExactKeeping keeping; };
layout(std430) readonly buffer Tiles { TileBounds tileBounds[]; };
layout(std430) readonly buffer TileRevisions { uint tileRevisions[]; };
layout(std430) readonly buffer Weights { uint weightsChangedAt; };
layout(std430) buffer MadeAt { uint madeAt[]; };                 // of the kept tiles, plus 1
layout(std430) readonly buffer ChangedBoxes { vec4 changed[]; };  // low and high
uniform writeonly image2D visibility;
layout(r16f) uniform writeonly image2D errorBound;

// How far it is at most from one of the receivers to a point of the light.
float farthestFromLight(TileBounds bounds) {
    return distance(0.5 * (bounds.low + bounds.high), 0.5 * (light.boxMin + light.boxMax)) +
           0.5 * (distance(bounds.low, bounds.high) + distance(light.boxMin, light.boxMax));
}

// More than rounding does to heights above receivers, metres.
float heightRounding(TileBounds bounds) {
    vec3 size = max(max(abs(bounds.low), abs(bounds.high)), max(abs(light.boxMin), abs(light.boxMax)));
    return 1e-5 * (size.x + size.y + size.z + distance(frame.eye, 0.5 * (bounds.low + bounds.high)));
}

// How far a flat light's centre is before its own plane, as the receivers see it: least and most.
vec2 beforeFlatLight(TileBounds bounds) {
    float middle = dot(light.axisZ, light.center - 0.5 * (bounds.low + bounds.high));
    float reach = 0.5 * dot(abs(light.axisZ), bounds.high - bounds.low);
    return vec2(middle - reach, middle + reach);
}

// Whether none of the receivers sees any of the light, whatever stands between; or there is none.
bool isDark(TileBounds bounds) {
    if (bounds.otherNormal < 0.0) return true;
    if (light.emitter.shape == shapeDistant)
        return dot(bounds.normal, light.axisZ) + bounds.otherNormal < -light.coneSine - 1e-4 && light.coneCosine >= 0.0;
    float rounded = heightRounding(bounds);
    if (isFlat() && light.emitter.isOneSided && beforeFlatLight(bounds).y < -rounded) return true;
    vec3 highest = mix(light.boxMin, light.boxMax, greaterThan(bounds.normal, vec3(0.0)));
    return dot(bounds.normal, highest) - bounds.lowest + bounds.otherNormal * farthestFromLight(bounds) < -rounded;
}

// Whether each of the receivers sees all of the light, where nothing stands between. Beyond the ends of a tube one may be
// within it, which is left to each of them.
bool isAboveHorizon(TileBounds bounds) {
    if (bounds.otherNormal < 0.0 || isTube()) return false;
    if (light.emitter.shape == shapeDistant)
        return dot(bounds.normal, light.axisZ) - bounds.otherNormal > light.coneSine + 2e-4 && light.coneCosine > 0.0;
    float rounded = heightRounding(bounds), away = farthestFromLight(bounds);
    vec2 before = beforeFlatLight(bounds);
    float least = 1e-6 * away + rounded;
    if (isFlat() && before.x < least && (light.emitter.isOneSided || before.y > -least)) return false;
    vec3 lowest = mix(light.boxMax, light.boxMin, greaterThan(bounds.normal, vec3(0.0)));
    return dot(bounds.normal, lowest) - bounds.highest - bounds.otherNormal * away > 2e-4 * away + rounded;
}

// How far a blocker, a metre away from a receiver, may be from where it is, so that its shadow's edges move by no more than
// stand-ins may move them. At the share w of the way, d metres are d / w on the light's plane, and more where the light is
// seen from the side, by the share of its distance in that along its axis. Where a horizon cuts the light, what is left may
// be of any width. Points may be asked for one by one, and see all triangles.
float leewayPerMetre(TileBounds bounds) {
    if (view.isOfPoints || keeping.standInShift <= 0.0 || !isAboveHorizon(bounds)) return 0.0;
    if (light.emitter.shape == shapeDistant) return keeping.standInShift;
    float away = farthestFromLight(bounds);
    if (!isFlat()) return keeping.standInShift / away;
    vec2 before = beforeFlatLight(bounds);
    return keeping.standInShift * max(max(before.x, -before.y), 0.0) / (away * away);
}

// Of what size things are, far from the tile by a metre, between which and the light's samples there is no more to gain
// from looking at their parts: about two samples apart.
float wholeSize(TileBounds bounds) {
    float spacing = length(light.uvFromI);
    if (light.emitter.shape == shapeDistant) return 2.0 * spacing * min(light.emitter.halfSize.x, widestTangent);
    float distance_m = distance(light.center, 0.5 * (bounds.low + bounds.high));
    return 2.0 * spacing * min(max(light.emitter.halfSize.x, light.emitter.halfSize.y) / distance_m, widestTangent);
}

// Whether a node is listed as a whole: its parts are no nearer to each other than samples, or than receivers are. Any choice
// gives the same result.
bool isSmall(TileBounds bounds, float size, TreeNode node) {
    const float ofTile = 0.25;
    float away = distance(0.5 * (node.boxMin + node.boxMax), 0.5 * (bounds.low + bounds.high));
    return 0.5 * distance(node.boxMin, node.boxMax) < max(size * away, ofTile * distance(bounds.low, bounds.high));
}

// Whether a node is larger than the tile: of such ones one or a few may hide all of the light.
bool isLarge(TileBounds bounds, TreeNode node) {
    return distance(node.boxMin, node.boxMax) > distance(bounds.low, bounds.high);
}

// Whether a box may reach the light, so that it depends on the sample what blocks; or its plane.
bool mayReachLight(TileBounds bounds, vec3 boxMin, vec3 boxMax) {
    vec3 middle = 0.5 * (boxMin + boxMax) - light.center, extent = 0.5 * (boxMax - boxMin);
    if (light.emitter.shape == shapeDistant) return false;
    vec3 tileMiddle = 0.5 * (bounds.low + bounds.high) - light.center;
    vec3 tileExtent = 0.5 * (bounds.high - bounds.low);
    float reach = length(tileMiddle) + length(tileExtent);
    if (isFlat()) {
        float height = abs(dot(light.axisZ, middle)) - dot(abs(light.axisZ), extent);
        float farthest = length(middle) + length(extent) + length(light.emitter.halfSize);
        return height <= max(2e-5 * reach, 1.001 * light.planeTolerance * farthest);
    }
    // The sphere's near pole, or the tube's near line, for receivers whose direction there differs a little from the
    // tile's. Of a tube only what is across it counts.
    float radius = isTube() ? light.emitter.halfSize.y : light.emitter.halfSize.x;
    if (isTube()) {
        tileMiddle -= dot(tileMiddle, light.axisX) * light.axisX;
        middle -= dot(middle, light.axisX) * light.axisX;
    }
    float nearest = length(tileMiddle) - length(tileExtent);
    if (nearest <= radius) return true;
    vec3 axis = -normalize(tileMiddle);
    float deviation = 1.5 * length(tileExtent) / nearest;
    float before = -dot(axis, middle) - dot(abs(axis), extent) - deviation * (length(middle) + length(extent));
    return before <= radius + 2e-5 * reach;
}

// Whether a horizon cuts the light for any of the receivers that see it. Nobody asks where `isKnown`.
bool isCutForAny(ivec2 corner, bool isKnown) {
    bool isCut = false;
    for (int i = 0; i < EXACT_TILE * EXACT_TILE && !isKnown && !isCut; ++i) {
        ivec2 pixel = corner + ivec2(i % EXACT_TILE, i / EXACT_TILE);
        Receiver receiver;
        if (any(greaterThanEqual(pixel, view.size_px)) || !loadReceiver(pixel, receiver)) continue;
        isCut = canSeeLight(receiver, apexOf(receiver)) && !canSeeWholeLight(receiver);
    }
    return isCut;
}

void store(ivec2 pixel, float value) {
    imageStore(visibility, pixel, vec4(vec3(value), 1.0));
    imageStore(errorBound, pixel, vec4(0.0));
}

// All of the light, or none, for each pixel: `isKnown` where it is the same for all receivers, which then see `seen`.
void settle(ivec2 corner, bool isKnown, float seen) {
    for (int i = 0; i < EXACT_TILE * EXACT_TILE && isKnown; ++i) {
        ivec2 pixel = corner + ivec2(i % EXACT_TILE, i / EXACT_TILE);
        if (all(lessThan(pixel, view.size_px))) store(pixel, isReceiver(pixel) ? seen : 1.0);
    }
    for (int i = 0; i < EXACT_TILE * EXACT_TILE && !isKnown; ++i) {
        ivec2 pixel = corner + ivec2(i % EXACT_TILE, i / EXACT_TILE);
        Receiver receiver;
        if (any(greaterThanEqual(pixel, view.size_px))) continue;
        store(pixel, loadReceiver(pixel, receiver) && !canSeeLight(receiver, apexOf(receiver)) ? 0.0 : 1.0);
    }
}

void main() {
    uint tile = gl_GlobalInvocationID.x;
    ivec2 tiles = (view.size_px + EXACT_TILE - 1) / EXACT_TILE;
    if (tile >= uint(tiles.x * tiles.y)) return;
    ivec2 corner = EXACT_TILE * ivec2(int(tile) % tiles.x, int(tile) / tiles.x);
    uint revision = max(tileRevisions[tile], weightsChangedAt) + 1u;
    bool isSame = keeping.keeps && madeAt[tile] == revision;
    if (isSame && keeping.changedBoxes == 0) return;
    TileBounds bounds = tileBounds[tile];
    bool isAllDark = isDark(bounds), isKnown = isAllDark || isAboveHorizon(bounds);

    Shaft shaft = shaftOf(bounds);
    Sides sides = sidesOf(bounds);

    // Casters that are in nobody's way now, and were not before, change nothing.
    for (int i = 0; i < keeping.changedBoxes && isSame && !isAllDark; ++i)
        isSame = !mayBlockTile(shaft, sides, bounds, TreeNode(changed[2 * i].xyz, changed[2 * i + 1].xyz, 0u, 0u));
    if (isSame) return;
    // Where a horizon cuts a picture's light, its texels are looked up, and nobody tells when they change.
    madeAt[tile] = keeping.keeps && (isKnown || !light.emitter.isTextured) ? revision : 0u;

    Leeway leeway = Leeway(bounds.low, bounds.high, leewayPerMetre(bounds));

    // Plain nodes from the front of the tile's part of the lists, those that take a test a sample from its back.
    uint capacity = uint(frame.tileCapacity);
    uint first = tile * capacity;
    uint plain = 0u, special = 0u, large = 0u;
    float size = wholeSize(bounds);
    Walk walk = Walk(!isAllDark && light.nodeCount > 0 ? 0u : EXACT_END, EXACT_END);
    uint caster = EXACT_INNER;  // whose subtree we are in, as the tree over the casters has it
    uint node = 0u;             // looked at last,
    uint triangle = 0u, end = 0u;  // and which of its triangles have not been looked at
    bool isSpecial = false, isOfLarge = false, isListed = false;
    Borders borders = noBorders();
    // Whoever does not get to the end here leaves the rest to the receivers.
    const int longestWalk = 40000;
    for (int step_ = 0; !isAllDark && (triangle < end || (step_ < longestWalk && walk.node != EXACT_END && plain + special < capacity));
         ++step_) {
        bool lists = triangle < end;
        if (lists) {
            bool mayHide = mayHideFromTile(bounds, sides, triangle);
            isAllDark = mayHide && !isSpecial && hidesAll(bounds, triangle, borders);
            lists = mayHide && !isListed;
            ++triangle;
        } else {
            node = walk.node;
            TreeNode visited = loadNode(node);
            bool isHit = mayBlockTile(shaft, sides, bounds, visited);
            isSpecial = (caster & (EXACT_MASKED | EXACT_PANE)) != 0u || mayReachLight(bounds, visited.boxMin, visited.boxMax);
            isOfLarge = isLarge(bounds, visited);
            isListed = false;
            lists = isHit && isInner(visited) && caster != EXACT_INNER && isSmall(bounds, size, visited);
            if (isHit && hasTriangles(visited)) {
                triangle = firstTriangle(visited.leaf);
                end = triangle + triangleCount(visited.leaf);
            }
            bool enters = isHit && !lists;
            bool leaves = visited.skip == EXACT_END && !(enters && isInner(visited));
            walk = advance(walk, visited, enters, leeway);
            bool isCaster = !isInner(visited) && (visited.leaf & EXACT_SUBTREE) != 0u;
            if (isCaster) caster = enters ? visited.leaf : EXACT_INNER;
            else if (leaves) caster = EXACT_INNER;
        }
        if (lists) {
            uint place = isSpecial ? capacity - 1u - special : plain;
            // What is large comes first, for who is dark looks at no more.
            if (isOfLarge && !isSpecial) {
                candidates[first + plain] = candidates[first + large];
                place = large;
                ++large;
            }
            candidates[first + place] = node;
            plain += isSpecial ? 0u : 1u;
            special += isSpecial ? 1u : 0u;
            isListed = true;
            if (!isOfLarge) triangle = end;
        }
    }
    if (isAllDark) {
        plain = special = 0u;
        walk = Walk(EXACT_END, EXACT_END);
    }
    tileLists[tile] = TileList(leeway.low, leeway.perMetre, leeway.high, plain, special, walk.node, walk.returnTo);

    // Nothing is in the way: the pixels see all of the light, or none of it where it is behind their horizons. (Of a
    // texture a channel may emit nothing, of which nobody sees anything.)
    bool isOpen = plain + special == 0u && walk.node == EXACT_END && !light.emitter.isTextured;
    if (isAllDark || (isOpen && !isCutForAny(corner, isKnown))) {
        settle(corner, isKnown || isAllDark, isAllDark ? 0.0 : 1.0);
    } else {
        uint place = atomicAdd(busy.count, 1u);
        busyTiles[place] = tile;
        atomicMax(busy.groupsX, min(place + 1u, EXACT_GROUPS_ACROSS));
        atomicMax(busy.groupsY, place / EXACT_GROUPS_ACROSS + 1u);
        busy.groupsZ = 1u;
    }
}
