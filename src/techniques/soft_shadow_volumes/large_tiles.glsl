// SPDX-License-Identifier: Apache-2.0
// Where the receivers of a large tile are, for groups of 64. Requires tile_shaft.glsl.

layout(std430) readonly buffer Bounds { TileBounds bounds[]; };

shared TileBounds parts[64];

// Around all receivers of the small tiles from `first` to before `end`.
TileBounds boundsOf(ivec2 first, ivec2 end) {
    uint lane = gl_LocalInvocationIndex;
    const TileBounds none = TileBounds(vec4(3e38), vec4(-3e38));
    TileBounds part = none;
    int width = end.x - first.x, count = width * (end.y - first.y);
    for (int i = int(lane); i < count; i += 64) {
        TileBounds small = bounds[(first.y + i / width) * int(volume.smallTilesAcross) + first.x + i % width];
        if (small.low.x > small.high.x) continue;
        part.low = min(part.low, small.low);
        part.high = max(part.high, small.high);
    }
    parts[lane] = part;
    barrier();
    TileBounds tile = none;
    for (int i = 0; i < min(64, count); ++i) {
        tile.low = min(tile.low, parts[i].low);
        tile.high = max(tile.high, parts[i].high);
    }
    return tile;
}

TileBounds largeTileBounds(ivec2 largeTile) {
    ivec2 smallTiles = (volume.buffer_px + 7) / 8, first = largeTile * int(volume.smallTilesALargeOne);
    return boundsOf(first, min(first + int(volume.smallTilesALargeOne), smallTiles));
}
