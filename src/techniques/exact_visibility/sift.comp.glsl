// SPDX-License-Identifier: Apache-2.0
#version 450
// Points lie far apart, and of those of a busy tile most see all of a light or nothing, each for a reason of its own: nothing
// is in its way, or one triangle is in all of it. That is found here with a look or two; parts of tiles with a point for which
// it is not are listed. One invocation a part, which looks at its receivers one after the other.
layout(local_size_x = 8) in;

#include "src/techniques/exact_visibility/receivers.glsl"
#include "src/techniques/exact_visibility/light.glsl"
#include "src/techniques/exact_visibility/tree.glsl"
#include "src/techniques/exact_visibility/underfoot.glsl"
#include "src/techniques/exact_visibility/shafts.glsl"
#include "src/techniques/exact_visibility/exact_io.h"

layout(std430) readonly buffer Candidates { uint candidates[]; };
layout(std430) readonly buffer TileLists { TileList tileLists[]; };
layout(std430) readonly buffer Busy { BusyTiles busy; uint busyTiles[]; };
layout(std430) buffer Parts { BusyTiles parts; uint busyParts[]; };
uniform writeonly image2D visibility;
layout(r16f) uniform writeonly image2D errorBound;

// What a receiver sees where it has to be looked at sample by sample.
const float inPart = -1.0;

// A tile of one.
TileBounds boundsOf(Receiver receiver, vec3 apex) {
    vec3 size = abs(apex);
    float pad = 1e-6 * (max(size.x, size.y) + size.z);
    float height = dot(receiver.normalLight, apex);
    return TileBounds(apex - pad, height, apex + pad, height, receiver.normalLight, 0.0);
}

float seenFrom(ivec2 pixel, TileList list, uint first, uint last) {
    Receiver receiver;
    if (!loadReceiver(pixel, receiver)) return 1.0;
    vec3 apex = apexOf(receiver);
    if (!canSeeLight(receiver, apex)) return 0.0;
    TileBounds bounds = boundsOf(receiver, apex);
    Shaft shaft = shaftOf(bounds);
    Sides sides = sidesOf(bounds);
    bool isHidden = false, isMet = false, isPlain = false;
    uint next = 0u;                // of the list
    uint node = 0u, after = 0u;    // below one of it: looked at next, and where that ends
    uint triangle = 0u, end = 0u;  // of a leaf, which have not been looked at
    Borders borders = noBorders();
    const int longest = 2000;
    int step_ = 0;
    for (; step_ < longest && !isHidden && (triangle < end || node != after || next < list.plain + list.special); ++step_) {
        if (triangle < end) {
            bool mayHide = mayHideFromTile(bounds, sides, triangle);
            isMet = isMet || mayHide;
            isHidden = mayHide && isPlain && hidesAll(bounds, triangle, borders);
            ++triangle;
        } else {
            bool begins = node == after;
            if (begins) {
                isPlain = next < list.plain;
                node = candidates[isPlain ? first + next : last - (next - list.plain)];
                ++next;
            }
            TreeNode visited = loadNode(node);
            bool isHit = mayBlockTile(shaft, sides, bounds, visited);
            if (begins) after = visited.skip;
            if (isHit && hasTriangles(visited)) {
                triangle = firstTriangle(visited.leaf);
                end = triangle + triangleCount(visited.leaf);
            }
            node = isHit && isInner(visited) ? node + 1u : visited.skip;
        }
    }
    if (isHidden) return 0.0;
    return !isMet && step_ < longest && canSeeWholeLight(receiver) ? 1.0 : inPart;
}

void main() {
    uint place = gl_WorkGroupID.y * EXACT_GROUPS_ACROSS + gl_WorkGroupID.x;
    if (place >= busy.count) return;
    uint tileIndex = busyTiles[place];
    ivec2 corner = EXACT_TILE * ivec2(int(tileIndex) % frame.tilesAcross, int(tileIndex) / frame.tilesAcross);
    TileList list = tileLists[tileIndex];
    uint first = tileIndex * uint(frame.tileCapacity), last = first + uint(frame.tileCapacity) - 1u;
    int part = int(gl_LocalInvocationID.x);
    // Of a list that was too short, and of pictures on lights, everything is left.
    bool isAnyLeft = list.stoppedAt != EXACT_END || light.emitter.isTextured;
    bool looks = !isAnyLeft;
    for (int i = 0; looks && i < EXACT_TILE_PARTS; ++i) {
        ivec2 pixel = corner + placeInTile(ivec2(i, part));
        float seen = seenFrom(min(pixel, view.size_px - 1), list, first, last);
        isAnyLeft = isAnyLeft || seen == inPart;
        if (seen == inPart || any(greaterThanEqual(pixel, view.size_px))) continue;
        imageStore(visibility, pixel, vec4(vec3(seen), 1.0));
        imageStore(errorBound, pixel, vec4(0.0));
    }
    if (!isAnyLeft) return;
    uint at = atomicAdd(parts.count, 1u), group = at / EXACT_TILE_PARTS;
    busyParts[at] = tileIndex * EXACT_TILE_PARTS + uint(part);
    atomicMax(parts.groupsX, min(group + 1u, EXACT_GROUPS_ACROSS));
    atomicMax(parts.groupsY, group / EXACT_GROUPS_ACROSS + 1u);
    parts.groupsZ = 1u;
}
