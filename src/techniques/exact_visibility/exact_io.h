// SPDX-License-Identifier: Apache-2.0
// What the shaders are told; structs for C++ and GLSL.
#ifndef PENUMBRA_EXACT_IO_H
#define PENUMBRA_EXACT_IO_H

#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
#include <array>
#include <cstddef>

namespace penumbra::exact_visibility {
#endif

// Nodes of the tree: what stands in the fourth words.
#define EXACT_END 0xffffffffu       // skip: the tree, or a caster's subtree, ends here
#define EXACT_INNER 0xffffffffu     // leaf: none; the first child is the next node
#define EXACT_SUBTREE 0x80000000u   // leaf: a caster's subtree begins at the node in the lowest bits
#define EXACT_MASKED 0x40000000u    // leaf: the caster or its triangles have holes
#define EXACT_STAND_IN 0x90000000u  // leaf: none, as EXACT_INNER; a stand-in, too (firstBelow in tree.glsl)
#define EXACT_COUNT_SHIFT 28        // leaf: two bits from here on are the number of its triangles, less one;
#define EXACT_PANE 0x08000000u      // leaf: the caster or its triangles let light through
#define EXACT_FIRST 0x07ffffffu     // leaf: these, its first triangle
#define EXACT_LEAF_TRIANGLES 4      // at most

#define EXACT_MAX_ROWS 24     // of a lattice, and bits in a row
#define EXACT_MOST_CELLS 4    // of a rectangle, along each side
#define EXACT_MAX_LATTICES 4  // what more than 256 samples are split into

// By how much stand-ins may move an edge at most, in distances between samples.
#define EXACT_STAND_IN_SHIFT 0.25

#define EXACT_GROUP_TEXTURES 8  // alpha textures that are bound at a time

#define EXACT_TILE 8           // pixels along each side of a tile
#define EXACT_TILE_PARTS 8     // of a tile, each of as many pixels (receivers.glsl)
#define EXACT_MOST_CHANGED 32  // casters that may change from frame to frame while anything is kept

#define EXACT_GROUPS_ACROSS 32768u  // in the x direction of a dispatch

#define EXACT_STATE_WORDS 12  // of a receiver whose work is not done, before the rows

#define EXACT_PANE_SAMPLES 16                          // taken through panes at a time
#define EXACT_PANE_WORDS (5 + 2 * EXACT_PANE_SAMPLES)  // of a receiver's state, behind the rows

/// What all lights of a frame share. In scene space: the world's axes, moved.
SHARED_STRUCT ExactFrame {
    vec3 eye;
    int tilesAcross;
    vec3 sight;         // times a point, plus
    float sightOffset;  // this: clip-space w, the distance along the view
    int tileCapacity;
};

/// In scene space, too.
SHARED_STRUCT ExactLight {
    LightConstants emitter;
    vec3 center;
    float coneCosine;  // distant: of half its angle
    vec3 axisX;        // unit
    bool32 isWeightedByIrradiance;
    vec3 axisY;
    int latticeCount;
    vec3 axisZ;            // light is emitted along -Z
    float planeTolerance;  // penumbra/light_plane.h
    vec3 boxMin;           // of the light (flat, sphere), of unit vectors towards it (distant)
    float coneSine;        // as coneCosine
    vec3 boxMax;
    int nodeCount;                                         // of the tree of what casts
    vec2 latticeFromU, latticeFromV;                       // columns of a matrix
    vec2 uvFromI, uvFromJ;                                 // of its inverse
    vec4 offsets[EXACT_MAX_LATTICES];                      // xy: where uv = 0 lies in lattice coordinates
    uvec4 valid[EXACT_MAX_LATTICES * EXACT_MAX_ROWS / 4];  // bit i of row j: (i, j) is a sample
};

/// Where rays of a tile's receivers start, whatever the light.
SHARED_STRUCT TileBounds {
    vec3 low;
    float lowest;  // the least of dot(normal, position),
    vec3 high;
    float highest;      // and the greatest
    vec3 normal;        // of one of the receivers
    float otherNormal;  // how far those of the others are from it; negative where there is no receiver
};

/// A tile's part of the lists of nodes: plain candidates from its front, those whose triangles may take a
/// look at each sample from its back.
SHARED_STRUCT TileList {
    vec3 low;              // of the receivers,
    float leewayPerMetre;  // and how coarse what they see may be (see Leeway)
    vec3 high;
    uint plain, special;       // how many
    uint stoppedAt, returnTo;  // where the walk through the tree stopped for want of room (see Walk)
};

/// Tiles, or parts of tiles, whose pixels are looked at one by one, listed behind this: the arguments of a
/// dispatch of so many groups or a few more, and how many there are.
SHARED_STRUCT BusyTiles {
    uint groupsX, groupsY, groupsZ;
    uint count;
};

/// A round of the work of receivers (see resolve.comp.glsl).
SHARED_STRUCT ExactRound {
    int number;
    int work;        // iterations until a pause
    int turnRounds;  // rounds in a turn
    int groups;      // of alpha textures, each with turns of its own
};

/// A look at all receivers.
SHARED_STRUCT ExactLook {
    uint serial;  // of the frame; for the bounds of tiles: which revision alone has changed, or 0: any may
                  // have
    uint words;   // that are kept of a pixel
};

/// What of a light's last answer may stay, and how coarse casters may be.
SHARED_STRUCT ExactKeeping {
    bool32 keeps;        // tiles whose revision is as it was
    int changedBoxes;    // around casters that are not as they were
    float standInShift;  // by how much stand-ins may move an edge on the light: metres; distant: tangent of
                         // an angle
};

#ifdef __cplusplus
/// As weights.glsl has it.
struct ExactWeights {
    alignas(16) std::uint32_t changedAt;
    std::array<vec4, std::size_t(EXACT_MAX_LATTICES* EXACT_MAX_ROWS* EXACT_MAX_ROWS)> means;
};

static_assert(sizeof(ExactLight) ==
              32 + 16 * (8 + EXACT_MAX_LATTICES + EXACT_MAX_LATTICES * EXACT_MAX_ROWS / 4));
static_assert(sizeof(ExactFrame) == 48 && sizeof(TileBounds) == 48);
static_assert(sizeof(TileList) == 48 && sizeof(ExactRound) == 16);
}  // namespace penumbra::exact_visibility
#endif
#endif
