// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, second pass: visibility past the nearest edges, where resolve.comp.glsl found them near enough.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/shadow_width_map/receiving.glsl"
#include "src/techniques/shadow_width_map/footprint.glsl"
#include "src/techniques/shadow_width_map/nearest_edge.glsl"
#include "src/techniques/shadow_width_map/penumbra_tiles.glsl"

layout(binding = 5) uniform usampler2DArray edges;

// How an edge divides the light for this receiver.
struct Division {
    bool isEdge;       // the edge stands above the receiver's horizon, and what is behind it lets light through
    float seen;        // past the edge
    float deepest_m;   // the depth of what is behind an edge that is none because this blocks as well; else 0
};

// From a place in the map on the edge's blocked or lit side, the deepest known blocker there being at own_m.
Division divide(Receiving r, Footprint footprint, uint edge, vec2 place_px, bool isBlocked, float own_m, bool isInner) {
    Division division = Division(false, 0.0, 0.0);
    ivec2 texel = edgeTexel(edge);
    float stored = texelFetch(depthMaps, ivec3(texel, r.camera), 0).r;
    float blocker_m = depthOf(r, max(stored, 1e-30));
    if (blocker_m >= r.point.posFace.z || !isAbove(r, texel, stored)) return division;
    ivec2 side = nearestSide(edge, place_px);
    if (isInner) {
        ivec2 behind = texel + side;
        float storedBehind = texelFetch(depthMaps, ivec3(behind, r.camera), 0).r;
        if (isAbove(r, behind, storedBehind)) {
            division.deepest_m = depthOf(r, storedBehind);
            return division;
        }
    }
    division.isEdge = true;
    vec2 way_px = middleOf(edge, side) - place_px;
    float way = max(length(way_px), 1e-3);
    vec2 extents = halfExtents(footprint, way_px / way);
    // In the shadow of several blockers, the deepest is hardest to see past.
    float spread = spreadOf(r, isBlocked ? min(max(blocker_m, own_m), r.point.posFace.z) : blocker_m);
    float distance = way * r.depth.w;
    bool isPast = distance >= (extents.x + extents.y) * spread;
    division.seen = isPast ? (isBlocked ? 0.0 : 1.0) : shareBelow(extents * spread, isBlocked ? -distance : distance);
    return division;
}

// Visibility as a place in the map has it, by the nearest edges of the texel that it lies in.
float seenFromPlace(Receiving r, Footprint footprint, ivec2 texel, vec2 place_px, vec2 width_px) {
    float stored = texelFetch(depthMaps, ivec3(texel, r.camera), 0).r;
    bool isBlocked = isAbove(r, texel, stored);
    float own_m = isBlocked ? depthOf(r, stored) : 0.0;
    float seen = isBlocked ? 0.0 : 1.0;
    for (int kind = constants.light.w; kind >= 0; --kind) {
        if (width_px[kind] > float(r.size_px)) continue;  // there is no edge
        uint edge = texelFetch(edges, ivec3(texel, r.camera + kind * constants.light.y), 0).r;
        Division division = divide(r, footprint, edge, place_px, isBlocked, own_m, kind == 1);
        if (division.isEdge) seen = isBlocked ? max(seen, division.seen) : min(seen, division.seen);
        // A blocker that reaches up to an inner edge from behind most likely goes on beneath the one before it.
        if (kind == 1 && isBlocked && width_px.y < width_px.x) own_m = max(own_m, division.deepest_m);
    }
    return seen;
}

float seenBy(Receiver receiver) {
    Receiving r;
    if (!isFacing(receiver, true)) return 0.0;
    if (!startReceiving(receiver, r)) return 1.0;
    vec2 place_px = r.point.uv * float(r.size_px);
    vec2 width_px = widthsAt(r, ivec2(place_px));

    // Beside an edge, visibility is interpolated between texels; neither widths nor depths mean anything in between.
    Footprint footprint = footprintOf(r);
    bool isBeside = min(width_px.x, width_px.y) <= besideEdge_px;
    ivec2 corner = ivec2(floor(isBeside ? place_px - 0.5 : place_px));
    vec2 weight = place_px - 0.5 - vec2(corner);
    float seen = 0.0;
    for (int i = 0; i < (isBeside ? 4 : 1); ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(corner + offset, ivec2(0), ivec2(r.size_px - 1));
        vec2 share = isBeside ? mix(1.0 - weight, weight, vec2(offset)) : vec2(1.0);
        vec2 from_px = isBeside ? vec2(texel) + 0.5 : place_px;
        seen += share.x * share.y * seenFromPlace(r, footprint, texel, from_px, widthsAt(r, texel));
    }
    return clamp(seen, 0.0, 1.0);
}

void main() {
    uint tile = penumbraTiles[gl_WorkGroupID.x];
    ivec2 pixel = 8 * ivec2(tile & 0xffffu, tile >> 16) + ivec2(gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    imageStore(visibility, pixel, vec4(loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0));
}
