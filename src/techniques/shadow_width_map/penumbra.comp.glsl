// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, second pass: visibility past the nearest edges, where resolve.comp.glsl found them near enough.
layout(local_size_x = 64) in;

#include "src/techniques/shadow_width_map/receiving.glsl"
#include "src/techniques/shadow_width_map/footprint.glsl"
#include "src/techniques/shadow_width_map/edge_cells.glsl"
#include "src/techniques/shadow_width_map/penumbra_pixels.glsl"

layout(binding = 4) uniform usampler2DArray nearestEdges;

// What an edge is to a receiver.
struct Division {
    bool isEdge;      // it stands above the receiver's horizon, and what is behind it lets light through
    bool isBehindToo; // it stands there, but what is behind it blocks as well
    vec2 way_px;      // from the receiver's place in the map to the edge
    float width_px;   // its length
};

Division divide(Receiving r, uvec4 edge, bool isInner) {
    Division division;
    float stored = storedAtEdge(edge);
    bool stands = isEdge(edge) && nearnessOf(r.depth, stored) > r.nearness && isAbove(r, edgeTexel(edge), stored);
    division.isBehindToo = stands && isInner && isAbove(r, texelBehind(edge), storedBehindEdge(edge));
    division.isEdge = stands && !division.isBehindToo;
    division.way_px = nearestOnEdge(edge, r.place_px, float(constants.cells.x)) - r.place_px;
    division.width_px = isEdge(edge) ? length(division.way_px) : 1e9;
    return division;
}

// The light that is seen past an edge of a blocker at a nearness, from its lit or its blocked side.
float seenPast(Receiving r, Footprint footprint, uvec4 edge, Division division, float blocker, bool isBlocked) {
    // Beside the edge, its line tells the sides apart, which cuts texels in two.
    float behind_px = -dot(division.way_px, normalOf(edge));
    bool isBeyond = division.width_px < 1.0 ? behind_px < 0.0 : isBlocked;
    vec2 extents = halfExtents(footprint, division.way_px / max(division.width_px, 1e-3));
    extents *= max(blocker - r.nearness, 0.0);
    float distance = division.width_px * r.depth.w;
    if (distance >= extents.x + extents.y) return isBeyond ? 0.0 : 1.0;
    return shareBelow(extents, isBeyond ? -distance : distance);
}

// Visibility by the edges that are nearest to a cell.
float seenFromCell(Receiving r, Footprint footprint, ivec2 cell, bool isBlocked, float own) {
    uvec4 outline = texelFetch(nearestEdges, ivec3(cell, r.camera), 0), inner = uvec4(0u);
    if (constants.light.w == 1) inner = texelFetch(nearestEdges, ivec3(cell, r.camera + constants.light.y), 0);
    Division outlineDivides = divide(r, outline, false), innerDivides = divide(r, inner, true);

    // In the shadow of several blockers, the deepest is hardest to see past. A blocker that reaches up to an inner edge
    // from behind most likely goes on beneath the one before it.
    float deepest = own;
    float seen = isBlocked ? 0.0 : 1.0;
    if (innerDivides.isEdge) {
        float blocker = nearnessOf(r.depth, storedAtEdge(inner));
        seen = seenPast(r, footprint, inner, innerDivides, isBlocked ? min(blocker, own) : blocker, isBlocked);
    } else if (isBlocked && innerDivides.isBehindToo && innerDivides.width_px < outlineDivides.width_px) {
        deepest = min(deepest, nearnessOf(r.depth, storedBehindEdge(inner)));
    }
    if (outlineDivides.isEdge) {
        float blocker = nearnessOf(r.depth, storedAtEdge(outline));
        float past = seenPast(r, footprint, outline, outlineDivides, isBlocked ? min(blocker, deepest) : blocker, isBlocked);
        seen = isBlocked ? max(seen, past) : min(seen, past);
    }
    return seen;
}

float seenBy(Receiver receiver) {
    Receiving r;
    if (!isFacing(receiver, true)) return 0.0;
    if (!startReceiving(receiver, r)) return 1.0;
    ivec2 texel = ivec2(r.place_px);
    float stored = texelFetch(depthMaps, ivec3(texel, r.camera), 0).r;
    bool isBlocked = isAbove(r, texel, stored);
    Footprint footprint = footprintOf(r);

    // Visibility is interpolated between cells; neither widths nor depths mean anything in between.
    vec2 place = r.place_px / float(constants.cells.x) - 0.5;
    ivec2 corner = ivec2(floor(place));
    vec2 weight = place - vec2(corner);
    float seen = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 cell = clamp(corner + offset, ivec2(0), ivec2(constants.cells.y - 1));
        vec2 share = mix(1.0 - weight, weight, vec2(offset));
        seen += share.x * share.y * seenFromCell(r, footprint, cell, isBlocked, nearnessOf(r.depth, stored));
    }
    return clamp(seen, 0.0, 1.0);
}

void main() {
    if (gl_GlobalInvocationID.x >= pixelCount) return;
    uint place = penumbraPixels[gl_GlobalInvocationID.x];
    ivec2 pixel = ivec2(place & 0xffffu, place >> 16);
    Receiver receiver;
    imageStore(visibility, pixel, vec4(loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0));
}
