// SPDX-License-Identifier: Apache-2.0
#version 450
// The bounds of where rays of each tile of 8 x 8 receivers start, and of their normals: once for all lights. One
// invocation a tile.
layout(local_size_x = 32) in;

#include "src/techniques/exact_visibility/receivers.glsl"

layout(std140) uniform Constants { ExactLook look; };
layout(std430) readonly buffer TileRevisions { uint tileRevisions[]; };
layout(std430) writeonly buffer Tiles { TileBounds tileBounds[]; };

void main() {
    uint tile = gl_GlobalInvocationID.x;
    ivec2 tiles = (view.size_px + EXACT_TILE - 1) / EXACT_TILE;
    if (tile >= uint(tiles.x * tiles.y)) return;
    if (look.serial != 0u && tileRevisions[tile] != look.serial) return;
    ivec2 corner = EXACT_TILE * ivec2(int(tile) % tiles.x, int(tile) / tiles.x);
    TileBounds bounds = TileBounds(vec3(3e38), 3e38, vec3(-3e38), -3e38, vec3(0.0), -1.0);
    bool isAnyWithoutNormal = false;  // which sees nothing
    for (int i = 0; i < EXACT_TILE * EXACT_TILE; ++i) {
        ivec2 pixel = corner + ivec2(i % EXACT_TILE, i / EXACT_TILE);
        Receiver receiver;
        if (any(greaterThanEqual(pixel, view.size_px)) || !loadReceiver(pixel, receiver)) continue;
        bool hasNormal = dot(receiver.normalLight, receiver.normalLight) > 0.5;
        isAnyWithoutNormal = isAnyWithoutNormal || !hasNormal;
        if (!hasNormal) continue;
        vec3 apex = apexOf(receiver);
        if (bounds.otherNormal < 0.0) bounds.normal = receiver.normalLight;
        float height = dot(bounds.normal, apex);
        bounds.otherNormal = max(bounds.otherNormal, distance(bounds.normal, receiver.normalLight));
        bounds.lowest = min(bounds.lowest, height);
        bounds.highest = max(bounds.highest, height);
        bounds.low = min(bounds.low, apex);
        bounds.high = max(bounds.high, apex);
    }
    // What holds for all others need not hold for such a one.
    const float anyNormal = 4.0;
    if (isAnyWithoutNormal && bounds.otherNormal >= 0.0) bounds.otherNormal = anyNormal;
    vec3 largest = max(abs(bounds.low), abs(bounds.high));
    float pad = 1e-6 * (max(largest.x, largest.y) + largest.z);
    bounds.low -= pad;
    bounds.high += pad;
    tileBounds[tile] = bounds;
}
