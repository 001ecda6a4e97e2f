// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, first of two passes: pixels too far from any edge for a penumbra are lit or in umbra, which one texel
// tells. The others are left to penumbra.comp.glsl, in tiles of a work group each. Two passes since software
// rasterizers run both sides of every branch, and on graphics hardware a tile has few pixels of either kind alone.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/shadow_width_map/receiving.glsl"
#include "src/techniques/shadow_width_map/nearest_edge.glsl"
#include "src/techniques/shadow_width_map/penumbra_tiles.glsl"

layout(binding = 5) uniform usampler2DArray edges;

// Negative: in a penumbra, perhaps.
float seenBy(Receiver receiver) {
    Receiving r;
    if (!isFacing(receiver, true)) return 0.0;
    if (!startReceiving(receiver, r)) return 1.0;
    ivec2 texel = ivec2(r.point.uv * float(r.size_px));
    vec2 width_px = widthsAt(r, texel);
    bool isNear = min(width_px.x, width_px.y) <= besideEdge_px;
    for (int kind = 0; kind <= constants.light.w; ++kind) {
        uint edge = texelFetch(edges, ivec3(texel, r.camera + kind * constants.light.y), 0).r;
        float stored = texelFetch(depthMaps, ivec3(edgeTexel(edge), r.camera), 0).r;
        isNear = isNear || width_px[kind] < reach_px(r, depthOf(r, max(stored, 1e-30)));
    }
    if (isNear && constants.extent.x > 0.0) return -1.0;
    return isAbove(r, texel, texelFetch(depthMaps, ivec3(texel, r.camera), 0).r) ? 0.0 : 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    float seen = loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0;
    if (seen >= 0.0) {
        imageStore(visibility, pixel, vec4(seen));
    } else {
        uint tile = gl_WorkGroupID.x | gl_WorkGroupID.y << 16;
        uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        if (atomicOr(isListed[index], 1u) == 0u) penumbraTiles[atomicAdd(tileCount, 1u)] = tile;
    }
}
