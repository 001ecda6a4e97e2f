// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, last of three passes: visibility among several edges, where penumbra.comp.glsl found others than the nearest.
layout(local_size_x = 64) in;

#include "src/techniques/shadow_width_map/divisions.glsl"
#include "src/techniques/shadow_width_map/penumbra_pixels.glsl"
#include "src/techniques/shadow_width_map/proven.glsl"

// Of two shares of the footprint, each cut off by a straight edge, what they have in common, the edges' normals having this
// cosine: what two that look against each other leave, the product at a right angle, and all of the first where they look
// the same way, which most likely are two pieces of one edge.
float inCommon(float share, float other, float cosine) {
    if (cosine > 0.0) return mix(share * other, share, smoothstep(0.0, 0.7, cosine));
    return mix(share * other, max(share + other - 1.0, 0.0), asin(min(-cosine, 1.0)) / 1.57079633);
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
    Nearest n = nearestOf(r, footprint);
    vec2 away = outward(n.division, n.edge);
    for (int side = 0; side < 2; ++side) {
        uvec4 other = nearestTo(side == 0 ? n.behind_px : n.beyond_px, n.layer);
        // Its line is known well only where it is: so the edge where the line is nearest.
        vec2 normal = normalOf(other);
        other = nearestTo(r.place_px + dot(middleOf(other) - r.place_px, normal) * normal, n.layer);
        Division otherDivides = divide(r, other, n.layer >= mapCount);
        if (!otherDivides.isEdge) continue;
        float blocker = storedNearness(r.depth, storedAtEdge(other));
        vec2 otherAway = outward(otherDivides, other);
        vec2 otherExtents = halfExtents(footprint, otherAway) * max(min(blocker, deepest) - r.nearness, 0.0);
        float distance = -dot(otherDivides.way_px, otherAway) * r.depth.texelSize;
        bool isFar = abs(distance) >= otherExtents.x + otherExtents.y;
        float otherSeen = isFar ? float(distance > 0.0) : shareBelow(otherExtents, distance);
        float cosine = dot(away, otherAway);
        // A convex blocker is what both edges have behind them; around a gap, what is seen is before both.
        float between_px = dot(otherDivides.way_px - n.division.way_px, otherAway - away) / max(length(otherAway - away), 1e-3);
        bool isConvex = between_px >= 0.0;
        float both = isConvex ? 1.0 - inCommon(1.0 - seen, 1.0 - otherSeen, cosine) : inCommon(seen, otherSeen, cosine);
        // Past the end of an edge there is no telling what it bounds; nor do blockers at different heights have an inside
        // in common. A gap narrower than cells tell may as well be a blocker's tip.
        float weight = smoothstep(0.6, 0.9, abs(dot(otherAway, normalOf(other))));
        if (isConvex) weight *= 1.0 - smoothstep(0.15, 0.4, abs(blocker - r.nearness - n.above) / max(n.above, 1e-9));
        else weight *= smoothstep(1.0, 2.0, -between_px / float(constants.cell_px));
        seen = mix(seen, both, weight);
    }
    return seen;
}

void main() {
    if (gl_GlobalInvocationID.x >= crowdedCount) return;
    uint place = crowdedPixels[gl_GlobalInvocationID.x];
    ivec2 pixel = ivec2(place & 0xffffu, place >> 16);
    Receiver receiver;
    Receiving r;
    if (!loadReceiver(pixel, receiver) || !startReceiving(receiver, r)) return;
    Footprint footprint = footprintOf(r);
    float stored = storedHere(r), own = storedNearness(r.depth, stored);
    bool isBlocked = isAbove(r, ivec2(r.place_px), stored);
    float atMost, seen = seenPastNearest(r, footprint, isBlocked, own, atMost);
    seen = min(seenAmong(r, footprint, seen, isBlocked ? own : 3e38), atMost);
    imageStore(visibility, pixel, vec4(clamp(proven(receiver, r, seen), 0.0, 1.0)));
}
