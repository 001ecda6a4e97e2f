// SPDX-License-Identifier: Apache-2.0
#version 450
// For each tile of 8 x 8 receivers, the nodes of the tree that may stand between them and the light; and, where there are
// none and no horizon cuts the light, what its pixels see. One invocation a tile.
layout(local_size_x = 32) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/exact_visibility/light.glsl"
#include "src/techniques/exact_visibility/tree.glsl"
#include "src/techniques/exact_visibility/underfoot.glsl"
#include "src/techniques/exact_visibility/exact_io.h"

layout(std430) writeonly buffer Candidates { uint candidates[]; };  // light.tileCapacity a tile
layout(std430) writeonly buffer TileLists { TileList tileLists[]; };
layout(std430) buffer Busy { BusyTiles busy; uint busyTiles[]; };
layout(std140) uniform Constants { ExactKeeping keeping; };
layout(std430) readonly buffer TileRevisions { uint tileRevisions[]; };
layout(std430) readonly buffer Weights { uint weightsChangedAt; };
layout(std430) buffer MadeAt { uint madeAt[]; };                 // of the kept tiles, plus 1
layout(std430) readonly buffer ChangedBoxes { vec4 changed[]; };  // low and high
uniform writeonly image2D visibility;
layout(r16f) uniform writeonly image2D errorBound;

struct Bounds {
    vec3 low, high;
    vec3 normal;        // of one of the receivers
    float otherNormal;  // how far those of the others are from it
    float lowest;       // the least of dot(normal, position)
    int count;
    bool isCut;         // a horizon may cut the light
};

bool canSeeLight(Receiver receiver, vec3 apex) {
    SeenLight seen = seeLight(apex);
    if (seen.patches == 0) return false;
    if (light.emitter.shape == shapeDistant) {
        // The nearest the cone comes to the normal.
        float sine = sqrt(max(1.0 - light.coneCosine * light.coneCosine, 0.0));
        return dot(receiver.normalLight, light.axisZ) > -sine - 1e-5 || light.coneCosine < 0.0;
    }
    vec3 farthest = mix(light.boxMin, light.boxMax, greaterThan(receiver.normalLight, vec3(0.0)));
    return dot(receiver.normalLight, farthest - receiver.posLight) > 0.0;
}

// Whether all of the light is above the horizon, and far from it for what rounding does.
bool canSeeWholeLight(Receiver receiver) {
    if (light.emitter.shape == shapeDistant) {
        float sine = sqrt(max(1.0 - light.coneCosine * light.coneCosine, 0.0));
        return dot(receiver.normalLight, light.axisZ) > sine + 1e-4 && light.coneCosine > 0.0;
    }
    vec3 nearest = mix(light.boxMax, light.boxMin, greaterThan(receiver.normalLight, vec3(0.0))) - receiver.posLight;
    return dot(receiver.normalLight, nearest) > 1e-4 * length(nearest);
}

Bounds boundsOf(ivec2 tile) {
    Bounds bounds = Bounds(vec3(3e38), vec3(-3e38), vec3(0.0), 0.0, 3e38, 0, false);
    for (int i = 0; i < 64; ++i) {
        ivec2 pixel = 8 * tile + ivec2(i & 7, i >> 3);
        Receiver receiver;
        if (any(greaterThanEqual(pixel, view.size_px)) || !loadReceiver(pixel, receiver)) continue;
        vec3 apex = apexOf(receiver);
        if (!canSeeLight(receiver, apex)) continue;
        if (bounds.count == 0) bounds.normal = receiver.normalLight;
        bounds.otherNormal = max(bounds.otherNormal, distance(bounds.normal, receiver.normalLight));
        bounds.lowest = min(bounds.lowest, dot(bounds.normal, apex));
        bounds.low = min(bounds.low, apex);
        bounds.high = max(bounds.high, apex);
        bounds.isCut = bounds.isCut || !canSeeWholeLight(receiver);
        ++bounds.count;
    }
    return bounds;
}

// Planes that have the tile and the light on one side: what lies beyond one of them is in nobody's way. Each leans so
// far that it touches both.
struct Sides {
    vec4 planes[4];  // normal, and how far along it tile and light reach
};

// `across` is a direction in which the light reaches `size` from its centre, `along` one in which it has no extent; of
// spheres and tubes `radius` is added along the whole normal.
vec4 sideOf(Bounds bounds, vec3 across, vec3 along, float size, float radius) {
    vec3 middle = 0.5 * (bounds.low + bounds.high), extent = 0.5 * (bounds.high - bounds.low);
    bool isDistant = light.emitter.shape == shapeDistant;
    vec3 normal = across;
    for (int i = 0; i < 2 && !isDistant; ++i) {
        vec3 toLight = light.center - middle;
        float ahead = dot(along, toLight);
        float lean = (dot(abs(normal), extent) - size - radius * length(normal) - dot(across, toLight)) /
                     (abs(ahead) > 1e-20 ? ahead : 1e-20);
        normal = across + clamp(lean, -1e3, 1e3) * along;
    }
    // Of a distant light's directions none leads across the plane, unless they fill half of the sky.
    if (isDistant && light.coneCosine <= 0.0) return vec4(normal, 3e38);
    if (isDistant) normal = light.coneCosine * across - sqrt(max(1.0 - light.coneCosine * light.coneCosine, 0.0)) * along;
    float ofTile = dot(normal, middle) + dot(abs(normal), extent);
    float ofLight = dot(normal, light.center) + size + radius * length(normal);
    float reach = isDistant ? ofTile : max(ofTile, ofLight);
    vec3 largest = abs(middle) + extent + abs(light.center) + size + radius;
    return vec4(normal, reach + 4e-6 * dot(abs(normal), largest));
}

Sides sidesOf(Bounds bounds) {
    vec3 middle = 0.5 * (bounds.low + bounds.high);
    vec3 x = light.axisX, y = light.axisY, along = light.axisZ;
    vec2 size = light.emitter.halfSize;
    float radius = 0.0;
    if (light.emitter.shape == shapeSphere) {
        radius = size.x;
        size = vec2(0.0);
        vec3 toLight = light.center - middle;
        along = dot(toLight, toLight) > 0.0 ? normalize(toLight) : along;
        x = perpendicularTo(along);
        y = cross(along, x);
    } else if (isTube()) {
        radius = size.y;
        size.y = 0.0;
        vec3 toLight = light.center - middle;
        toLight -= dot(toLight, x) * x;
        if (dot(toLight, toLight) > 0.0) along = normalize(toLight);
        y = cross(along, x);
    } else if (light.emitter.shape == shapeDistant) {
        size = vec2(0.0);
    }
    return Sides(vec4[](sideOf(bounds, x, along, size.x, radius), sideOf(bounds, -x, along, size.x, radius),
                        sideOf(bounds, y, along, size.y, radius), sideOf(bounds, -y, along, size.y, radius)));
}

bool isBeyond(vec4 plane, vec3 a, vec3 b, vec3 c) {
    return min(dot(plane.xyz, a), min(dot(plane.xyz, b), dot(plane.xyz, c))) > plane.w;
}

bool isBoxBeyond(vec4 plane, vec3 middle, vec3 extent) {
    return dot(plane.xyz, middle) - dot(abs(plane.xyz), extent) > plane.w + 2e-6 * dot(abs(plane.xyz), abs(middle));
}

// Whether a box may be in the way. What is below all receivers' planes is not.
bool mayBlockTile(Shaft shaft, Sides sides, Bounds bounds, TreeNode node) {
    vec3 middle = 0.5 * (node.boxMin + node.boxMax), extent = 0.5 * (node.boxMax - node.boxMin);
    vec3 away = abs(middle - 0.5 * (bounds.low + bounds.high)) + extent + 0.5 * (bounds.high - bounds.low);
    float height = dot(bounds.normal, middle) + dot(abs(bounds.normal), extent) - bounds.lowest +
                   (bounds.otherNormal + 1e-6) * (away.x + away.y + away.z);
    bool isBeside = isBoxBeyond(sides.planes[0], middle, extent) || isBoxBeyond(sides.planes[1], middle, extent) ||
                    isBoxBeyond(sides.planes[2], middle, extent) || isBoxBeyond(sides.planes[3], middle, extent);
    return height > 0.0 && !isBeside && mayBlock(shaft, node.boxMin, node.boxMax);
}

// Whether all receivers lie on the triangle (see underfoot.glsl, whose tolerance is twice this), or above it.
bool isUnderfootOfTile(Bounds bounds, vec3 a, vec3 b, vec3 c) {
    vec3 middle = 0.5 * (bounds.low + bounds.high), extent = 0.5 * (bounds.high - bounds.low);
    vec3 across = cross(b - a, c - a);
    vec3 normal = sign(dot(across, bounds.normal)) * normalize(across);
    float tilt = distance(normal, bounds.normal) + bounds.otherNormal;
    vec3 sizes = max(abs(a - middle), max(abs(b - middle), abs(c - middle)));
    float size = max(sizes.x, max(sizes.y, sizes.z));
    float height = dot(normal, a - middle) - (bounds.lowest - dot(bounds.normal, middle)) + tilt * length(extent) +
                   4e-7 * length(middle);
    return tilt < 0.1 && 4.0 * length(extent) < size && height <= 0.5 * cornerRoundings * rounding * size;
}

// The same as mayBlockTile, for a triangle.
bool mayHideFromTile(Bounds bounds, Sides sides, uint triangle) {
    vec3 a = loadCorner(triangle, 0u), b = loadCorner(triangle, 1u), c = loadCorner(triangle, 2u);
    bool isBeside = isBeyond(sides.planes[0], a, b, c) || isBeyond(sides.planes[1], a, b, c) ||
                    isBeyond(sides.planes[2], a, b, c) || isBeyond(sides.planes[3], a, b, c);
    return !isBeside && !isUnderfootOfTile(bounds, a, b, c) && !isInLightPlane(triangle);
}

// Of what size things are, far from the tile by a metre, between which and the light's samples there is no more to gain
// from looking at their parts: about two samples apart.
float wholeSize(Bounds bounds) {
    float spacing = length(light.uvFromI);
    if (light.emitter.shape == shapeDistant) return 2.0 * spacing * min(light.emitter.halfSize.x, widestTangent);
    float distance_m = distance(light.center, 0.5 * (bounds.low + bounds.high));
    return 2.0 * spacing * min(max(light.emitter.halfSize.x, light.emitter.halfSize.y) / distance_m, widestTangent);
}

// Whether a node is listed as a whole. Any choice gives the same result.
bool isSmall(Bounds bounds, float size, TreeNode node) {
    float away = distance(0.5 * (node.boxMin + node.boxMax), 0.5 * (bounds.low + bounds.high));
    return 0.5 * distance(node.boxMin, node.boxMax) < size * away;
}

// Whether a box may reach the light, so that it depends on the sample what blocks; or its plane.
bool mayReachLight(Bounds bounds, vec3 boxMin, vec3 boxMax) {
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

void settle(ivec2 tile) {
    for (int i = 0; i < 64; ++i) {
        ivec2 pixel = 8 * tile + ivec2(i & 7, i >> 3);
        Receiver receiver;
        if (any(greaterThanEqual(pixel, view.size_px))) continue;
        bool isDark = loadReceiver(pixel, receiver) && !canSeeLight(receiver, apexOf(receiver));
        imageStore(visibility, pixel, vec4(vec3(isDark ? 0.0 : 1.0), 1.0));
        imageStore(errorBound, pixel, vec4(0.0));
    }
}

void main() {
    uint tile = gl_GlobalInvocationID.x;
    ivec2 tiles = (view.size_px + 7) / 8;
    if (tile >= uint(tiles.x * tiles.y)) return;
    ivec2 tileOf = ivec2(int(tile) % tiles.x, int(tile) / tiles.x);
    uint revision = max(tileRevisions[tile], weightsChangedAt) + 1u;
    bool isSame = keeping.keeps && madeAt[tile] == revision;
    if (isSame && keeping.changedBoxes == 0) return;
    Bounds bounds = boundsOf(tileOf);

    float pad = 1e-6 * (max(max(abs(bounds.low.x), abs(bounds.high.x)), max(abs(bounds.low.y), abs(bounds.high.y))) +
                        max(abs(bounds.low.z), abs(bounds.high.z)));
    bounds.low -= pad;
    bounds.high += pad;
    bool isDistant = light.emitter.shape == shapeDistant;
    Shaft shaft;
    shaft.fromMin = bounds.low;
    shaft.fromMax = bounds.high;
    shaft.inverseLower = inverseSlope(isDistant ? light.boxMin : light.boxMin - bounds.low);
    shaft.inverseUpper = inverseSlope(isDistant ? light.boxMax : light.boxMax - bounds.high);
    shaft.end = isDistant ? 3e37 : 1.0;

    Sides sides = sidesOf(bounds);

    // Casters that are in nobody's way now, and were not before, change nothing.
    for (int i = 0; i < keeping.changedBoxes && isSame && bounds.count > 0; ++i)
        isSame = !mayBlockTile(shaft, sides, bounds, TreeNode(changed[2 * i].xyz, changed[2 * i + 1].xyz, 0u, 0u));
    if (isSame) return;
    // Where a horizon cuts a picture's light, its texels are looked up, and nobody tells when they change.
    madeAt[tile] = keeping.keeps && !(bounds.isCut && light.emitter.isTextured) ? revision : 0u;

    // Plain nodes from the front of the tile's part of the lists, those that take a test a sample from its back.
    uint capacity = uint(light.tileCapacity);
    uint first = tile * capacity;
    uint plain = 0u, special = 0u;
    float size = wholeSize(bounds);
    Walk walk = Walk(bounds.count > 0 && light.nodeCount > 0 ? 0u : EXACT_END, EXACT_END);
    uint caster = EXACT_INNER;  // whose subtree we are in, as the tree over the casters has it
    uint node = 0u;             // looked at last,
    uint triangle = 0u, end = 0u;  // and which of its triangles have not been looked at
    bool isSpecial = false;
    // Whoever does not get to the end here leaves the rest to the receivers.
    const int longestWalk = 40000;
    for (int step_ = 0; triangle < end || (step_ < longestWalk && walk.node != EXACT_END && plain + special < capacity); ++step_) {
        bool lists = triangle < end;
        if (lists) {
            lists = mayHideFromTile(bounds, sides, triangle);
            ++triangle;
        } else {
            node = walk.node;
            TreeNode visited = loadNode(node);
            bool isHit = mayBlockTile(shaft, sides, bounds, visited);
            isSpecial = (caster & EXACT_MASKED) != 0u || mayReachLight(bounds, visited.boxMin, visited.boxMax);
            lists = isHit && visited.leaf == EXACT_INNER && caster != EXACT_INNER && isSmall(bounds, size, visited);
            if (isHit && hasTriangles(visited)) {
                triangle = firstTriangle(visited.leaf);
                end = triangle + triangleCount(visited.leaf);
            }
            bool enters = isHit && !lists;
            bool leaves = visited.skip == EXACT_END && !(enters && visited.leaf == EXACT_INNER);
            walk = advance(walk, visited, enters);
            bool isCaster = visited.leaf != EXACT_INNER && (visited.leaf & EXACT_SUBTREE) != 0u;
            if (isCaster) caster = enters ? visited.leaf : EXACT_INNER;
            else if (leaves) caster = EXACT_INNER;
        }
        if (lists) {
            uint place = isSpecial ? capacity - 1u - special : plain;
            candidates[first + place] = node;
            plain += isSpecial ? 0u : 1u;
            special += isSpecial ? 1u : 0u;
            triangle = end;
        }
    }
    tileLists[tile] = TileList(plain, special, walk.node, walk.returnTo);

    // Nothing is in the way: the pixels see all of the light, or none of it where it is behind their horizons. (Of a
    // texture a channel may emit nothing, of which nobody sees anything.)
    if (plain + special == 0u && walk.node == EXACT_END && !bounds.isCut && !light.emitter.isTextured) {
        settle(tileOf);
    } else {
        uint place = atomicAdd(busy.count, 1u);
        busyTiles[place] = tile;
        atomicMax(busy.groupsX, min(place + 1u, EXACT_GROUPS_ACROSS));
        atomicMax(busy.groupsY, place / EXACT_GROUPS_ACROSS + 1u);
        busy.groupsZ = 1u;
    }
}
