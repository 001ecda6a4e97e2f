// SPDX-License-Identifier: Apache-2.0
// Candidates for each tile of 8 x 8 receivers.
layout(std430, binding = 0) buffer Candidates { uint candidates[]; };
// x: plain candidates, from the front; y: special ones, from the back; zw: where the walk through the tree stopped for
// want of room (see Walk).
layout(std430, binding = 1) buffer TileLists { uvec4 tileLists[]; };
// For statistics. Of the error bounds: in parts of 256.
layout(std430, binding = 2) buffer Counters {
    uint triangleSum, largestTile, busyTiles, fullTiles, boundedPixels, boundSum, largestBound;
};
