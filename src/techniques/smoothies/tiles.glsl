// SPDX-License-Identifier: Apache-2.0
// The tiles of the picture that need more than the depth map, in rows that an indirect dispatch takes. Their order
// depends on chance; nothing else does.
#include "src/techniques/smoothies/smoothies_io.h"

layout(std430) buffer Tiles {
    uint tileColumns;
    uint tileRows;
    uint tileDepth;  // 1
    uint tileCount;
    uint tiles[];  // x + 65536 y; behind them, for each tile of the picture whether it is listed
};

// By any pixel of a tile: no shared memory, since barriers are slow on software rasterisers.
void listTile(uvec2 tile, uvec2 tilesInPicture) {
    uint listed = tilesInPicture.x * (tilesInPicture.y + tile.y) + tile.x;
    if (tiles[listed] != 0u || atomicExchange(tiles[listed], 1u) != 0u) return;
    uint index = atomicAdd(tileCount, 1u);
    tiles[index] = tile.x + 65536u * tile.y;
    atomicMax(tileColumns, min(index + 1u, uint(tilesPerRow)));
    atomicMax(tileRows, index / uint(tilesPerRow) + 1u);
}
