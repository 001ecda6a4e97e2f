// SPDX-License-Identifier: Apache-2.0
// The blocks of 8 x 8 texels that may have an edge in them, in no order: column, row (10 bits each) and map. Their number
// is an indirect dispatch's.
layout(std430) buffer EdgeBlocks {
    uint blockCount, blockRows, blockLayers, padding;
    uint edgeBlocks[];
};

// Stored depth is an affine function over any plane, in both projections (perspective: near / z). So a surface that
// goes on across a texel's side has no second difference; what exceeds this many texels of depth is an edge. A crease
// of two slopes differs by the slopes' difference in texels: a roof of two planes of 60 degrees by 3.5.
const float jumpTexels = 4.0;

// That many texels beneath a stored depth, as a difference of stored depths.
float jumpBelow(int map, float stored) {
    MapDepth depth = lightCameras[map].depth;
    return jumpTexels * depth.texelSize * (depth.isOrthographic ? 1.0 / (depth.far_m - depth.near_m) : stored);
}
