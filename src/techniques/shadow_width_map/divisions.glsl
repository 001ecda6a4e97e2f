// SPDX-License-Identifier: Apache-2.0
// What edges near a receiver's place in the map let through of the light.
#include "src/techniques/shadow_width_map/receiving.glsl"
#include "src/techniques/shadow_width_map/footprint.glsl"
#include "src/techniques/shadow_width_map/edge_cells.glsl"

uniform usampler2DArray nearestEdges;
uniform sampler2DArray farthestMaps;

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
    bool stands = isEdge(edge) && storedNearness(r.depth, stored) > r.nearness && isAbove(r, edgeTexel(edge), stored);
    division.isBehindToo = stands && isInner && isAbove(r, texelBehind(edge), storedBehindEdge(edge));
    division.isEdge = stands && !division.isBehindToo;
    division.way_px = nearestOnEdge(edge, r.place_px, float(constants.cell_px)) - r.place_px;
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
    float distance = division.width_px * r.depth.texelSize;
    if (distance >= extents.x + extents.y) return isBeyond ? 0.0 : 1.0;
    return shareBelow(extents, isBeyond ? -distance : distance);
}

uvec4 nearestTo(vec2 place_px, int layer) {
    ivec2 cell = clamp(cellAt(place_px, constants.cell_px), ivec2(0), ivec2(constants.cellsAcross - 1));
    return texelFetch(nearestEdges, ivec3(cell, layer), 0);
}

// Visibility by the edges that are nearest to a cell.
float seenFromCell(Receiving r, Footprint footprint, ivec2 cell, bool isBlocked, float own) {
    uvec4 outline = texelFetch(nearestEdges, ivec3(cell, r.camera), 0), inner = uvec4(0u);
    if (kinds > 1) inner = texelFetch(nearestEdges, ivec3(cell, r.camera + mapCount), 0);
    Division outlineDivides = divide(r, outline, false), innerDivides = divide(r, inner, true);

    // In the shadow of several blockers, the deepest is hardest to see past. A blocker that reaches up to an inner edge
    // from behind most likely goes on beneath the one before it.
    float deepest = isBlocked ? own : 3e38;
    float seen = isBlocked ? 0.0 : 1.0;
    if (innerDivides.isEdge) {
        float blocker = storedNearness(r.depth, storedAtEdge(inner));
        seen = seenPast(r, footprint, inner, innerDivides, min(blocker, deepest), isBlocked);
    } else if (isBlocked && innerDivides.isBehindToo && innerDivides.width_px < outlineDivides.width_px) {
        deepest = min(deepest, storedNearness(r.depth, storedBehindEdge(inner)));
    }
    if (outlineDivides.isEdge) {
        float blocker = storedNearness(r.depth, storedAtEdge(outline));
        float past = seenPast(r, footprint, outline, outlineDivides, min(blocker, deepest), isBlocked);
        seen = isBlocked ? max(seen, past) : min(seen, past);
    }
    return seen;
}

// Whether the farthest blocker ends in sight, nearer than `width_px`: before nothing, or before what is no blocker, as a ground.
bool endsBefore(Receiving r, ivec2 cell, float width_px) {
    float cell_px = float(constants.cell_px);
    vec2 toOutline = nearestOnEdge(texelFetch(nearestEdges, ivec3(cell, r.camera), 0), r.place_px, cell_px) - r.place_px;
    if (length(toOutline) < width_px) return true;
    uvec4 inner = texelFetch(nearestEdges, ivec3(cell, r.camera + mapCount), 0);
    if (!isEdge(inner)) return false;
    vec2 toInner = nearestOnEdge(inner, r.place_px, cell_px) - r.place_px;
    return length(toInner) < width_px && texelFetch(farthestMaps, ivec3(texelBehind(inner), r.camera), 0).r == 1.0;
}

// What the farthest blocker lets through where it ends beneath another. Nothing of it is in sight there: the outlines near by
// are the other's. But where an outline is nearer, that is its own.
float seenPastHidden(Receiving r, Footprint footprint, ivec2 cell) {
    uvec4 hidden = texelFetch(nearestEdges, ivec3(cell, r.camera + 2 * mapCount), 0);
    Division division = divide(r, hidden, false);
    if (!division.isEdge) return 1.0;
    ivec2 texel = ivec2(r.place_px);
    float farthest = texelFetch(farthestMaps, ivec3(texel, r.camera), 0).r;
    bool isBeneath = farthest < 0.5 * (storedAtEdge(hidden) + storedBehindEdge(hidden));
    if (isBeneath && (!isAbove(r, texel, farthest) || endsBefore(r, cell, division.width_px))) return 1.0;
    return seenPast(r, footprint, hidden, division, storedNearness(r.depth, storedAtEdge(hidden)), isBeneath);
}

// What is seen past the nearest edges. Visibility is interpolated between cells; neither widths nor depths mean anything in
// between. At most, apart from that, what hidden edges leave.
float seenPastNearest(Receiving r, Footprint footprint, bool isBlocked, float own, out float atMost) {
    vec2 place = r.place_px / float(constants.cell_px) - 0.5;
    ivec2 corner = ivec2(floor(place));
    vec2 weight = place - vec2(corner);
    float seen = 0.0;
    atMost = kinds > 2 ? 0.0 : 1.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 cell = clamp(corner + offset, ivec2(0), ivec2(constants.cellsAcross - 1));
        vec2 share = mix(1.0 - weight, weight, vec2(offset));
        if (kinds > 2) atMost += share.x * share.y * seenPastHidden(r, footprint, cell);
        seen += share.x * share.y * seenFromCell(r, footprint, cell, isBlocked, own);
    }
    return seen;
}

// The nearest edge that divides the light, and how far its penumbra reaches from it.
struct Nearest {
    uvec4 edge;
    Division division;
    int layer;
    float above;     // in nearness, the blocker above the receiver
    float reach_px;
    vec2 behind_px, beyond_px;  // as far away from the edge and from the receiver, on either side of both
};

Nearest nearestOf(Receiving r, Footprint footprint) {
    Nearest n;
    n.layer = r.camera;
    n.edge = nearestTo(r.place_px, n.layer);
    n.division = divide(r, n.edge, false);
    if (kinds > 1) {
        uvec4 inner = nearestTo(r.place_px, n.layer + mapCount);
        Division division = divide(r, inner, true);
        if (division.isEdge && !(n.division.isEdge && n.division.width_px < division.width_px)) {
            n.layer += mapCount;
            n.edge = inner;
            n.division = division;
        }
    }
    vec2 across = n.division.way_px / max(n.division.width_px, 1e-3);
    n.above = storedNearness(r.depth, storedAtEdge(n.edge)) - r.nearness;
    vec2 extents = halfExtents(footprint, across) * max(n.above, 0.0);
    n.reach_px = (extents.x + extents.y) / r.depth.texelSize;
    n.behind_px = r.place_px - across * n.reach_px;
    n.beyond_px = r.place_px + across * (n.division.width_px + n.reach_px);
    return n;
}
