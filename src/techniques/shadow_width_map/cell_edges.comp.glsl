// SPDX-License-Identifier: Apache-2.0
#version 450
// The edges of every cell in the listed blocks, one of each kind.
//
// A cell's edge is the texel nearest to its middle, and the line through the middles of all sides around that which do not
// look the other way. Its normal is the sum of these sides' directions: for a straight silhouette exact but for its ends,
// since its steps are as many to either side as its slope tells. So it lies truer than to a texel.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/edge_blocks.glsl"
#include "src/techniques/shadow_width_map/edge_cells.glsl"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

layout(std140) uniform Constants { EdgeConstants edges; };
layout(rgba32ui) uniform writeonly uimage2DArray cellEdges;
uniform sampler2DArray farthestMaps;

const int cellsOfKind = 64;  // at most
const int around_px = 4;
const int tile_px = 8 + 2 * around_px;
const int wide_px = tile_px + 4;  // with what the sides of its texels depend on
shared float nearest[wide_px * wide_px], farthest[wide_px * wide_px];
shared uint sidesAt[tile_px * tile_px];
shared uint keys[3 * cellsOfKind];

// A texel's sides that are edges: 4 bits a kind, in the order of the directions. `place` is in the wide tile.
uint sidesOf(ivec3 texel, int place) {
    const int steps[4] = int[](1, -1, wide_px, -wide_px);
    bool isInMap = all(greaterThanEqual(texel.xy, ivec2(0))) && all(lessThan(texel.xy, textureSize(depthMaps, 0).xy));
    float here = nearest[place], jump = jumpBelow(texel.z, here), far = farthest[place];
    if (!isInMap || here == 0.0) return 0u;
    uint sides = 0u;
    for (int i = 0; i < 4; ++i) {
        float next = nearest[place + steps[i]];
        float bend = min(2.0 * here - nearest[place - steps[i]] - next, here + nearest[place + 2 * steps[i]] - 2.0 * next);
        if (next == 0.0) sides |= 1u << i;
        else if (edges.kinds > 1 && min(here - next, bend) > jump) sides |= 16u << i;
        // What is farthest is hidden here, and ends beneath something else.
        if (edges.kinds < 3 || here - far <= jump) continue;
        next = farthest[place + steps[i]];
        bend = min(next - 2.0 * far + farthest[place - steps[i]], 2.0 * next - far - farthest[place + 2 * steps[i]]);
        if (next < 1.0 && min(next - far, bend) > jumpBelow(texel.z, next)) sides |= 256u << i;
    }
    return sides;
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
    // Cells of one texel are those of small maps, in which a blocker may be a few texels large: lines no longer than that.
    // First what is close, so that beside a corner the silhouette's other leg stays out.
    Line line = fitLine(texel, kind, 1, Line(vec2(0.0), vec2(0.0)), 0.0);
    line = fitLine(texel, kind, edges.cell_px == 1 ? 1 : min(edges.cell_px + 1, around_px), line, 1.0);
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
    int here = (texel.y + 2) * wide_px + texel.x + 2;
    int behind = here + edgeDirections[direction].y * wide_px + edgeDirections[direction].x;
    texel += corner.xy;
    uvec4 edge = packEdge(texel, direction, middle + vec2(corner.xy), normal,
                          kind == 2 ? farthest[here] : nearest[here], kind == 2 ? farthest[behind] : nearest[behind]);
    int across = 8 / edges.cell_px;
    ivec2 place_cells = (corner.xy + around_px) / edges.cell_px + ivec2(cell % across, cell / across);
    imageStore(cellEdges, ivec3(place_cells, corner.z + kind * edges.mapCount), edge);
}

void main() {
    uint block = edgeBlocks[gl_WorkGroupID.x];
    ivec3 corner = ivec3(8 * ivec2(block & 0x3ffu, block >> 10 & 0x3ffu) - around_px, block >> 20);  // of the tile
    ivec2 within = ivec2(gl_LocalInvocationID.xy);
    int lane = int(gl_LocalInvocationIndex), across = 8 / edges.cell_px;

    ivec2 last = textureSize(depthMaps, 0).xy - 1;
    for (int i = lane; i < wide_px * wide_px; i += 64) {
        ivec3 texel = ivec3(clamp(corner.xy - 2 + ivec2(i % wide_px, i / wide_px), ivec2(0), last), corner.z);
        nearest[i] = texelFetch(depthMaps, texel, 0).r;
        farthest[i] = edges.kinds > 2 ? texelFetch(farthestMaps, texel, 0).r : 1.0;
    }
    for (int kind = 0; kind < 3; ++kind) keys[cellsOfKind * kind + lane] = 0xffffffffu;
    barrier();
    for (int i = lane; i < tile_px * tile_px; i += 64) {
        ivec2 inTile = ivec2(i % tile_px, i / tile_px);
        sidesAt[i] = sidesOf(corner + ivec3(inTile, 0), (inTile.y + 2) * wide_px + inTile.x + 2);
    }
    barrier();

    int own = (within.y + around_px) * tile_px + within.x + around_px;
    int cell = within.y / edges.cell_px * across + within.x / edges.cell_px;
    ivec2 fromMiddle = 2 * (within % edges.cell_px) + 1 - edges.cell_px;
    uint key = uint(fromMiddle.x * fromMiddle.x + fromMiddle.y * fromMiddle.y) << 16 | uint(own);
    for (int kind = 0; kind < edges.kinds; ++kind) {
        if ((sidesAt[own] >> (4 * kind) & 15u) != 0u) atomicMin(keys[cellsOfKind * kind + cell], key);
    }
    barrier();

    int cells = across * across;
    for (int i = lane; i < edges.kinds * cells; i += 64) {
        uint key = keys[cellsOfKind * (i / cells) + i % cells];
        if (key != 0xffffffffu) keepEdge(corner, i % cells, i / cells, int(key & 0xffffu));
    }
}
