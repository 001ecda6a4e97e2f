// SPDX-License-Identifier: Apache-2.0
// What the light sampling techniques share between C++ and GLSL (std430).
#ifndef PENUMBRA_SAMPLING_IO_H
#define PENUMBRA_SAMPLING_IO_H

#include "src/techniques/common/light_camera_io.h"
#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra::light_sampling {
#endif

// A point of the light, and its cell: the part of the unit square, laid over the light, that it stands for.
SHARED_STRUCT LightSample {
    vec3 place;  // in light space, or the unit direction towards a distant light
    float perDensity;
    vec3 outward;        // of a sphere
    float cellSide;      // in sides of the unit square
    vec3 radianceShare;  // of the light's emission
    float areaShare;     // of the light's area
    vec3 spanU;          // how `place` moves along the unit square's sides
    float cellMiddleU;   // from the sample to its cell's middle, in sides of the unit square
    vec3 spanV;
    float cellMiddleV;
};

// A layer's map, as a receiver is looked up in it. All samples share the axes of their maps.
SHARED_STRUCT LayerTap {
    vec3 origin;  // perspective: the sample in face space; orthographic: xy: the light's slopes
    float texelSize;
    MapWindow window;
};

SHARED_STRUCT SampleCamera {
    LightCameraConstants camera;
    LayerTap tap;
};

// A caster for the device to cull.
SHARED_STRUCT CullBox {
    vec4 corners[8];  // light space; w: 1
    uint indexCount;  // 0 where it casts nothing
};

// A piece of the picture: a box around its receivers, in the axes of the maps (a cube's: the light's), as
// orderedBits; low.x > high.x where it has none. The last of each: 4 rows of 8 quads of level 3, a bit each,
// whose samples of level 4 are asked for; of all receivers, a sum that changes with any of them.
struct ReceiverTile {
    uvec4 low, high;
};
const int mostTiles = 4096;

// Groups to dispatch where the last frame's answer is kept; x: 0 unless receivers have moved.
struct RedrawGroups {
    uvec4 tiles, slots, pixels;
};

// What a map has to show: the depth along its axis of the farthest receiver in each cell, as orderedBits; 0:
// there is none.
const int maskSide = 32;
struct LayerMask {
    ivec4 cells;  // xy: first, zw: last cell that has receivers; none: z < 0
    uint farthest[maskSide * maskSide];
};

// What glDrawElementsIndirect reads, and with its first four glDrawArraysIndirect.
struct DrawCommand {
    int count;
    int instanceCount;
    int firstIndex;
    int baseVertex;
    int baseInstance;
};

// Slots hold the samples that have maps, in the order in which they were chosen; a stage is a run of slots
// whose maps are drawn together: those of a round of the subdivision, or everything.
const int maxStages = 8;
const int mostRounds = 4;
const int stageOfCoarse = 5;   // what is compared: of all rounds
const int stageOfDeepest = 6;  // what is not
const int stageOfAll = 7;

struct SamplingPlan {
    ivec4 stages[maxStages];  // x: first slot; y: number of slots; yzw: as many groups, to dispatch
    uvec4 compareGroups;      // to dispatch for the slots of the next round: none where it has none
    uvec4 examineGroups;
    ivec4 evaluated;  // x: samples to evaluate, in the order of `Order`
};

// Which slots of the plan a pass is about.
SHARED_STRUCT BatchConstants {
    int stage;
    int index;          // of the batch in its stage
    int capacity;       // slots that have room in all
    int faces;          // maps a slot
    bool32 isResident;  // compared samples have layers of their own; else batches share all of them
};

// What sample_test.glsl needs.
SHARED_STRUCT LookupConstants {
    mat4 faceFromLight[6];  // of the first, where maps are no cube's
    LightConstants light;
    float near_m;  // of all maps, as LightCamera has them
    float far_m;
    bool32 isWeightedByIrradiance;
};

SHARED_STRUCT PlaceLayersConstants {
    mat4 face0FromLight;
    int tileCount;  // negative: maps are to show everything
    bool32 isCube;
    float reach;             // of the filter between samples, in sides of the unit square
    float nearestBlocker_m;  // along the axis from the plane of any sample; distant: depth
    int mapSize_px;
    bool32 asksByQuads;  // tiles say which quads of level 3 they ask for
};

SHARED_STRUCT GatherConstants {
    int casterCount;
    int layersInAll;
    bool32 isKept;  // maps of the last frame are, unless receivers have moved
};

SHARED_STRUCT ReceiverTilesConstants {
    ivec2 size_px;  // of the picture
    int tile_px;
    float lightRadius;  // around the light's centre in metres; distant: its sine
    int slots;          // to draw again where receivers have moved
};

SHARED_STRUCT CompareConstants {
    ivec2 target_px;
    bool32 starts;
    int baseDepth;  // of the tree at its start
};

SHARED_STRUCT EvaluateConstants {
    int firstSlot;  // of the batch, to sum
    int endSlot;
    int taps;  // of the filter between samples, a power of two
};

SHARED_STRUCT WeighConstants {
    int count;
};

#ifdef __cplusplus
static_assert(sizeof(LightSample) == 80 && sizeof(LayerTap) == 32 && sizeof(CullBox) == 144);
static_assert(sizeof(ReceiverTile) == 32 && sizeof(RedrawGroups) == 48 &&
              sizeof(LayerMask) == 16 + 4 * maskSide * maskSide);
static_assert(sizeof(DrawCommand) == 20 && sizeof(SamplingPlan) == 176 && sizeof(SampleCamera) == 192);
}  // namespace penumbra::light_sampling
#else
// Larger numbers have larger bits.
uint orderedBits(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float fromOrderedBits(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}
#endif
#endif
