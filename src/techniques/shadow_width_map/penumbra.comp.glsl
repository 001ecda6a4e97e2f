// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, second pass: visibility past the nearest edges, where resolve.comp.glsl found them near enough.
layout(local_size_x = 64) in;

#include "src/techniques/shadow_width_map/receiving.glsl"
#include "src/techniques/shadow_width_map/footprint.glsl"
#include "src/techniques/shadow_width_map/edge_cells.glsl"
#include "src/techniques/shadow_width_map/penumbra_pixels.glsl"

layout(binding = 4) uniform usampler2DArray nearestEdges;
layout(binding = 5) uniform sampler2DArray farthestMaps;

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

// Of two shares of the footprint, each cut off by a straight edge, what they have in common, the edges' normals having this
// cosine: what two that look against each other leave, the product at a right angle, and all of the first where they look
// the same way, which most likely are two pieces of one edge.
float inCommon(float share, float other, float cosine) {
    if (cosine > 0.0) return mix(share * other, share, smoothstep(0.0, 0.7, cosine));
    return mix(share * other, max(share + other - 1.0, 0.0), asin(min(-cosine, 1.0)) / 1.57079633);
}

uvec4 nearestTo(vec2 place_px, int layer) {
    ivec2 cell = clamp(ivec2(place_px) / constants.cells.x, ivec2(0), ivec2(constants.cells.y - 1));
    return texelFetch(nearestEdges, ivec3(cell, layer), 0);
}

// The unit vector from what a division's edge blocks to what it leaves; beside the edge, its line's normal.
vec2 outward(Division division, uvec4 edge) {
    vec2 normal = normalOf(edge);
    if (division.width_px < 1.0) return normal;
    return division.way_px / (dot(division.way_px, normal) < 0.0 ? -division.width_px : division.width_px);
}

// What is seen past the nearest edge and also past the nearest ones to places as far away as its penumbra reaches, on either
// side: the other side of a blocker that is narrower than its penumbra, or another blocker across a gap. From those places
// they are nearer than the edge itself whenever they matter, so that they come and go where they change nothing.
float seenAmong(Receiving r, Footprint footprint, float seen, float deepest) {
    int layer = r.camera;
    uvec4 edge = nearestTo(r.place_px, layer);
    Division division = divide(r, edge, false);
    if (constants.light.w > 1) {
        uvec4 inner = nearestTo(r.place_px, layer + constants.light.y);
        Division innerDivides = divide(r, inner, true);
        if (innerDivides.isEdge && !(division.isEdge && division.width_px < innerDivides.width_px)) {
            layer += constants.light.y;
            edge = inner;
            division = innerDivides;
        }
    }
    if (!division.isEdge) return seen;
    vec2 across = division.way_px / max(division.width_px, 1e-3), away = outward(division, edge);
    float above = nearnessOf(r.depth, storedAtEdge(edge)) - r.nearness;
    vec2 extents = halfExtents(footprint, across) * max(above, 0.0);
    float reach_px = (extents.x + extents.y) / r.depth.w;
    for (int side = 0; side < 2; ++side) {
        uvec4 other = nearestTo(r.place_px + across * (side == 0 ? -reach_px : division.width_px + reach_px), layer);
        // Its line is known well only where it is: so the edge where the line is nearest.
        vec2 normal = normalOf(other);
        other = nearestTo(r.place_px + dot(middleOf(other) - r.place_px, normal) * normal, layer);
        Division otherDivides = divide(r, other, layer >= constants.light.y);
        if (!otherDivides.isEdge) continue;
        float blocker = nearnessOf(r.depth, storedAtEdge(other));
        vec2 otherAway = outward(otherDivides, other);
        vec2 otherExtents = halfExtents(footprint, otherAway) * max(min(blocker, deepest) - r.nearness, 0.0);
        float distance = -dot(otherDivides.way_px, otherAway) * r.depth.w;
        bool isFar = abs(distance) >= otherExtents.x + otherExtents.y;
        float otherSeen = isFar ? float(distance > 0.0) : shareBelow(otherExtents, distance);
        float cosine = dot(away, otherAway);
        // A convex blocker is what both edges have behind them; around a gap, what is seen is before both.
        bool isConvex = dot(otherDivides.way_px - division.way_px, otherAway - away) >= 0.0;
        float both = isConvex ? 1.0 - inCommon(1.0 - seen, 1.0 - otherSeen, cosine) : inCommon(seen, otherSeen, cosine);
        // Past the end of an edge there is no telling what it bounds; nor do blockers at different heights have an inside
        // in common.
        float weight = smoothstep(0.6, 0.9, abs(dot(otherAway, normalOf(other))));
        if (isConvex) weight *= 1.0 - smoothstep(0.15, 0.4, abs(blocker - r.nearness - above) / max(above, 1e-9));
        seen = mix(seen, both, weight);
    }
    return seen;
}

// Visibility by the edges that are nearest to a cell.
float seenFromCell(Receiving r, Footprint footprint, ivec2 cell, bool isBlocked, float own) {
    uvec4 outline = texelFetch(nearestEdges, ivec3(cell, r.camera), 0), inner = uvec4(0u);
    if (constants.light.w > 1) inner = texelFetch(nearestEdges, ivec3(cell, r.camera + constants.light.y), 0);
    Division outlineDivides = divide(r, outline, false), innerDivides = divide(r, inner, true);

    // In the shadow of several blockers, the deepest is hardest to see past. A blocker that reaches up to an inner edge
    // from behind most likely goes on beneath the one before it.
    float deepest = isBlocked ? own : 3e38;
    float seen = isBlocked ? 0.0 : 1.0;
    if (innerDivides.isEdge) {
        float blocker = nearnessOf(r.depth, storedAtEdge(inner));
        seen = seenPast(r, footprint, inner, innerDivides, min(blocker, deepest), isBlocked);
    } else if (isBlocked && innerDivides.isBehindToo && innerDivides.width_px < outlineDivides.width_px) {
        deepest = min(deepest, nearnessOf(r.depth, storedBehindEdge(inner)));
    }
    if (outlineDivides.isEdge) {
        float blocker = nearnessOf(r.depth, storedAtEdge(outline));
        float past = seenPast(r, footprint, outline, outlineDivides, min(blocker, deepest), isBlocked);
        seen = isBlocked ? max(seen, past) : min(seen, past);
    }
    return seen;
}

// What the farthest blocker lets through where it ends beneath another. Nothing of it is in sight there: the outlines near by
// are the other's. But where an outline is nearer, that is its own.
float seenPastHidden(Receiving r, Footprint footprint, ivec2 cell) {
    uvec4 hidden = texelFetch(nearestEdges, ivec3(cell, r.camera + 2 * constants.light.y), 0);
    Division division = divide(r, hidden, false);
    if (!division.isEdge) return 1.0;
    ivec2 texel = ivec2(r.place_px);
    float farthest = texelFetch(farthestMaps, ivec3(texel, r.camera), 0).r;
    bool isBeneath = farthest < 0.5 * (storedAtEdge(hidden) + storedBehindEdge(hidden));
    if (isBeneath) {
        vec2 toOutline = nearestOnEdge(texelFetch(nearestEdges, ivec3(cell, r.camera), 0), r.place_px,
                                       float(constants.cells.x)) - r.place_px;
        if (length(toOutline) < division.width_px || !isAbove(r, texel, farthest)) return 1.0;
    }
    return seenPast(r, footprint, hidden, division, nearnessOf(r.depth, storedAtEdge(hidden)), isBeneath);
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
    float seen = 0.0, seenAtMost = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 cell = clamp(corner + offset, ivec2(0), ivec2(constants.cells.y - 1));
        vec2 share = mix(1.0 - weight, weight, vec2(offset));
        if (constants.light.w > 2) seenAtMost += share.x * share.y * seenPastHidden(r, footprint, cell);
        seen += share.x * share.y * seenFromCell(r, footprint, cell, isBlocked, nearnessOf(r.depth, stored));
    }
    float deepest = isBlocked ? nearnessOf(r.depth, stored) : 3e38;
    seen = seenAmong(r, footprint, seen, deepest);
    if (constants.light.w > 2) seen = min(seen, seenAtMost);
    return clamp(seen, 0.0, 1.0);
}

void main() {
    if (gl_GlobalInvocationID.x >= pixelCount) return;
    uint place = penumbraPixels[gl_GlobalInvocationID.x];
    ivec2 pixel = ivec2(place & 0xffffu, place >> 16);
    Receiver receiver;
    imageStore(visibility, pixel, vec4(loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0));
}
