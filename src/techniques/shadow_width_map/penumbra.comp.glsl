// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, second of three passes: visibility past the nearest edges, where resolve.comp.glsl found them near enough.
// Pixels among several edges are listed for crowded.comp.glsl.
layout(local_size_x = 64) in;

#include "src/techniques/shadow_width_map/divisions.glsl"
#include "src/techniques/shadow_width_map/penumbra_pixels.glsl"
#include "src/techniques/shadow_width_map/proven.glsl"

uniform sampler2DArray widths;

float widthAt(vec2 place_px, int layer) {
    ivec2 cell = clamp(cellAt(place_px, constants.cell_px), ivec2(0), ivec2(constants.cellsAcross - 1));
    return texelFetch(widths, ivec3(cell, layer), 0).r;
}

// Whether another edge may take part: if, from a place to either side, any is nearer than the nearest one here by more than
// the widths of cells tell.
bool isCrowded(Receiving r, Footprint footprint) {
    Nearest n = nearestOf(r, footprint);
    float far_px = n.reach_px - 2.0 * float(constants.cell_px);
    return n.division.isEdge && (widthAt(n.behind_px, n.layer) < n.division.width_px + far_px ||
                                 widthAt(n.beyond_px, n.layer) < far_px);
}

void main() {
    if (gl_GlobalInvocationID.x >= pixelCount) return;
    uint place = penumbraPixels[gl_GlobalInvocationID.x];
    ivec2 pixel = ivec2(place & 0xffffu, place >> 16);
    Receiver receiver;
    Receiving r;
    float seen = 1.0;
    bool isAmongSeveral = false;
    if (loadReceiver(pixel, receiver)) {
        if (!isFacing(receiver, true)) {
            seen = 0.0;
        } else if (startReceiving(receiver, r)) {
            Footprint footprint = footprintOf(r);
            float stored = storedHere(r);
            bool isBlocked = isAbove(r, ivec2(r.place_px), stored);
            float atMost;
            seen = seenPastNearest(r, footprint, isBlocked, storedNearness(r.depth, stored), atMost);
            seen = min(seen, atMost);
            isAmongSeveral = isCrowded(r, footprint);
            if (!isAmongSeveral) seen = proven(receiver, r, seen);
        }
    }
    imageStore(visibility, pixel, vec4(clamp(seen, 0.0, 1.0)));
    if (!isAmongSeveral) return;
    uint index = atomicAdd(crowdedCount, 1u);
    if (index % 64u == 0u) atomicAdd(crowdedGroups, 1u);
    crowdedPixels[index] = place;
}
