// SPDX-License-Identifier: Apache-2.0
// The quadtree over the light, shared between C++ and GLSL (std430). Its vertices are the middles of 17 x 17
// cells of the unit square, so that a full subdivision is uniform sampling with 17 x 17 samples and no sample
// lies on the very rim, which the horizon of a receiver touches first; or, as published, a lattice that has
// the square's corners. The corners of quads at level d are 16
// >> d apart. Quads of levels 0 to 3 can be split; level l starts at (4^l - 1) / 3, rows of 2^l quads each.
#ifndef PENUMBRA_SUBDIVISION_IO_H
#define PENUMBRA_SUBDIVISION_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra::light_sampling {
#endif

const int deepestLevel = 4;
const int latticeSide = 17;
const int latticeVertices = 289;
const int splittableQuads = 85;

struct Subdivision {
    int slotOfVertex[latticeVertices];      // -1: no map there
    uint failing[splittableQuads];          // fragments that want the quad split
    uint split[splittableQuads];            // 1 where it was
    uint samplesOfLevel[deepestLevel + 1];  // vertices in the tree that the level's quads brought
    uint coarseVertices[3];  // bits, as in lattice_bits.glsl, of the vertices in the tree up to level 3
    uint deepestRows[8];     // bit x of row y: the quad of level 3 is split
    uint leafRows[15];       // of quads up to level 3 that are not split: see settled.glsl
    int decidedLevels;       // quads of levels below are as they will stay
    uint reachedMaximum;     // 1 where a quad was left whole for want of maps
    uint errorBound;         // bits of the largest of a pixel (see examine.comp.glsl)
};

SHARED_STRUCT DecideConstants {
    ivec2 target_px;  // of the comparison
    int round;        // -1: starts the tree
    int maxSamples;
    uint tolerated;  // failing fragments
    int minDepth;    // every quad above it is split
    int maxDepth;
    int baseDepth;      // to which the tree is split at the start
    bool32 isCoherent;  // the last frame's tree is there to start from
    bool32 isOneLevelARound;
};

SHARED_STRUCT ExamineConstants {
    int maxDepth;
    float maxError;   // 0: the paper's test decides
    float cellError;  // of what the corners of a quad say of it, over its area
};

SHARED_STRUCT LatticeWeightsConstants {
    bool32 usesPaperWeights;
    bool32 isTextured;
    int cellsPerSide;  // see LatticeShares
};

#ifdef __cplusplus
static_assert(sizeof(Subdivision) == 4 * (latticeVertices + 2 * splittableQuads + deepestLevel + 1 + 29));
}  // namespace penumbra::light_sampling
#endif
#endif
