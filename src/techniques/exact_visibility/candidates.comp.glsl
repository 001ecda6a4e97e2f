// SPDX-License-Identifier: Apache-2.0
#version 450
// For each tile of 8 x 8 receivers, the triangles that may stand between them and the light. One invocation a tile.
layout(local_size_x = 32) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/exact_visibility/light.glsl"
#include "src/techniques/exact_visibility/tree.glsl"
#include "src/techniques/exact_visibility/tiles.glsl"

layout(std430) writeonly buffer Candidates { uint candidates[]; };  // light.tileCapacity a tile
layout(std430) writeonly buffer TileLists { TileList tileLists[]; };

struct Bounds {
    vec3 low, high;
    vec3 normal;        // of one of the receivers
    float otherNormal;  // how far those of the others are from it
    float lowest;       // the least of dot(normal, position)
    int count;
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

Bounds boundsOf(ivec2 tile) {
    Bounds bounds = Bounds(vec3(3e38), vec3(-3e38), vec3(0.0), 0.0, 3e38, 0);
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
        ++bounds.count;
    }
    return bounds;
}

// Whether a box may be in the way. What is below all receivers' planes is not.
bool mayBlockTile(Shaft shaft, Bounds bounds, vec3 boxMin, vec3 boxMax) {
    vec3 middle = 0.5 * (boxMin + boxMax), extent = 0.5 * (boxMax - boxMin);
    vec3 away = abs(middle - 0.5 * (bounds.low + bounds.high)) + extent + 0.5 * (bounds.high - bounds.low);
    float height = dot(bounds.normal, middle) + dot(abs(bounds.normal), extent) - bounds.lowest +
                   (bounds.otherNormal + 1e-6) * (away.x + away.y + away.z);
    return height > 0.0 && mayBlock(shaft, boxMin, boxMax);
}

// Whether a box may reach the light, so that it depends on the sample what blocks.
bool mayReachLight(Bounds bounds, vec3 boxMin, vec3 boxMax) {
    vec3 middle = 0.5 * (boxMin + boxMax) - light.center, extent = 0.5 * (boxMax - boxMin);
    if (light.emitter.shape == shapeDistant) return false;
    vec3 tileMiddle = 0.5 * (bounds.low + bounds.high) - light.center;
    vec3 tileExtent = 0.5 * (bounds.high - bounds.low);
    float reach = length(tileMiddle) + length(tileExtent);
    if (isFlat()) {
        float height = abs(dot(light.axisZ, middle)) - dot(abs(light.axisZ), extent);
        return height <= 2e-5 * reach;
    }
    // The sphere's near pole, for receivers whose direction towards the centre differs a little from the tile's.
    float nearest = length(tileMiddle) - length(tileExtent);
    if (nearest <= light.emitter.halfSize.x) return true;
    vec3 axis = -normalize(tileMiddle);
    float deviation = 1.5 * length(tileExtent) / nearest;
    float before = -dot(axis, middle) - dot(abs(axis), extent) - deviation * (length(middle) + length(extent));
    return before <= light.emitter.halfSize.x + 2e-5 * reach;
}

void main() {
    uint tile = gl_GlobalInvocationID.x;
    ivec2 tiles = (view.size_px + 7) / 8;
    if (tile >= uint(tiles.x * tiles.y)) return;
    Bounds bounds = boundsOf(ivec2(int(tile) % tiles.x, int(tile) / tiles.x));

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

    // Plain triangles from the front of the tile's part of the lists, those that take a test a sample from its back.
    uint capacity = uint(light.tileCapacity);
    uint first = tile * capacity;
    uint plain = 0u, special = 0u;
    Walk walk = Walk(bounds.count > 0 && light.nodeCount > 0 ? 0u : EXACT_END, EXACT_END);
    // Whoever does not get to the end here leaves the rest to the receivers.
    const int longestWalk = 40000;
    for (int step_ = 0; step_ < min(light.nodeCount, longestWalk) && walk.node != EXACT_END && plain + special < capacity; ++step_) {
        TreeNode node = loadNode(walk.node);
        bool isHit = mayBlockTile(shaft, bounds, node.boxMin, node.boxMax);
        if (isHit && isTriangle(node) && !isInLightPlane(node.leaf & ~EXACT_MASKED)) {
            bool isSpecial = (node.leaf & EXACT_MASKED) != 0u || mayReachLight(bounds, node.boxMin, node.boxMax);
            uint place = isSpecial ? capacity - 1u - special : plain;
            candidates[first + place] = node.leaf;
            plain += isSpecial ? 0u : 1u;
            special += isSpecial ? 1u : 0u;
        }
        walk = advance(walk, node, isHit);
    }
    tileLists[tile] = TileList(plain, special, walk.node, walk.returnTo);

    if (plain + special > 0u) {
        atomicAdd(triangleSum, plain + special);
        atomicMax(largestTile, plain + special);
        atomicAdd(busyTiles, 1u);
        if (walk.node != EXACT_END) atomicAdd(fullTiles, 1u);
    }
}
