// SPDX-License-Identifier: Apache-2.0
// What the shaders of `hard`, `pcf` and `pcss` need to know; structs for C++ and GLSL (std140).
#ifndef PENUMBRA_SHADOW_MAP_IO_H
#define PENUMBRA_SHADOW_MAP_IO_H

#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra::shadow_map {
#endif

SHARED_STRUCT HardConstants {
    LightConstants light;
    int mapCount;
};

// The values of penumbra::Pcf::Kernel.
const int kernelBilinear = 0;
const int kernelTent3 = 1;
const int kernelTent5 = 2;
const int kernelBicubic = 3;
const int kernelPoisson = 4;

SHARED_STRUCT PcfConstants {
    LightConstants light;
    int mapCount;
    int kernel;
    float radius_px;
    int poissonCount;
};

SHARED_STRUCT PcssConstants {
    LightConstants light;
    float oneMinusCosine;  // of a distant light's half angle
    int searchSamples;
    int filterSamples;
    bool32 isRotated;  // the patterns, from pixel to pixel
    bool32 meanIsHarmonic;
    int mapCount;
    int tile_px;  // width of a tile of the maps (nearest_tiles.glsl)
};

// How near blockers may be, of a map (nearest_tiles.comp.glsl).
SHARED_STRUCT NearestTilesConstants {
    LightConstants light;
    int tile_px;  // width of a tile
};

#ifdef __cplusplus
}  // namespace penumbra::shadow_map
#endif
#endif
