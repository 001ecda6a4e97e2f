// SPDX-License-Identifier: Apache-2.0
// The casters' triangles and the tree over them (caster_soup.h).
layout(rgba32ui) uniform readonly uimageBuffer treeNodes;
layout(rgba32ui) uniform readonly uimageBuffer triangles;

struct TreeNode {
    vec3 boxMin, boxMax;
    uint skip, leaf;
};

TreeNode loadNode(uint node) {
    uvec4 low = imageLoad(treeNodes, int(2u * node));
    uvec4 high = imageLoad(treeNodes, int(2u * node + 1u));
    return TreeNode(uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), low.w, high.w);
}

vec3 loadCorner(uint triangle, uint corner) {
    return uintBitsToFloat(imageLoad(triangles, int(3u * triangle + corner)).xyz);
}

// What lies in the plane of a flat light hides nothing of it.
bool isInLightPlane(uint triangle) {
    return isFlat() && liesInLightPlane(loadCorner(triangle, 0u)) && liesInLightPlane(loadCorner(triangle, 1u)) &&
           liesInLightPlane(loadCorner(triangle, 2u));
}

bool hasStandIn(TreeNode node) { return (node.leaf & ~EXACT_FIRST) == EXACT_STAND_IN; }
bool isInner(TreeNode node) { return node.leaf == EXACT_INNER || hasStandIn(node); }

// Receivers, and how far a blocker may be from where it is, by its distance from them: what may stand in for it.
struct Leeway {
    vec3 low, high;  // of the receivers
    float perMetre;
};

// The first node below an inner one: its child, or what stands in for all below it where that is near enough to it.
uint firstBelow(uint at, TreeNode node, Leeway leeway) {
    if (!hasStandIn(node) || leeway.perMetre <= 0.0) return at + 1u;
    uint header = node.leaf & EXACT_FIRST;
    float deviation = loadNode(header).boxMin.x;
    vec3 apart = max(max(node.boxMin - leeway.high, leeway.low - node.boxMax), vec3(0.0));
    return deviation < leeway.perMetre * length(apart) ? header + 1u : at + 1u;
}

// A place in a walk through the tree: nothing else is needed to go on from there.
struct Walk {
    uint node;      // EXACT_END: over
    uint returnTo;  // the node of the tree over the casters that follows the subtree we are in
};

// The next place, after `node` has been looked at.
Walk advance(Walk walk, TreeNode node, bool isHit, Leeway leeway) {
    if (isHit && isInner(node)) return Walk(firstBelow(walk.node, node, leeway), walk.returnTo);
    if (isHit && (node.leaf & EXACT_SUBTREE) != 0u) return Walk(node.leaf & EXACT_FIRST, node.skip);
    if (node.skip == EXACT_END) return Walk(walk.returnTo, EXACT_END);
    return Walk(node.skip, walk.returnTo);
}

bool hasTriangles(TreeNode node) { return !isInner(node) && (node.leaf & EXACT_SUBTREE) == 0u; }
uint firstTriangle(uint leaf) { return leaf & EXACT_FIRST; }
uint triangleCount(uint leaf) { return (leaf >> EXACT_COUNT_SHIFT & 3u) + 1u; }

// All segments between the boxes of receivers and of the light. Along each axis such a segment, at the share t of its
// length, lies between the boxes' lower sides and between their upper sides at t; a blocker must be in between for one
// t on all axes.
struct Shaft {
    vec3 fromMin, fromMax;   // of the receivers
    vec3 inverseLower, inverseUpper;  // 1 / slope of both sides
    float end;               // of t
};

vec3 inverseSlope(vec3 slope) { return 1.0 / mix(slope, vec3(1e-20), lessThan(abs(slope), vec3(1e-20))); }

bool mayBlock(Shaft shaft, vec3 boxMin, vec3 boxMax) {
    const float infinity = 3e38;
    vec3 lower = (boxMax - shaft.fromMin) * shaft.inverseLower;
    vec3 upper = (boxMin - shaft.fromMax) * shaft.inverseUpper;
    bvec3 lowerRises = greaterThan(shaft.inverseLower, vec3(0.0));
    bvec3 upperRises = greaterThan(shaft.inverseUpper, vec3(0.0));
    vec3 ends = min(mix(vec3(infinity), lower, lowerRises), mix(upper, vec3(infinity), upperRises));
    vec3 begins = max(mix(lower, vec3(-infinity), lowerRises), mix(vec3(-infinity), upper, upperRises));
    float begin = max(max(begins.x, begins.y), max(begins.z, 0.0));
    float end = min(min(ends.x, ends.y), min(ends.z, shaft.end));
    return begin <= end * 1.00001 + 1e-30;  // ten roundings and more
}
