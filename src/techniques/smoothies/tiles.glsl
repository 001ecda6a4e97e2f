// SPDX-License-Identifier: Apache-2.0
// The tiles of the picture that need more than the depth map, in rows that an indirect dispatch takes. Their order
// depends on chance; nothing else does.
#include "src/techniques/smoothies/smoothies_io.h"

layout(std430, binding = 3) buffer Tiles {
    uint tileColumns;
    uint tileRows;
    uint tileDepth;  // 1
    uint tileCount;
    uint tiles[];  // x + 65536 y
};

void listTile(uvec2 tile) {
    uint index = atomicAdd(tileCount, 1u);
    tiles[index] = tile.x + 65536u * tile.y;
    atomicMax(tileColumns, min(index + 1u, uint(tilesPerRow)));
    atomicMax(tileRows, index / uint(tilesPerRow) + 1u);
}
