// SPDX-License-Identifier: Apache-2.0
#version 450
// The edges of every cell in the listed blocks, one of each kind.
//
// A cell's edge is the texel nearest to its middle, and the line through the middles of all sides around that which do not
// look the other way. Its normal is the sum of these sides' directions: for a straight silhouette exact but for its ends,
// since its steps are as many to either side as its slope tells. So it lies truer than to a texel.
layout(local_size_x = 8, local_size_y = 8) in;

#define DEPTH_MAP_UNIT 3
#define DEPTH_MAP_BLOCK 0
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/edge_blocks.glsl"
#include "src/techniques/shadow_width_map/edge_cells.glsl"

layout(binding = 0, rgba32ui) uniform writeonly uimage2DArray cellEdges;
layout(binding = 2) uniform sampler2DArray farthestMaps;
layout(location = 0) uniform int kinds;
layout(location = 1) uniform int cell_px;  // 1, 2, 4 or 8
layout(location = 2) uniform int mapCount;

const int cellsOfKind = 64;  // at most
const int around_px = 4;
const int tile_px = 8 + 2 * around_px;
shared uint sidesAt[tile_px * tile_px];
shared uint nearest[3 * cellsOfKind];

ivec3 inMap(ivec3 texel) { return ivec3(clamp(texel.xy, ivec2(0), textureSize(depthMaps, 0).xy - 1), texel.z); }
float stored(ivec3 texel) { return texelFetch(depthMaps, inMap(texel), 0).r; }
float storedFarthest(ivec3 texel) { return texelFetch(farthestMaps, inMap(texel), 0).r; }

// A texel's sides where what is farthest ends beneath something else, in the order of the directions.
uint hiddenSidesOf(ivec3 texel) {
    float here = storedFarthest(texel);
    uint sides = 0u;
    if (stored(texel) - here <= jumpBelow(texel.z, stored(texel))) return 0u;
    for (int i = 0; i < 4; ++i) {
        ivec3 step = ivec3(edgeDirections[i], 0);
        float before = storedFarthest(texel - step), next = storedFarthest(texel + step);
        float bend = min(next - 2.0 * here + before, 2.0 * next - here - storedFarthest(texel + 2 * step));
        if (next < 1.0 && min(next - here, bend) > jumpBelow(texel.z, next)) sides |= 1u << i;
    }
    return sides;
}

// A texel's sides that are edges: 4 bits a kind.
uint sidesOf(ivec3 texel) {
    float here = stored(texel), jump = jumpBelow(texel.z, here);
    bool isInMap = all(greaterThanEqual(texel.xy, ivec2(0))) && all(lessThan(texel.xy, textureSize(depthMaps, 0).xy));
    if (!isInMap || here == 0.0) return 0u;
    float around[4];
    for (int i = 0; i < 4; ++i) around[i] = stored(texel + ivec3(edgeDirections[i], 0));
    uint sides = 0u;
    for (int i = 0; i < 4; ++i) {
        float beyond = stored(texel + ivec3(2 * edgeDirections[i], 0));
        float bend = min(2.0 * here - around[i ^ 1] - around[i], here + beyond - 2.0 * around[i]);
        if (around[i] == 0.0) sides |= 1u << i;
        else if (kinds > 1 && here - around[i] > jump && bend > jump) sides |= 16u << i;
    }
    return kinds > 2 ? sides | hiddenSidesOf(texel) << 8 : sides;
}

// The direction that a texel's sides (4 bits) look to; where they cancel, that of the first.
ivec2 lookOf(uint sides) {
    ivec2 sum = ivec2(0), first = ivec2(0);
    for (int i = 3; i >= 0; --i) {
        if ((sides >> i & 1u) == 0u) continue;
        first = edgeDirections[i];
        sum += first;
    }
    return sum == ivec2(0) ? first : sum;
}

struct Line {
    vec2 middle, normal;
};

// In the tile, the line through the sides of a kind that are at most so far from a texel and from a line.
Line fitLine(ivec2 texel, int kind, int far_px, Line near, float fromLine_px) {
    ivec2 look = lookOf(sidesAt[texel.y * tile_px + texel.x] >> (4 * kind) & 15u);
    vec3 middles = vec3(0.0);  // their sum and number
    vec2 normal = vec2(0.0);
    ivec2 there;
    for (there.y = texel.y - far_px; there.y <= texel.y + far_px; ++there.y) {
        for (there.x = texel.x - far_px; there.x <= texel.x + far_px; ++there.x) {
            uint sides = sidesAt[there.y * tile_px + there.x] >> (4 * kind) & 15u;
            for (int j = 0; j < 4; ++j) {
                ivec2 direction = edgeDirections[j];
                vec2 middle = vec2(there) + 0.5 + 0.5 * vec2(direction);
                bool isAcross = look.x * direction.x + look.y * direction.y < 0;
                bool isOff = abs(dot(middle - near.middle, near.normal)) > fromLine_px;
                if ((sides >> j & 1u) == 0u || isAcross || isOff) continue;
                normal += vec2(direction);
                middles += vec3(middle, 1.0);
            }
        }
    }
    return middles.z == 0.0 || normal == vec2(0.0) ? near : Line(middles.xy / middles.z, normalize(normal));
}

// Of a cell, from the place of its edge texel in the tile.
void keepEdge(ivec3 corner, int cell, int kind, int place) {
    ivec2 texel = ivec2(place % tile_px, place / tile_px);
    // First what is close, so that beside a corner the silhouette's other leg stays out.
    Line line = fitLine(texel, kind, 1, Line(vec2(0.0), vec2(0.0)), 0.0);
    line = fitLine(texel, kind, min(cell_px + 1, around_px), line, 1.0);
    vec2 middle = line.middle, normal = line.normal;
    uint direction = 0u;
    float most = -2.0;
    for (int i = 0; i < 4; ++i) {
        if ((sidesAt[place] >> (4 * kind + i) & 1u) == 0u || dot(normal, vec2(edgeDirections[i])) <= most) continue;
        most = dot(normal, vec2(edgeDirections[i]));
        direction = uint(i);
    }
    // Along the line, the edge is where its texel is.
    vec2 along = vec2(-normal.y, normal.x);
    middle += along * dot(vec2(texel) + 0.5 - middle, along);
    texel += corner.xy;
    ivec3 here = ivec3(texel, corner.z), behind = here + ivec3(edgeDirections[direction], 0);
    uvec4 edge = packEdge(texel, direction, middle + vec2(corner.xy), normal,
                          kind == 2 ? storedFarthest(here) : stored(here),
                          kind == 2 ? storedFarthest(behind) : stored(behind));
    int across = 8 / cell_px;
    ivec2 place_cells = (corner.xy + around_px) / cell_px + ivec2(cell % across, cell / across);
    imageStore(cellEdges, ivec3(place_cells, corner.z + kind * mapCount), edge);
}

void main() {
    uint block = edgeBlocks[gl_WorkGroupID.x];
    ivec3 corner = ivec3(8 * ivec2(block & 0x3ffu, block >> 10 & 0x3ffu) - around_px, block >> 20);  // of the tile
    ivec2 within = ivec2(gl_LocalInvocationID.xy);
    int lane = int(gl_LocalInvocationIndex), across = 8 / cell_px;

    for (int i = lane; i < tile_px * tile_px; i += 64)
        sidesAt[i] = sidesOf(corner + ivec3(i % tile_px, i / tile_px, 0));
    for (int kind = 0; kind < 3; ++kind) nearest[cellsOfKind * kind + lane] = 0xffffffffu;
    barrier();

    int own = (within.y + around_px) * tile_px + within.x + around_px;
    int cell = within.y / cell_px * across + within.x / cell_px;
    ivec2 fromMiddle = 2 * (within % cell_px) + 1 - cell_px;
    uint key = uint(fromMiddle.x * fromMiddle.x + fromMiddle.y * fromMiddle.y) << 16 | uint(own);
    for (int kind = 0; kind < kinds; ++kind) {
        if ((sidesAt[own] >> (4 * kind) & 15u) != 0u) atomicMin(nearest[cellsOfKind * kind + cell], key);
    }
    barrier();

    for (int kind = 0; kind < kinds; ++kind) {
        uint key = nearest[cellsOfKind * kind + lane];
        if (key != 0xffffffffu) keepEdge(corner, lane, kind, int(key & 0xffffu));
    }
}
