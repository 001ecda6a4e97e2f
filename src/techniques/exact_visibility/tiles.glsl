// SPDX-License-Identifier: Apache-2.0
// Candidates for each tile of 8 x 8 receivers.
#include "src/techniques/exact_visibility/exact_io.h"

// For statistics. Of the error bounds: in parts of 256.
layout(std430) buffer Counters {
    uint triangleSum, largestTile, tilesWithCandidates, fullTiles, boundedPixels, boundSum, largestBound;
};
