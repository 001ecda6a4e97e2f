// SPDX-License-Identifier: Apache-2.0
// What this room's shaders are told; one struct each for C++ and GLSL (std140).
#ifndef PENUMBRA_SMOOTHIES_IO_H
#define PENUMBRA_SMOOTHIES_IO_H

#include "src/gl/shared_types.h"
#include "src/techniques/common/light_camera_io.h"
#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra::smoothies {
#endif

const int maxSmoothieCameras = 6;  // the faces of a cube
const int layersPerCamera = 4;     // of edge numbers: the outer half, and three of the inner half
const int smoothieTexel_px = 2;    // of the depth map, along each axis
const int tileSize_px = 8;         // of the picture, for the pixels that smoothies reach
const int tilesPerRow = 1024;      // of the list of those tiles, as it is dispatched

// The profile of a textured light (light_profile.glsl), its first column repeated as its last.
const int profileDirections = 64;
const int profileOffsets = 64;

// How visibility grows across a smoothie.
const int falloffLight = 0;  // as the light's shape asks for
const int falloffLinear = 1;
const int falloffSinusoidal = 2;

// What a light camera needs to know for drawing and reading smoothies. Widths are in window units: tangents
// or metres. Of 256 bytes, so that a block may begin with any of them.
SHARED_STRUCT SmoothieConstants {
    LightCameraConstants camera;
    LightConstants light;
    vec3 halfX;        // the light's half axis along its width or radius, in face space, metres
    float radius;      // of a sphere, metres; of a distant light the tangent of half its angle
    vec3 halfY;        // the same along its height
    float fixedWidth;  // the paper's t; 0: none
    float smallestWidth;
    float largestWidth;
    float farthestReceiver;  // nearness
    float nearestDrawn;      // nearness of the nearest point that is drawn
    float fixedFrom;         // nearness that an orthographic camera measures the paper's b and r from
    int falloff;
    bool32 isRemapped;  // alpha, by equation 1
    bool32 hasInnerHalf;
};

// For the passes that find, build and draw smoothies.
SHARED_STRUCT ConstructionConstants {
    bool32 hasReceiverMaps;
    bool32 isDistant;
    int cameraCount;
    int drawnCamera;
    uint capacity;  // edges for each camera
};

// For the passes over the picture.
SHARED_STRUCT PictureConstants {
    LightConstants light;
    int mapCount;
    bool32 hasSmoothies;     // without: a hard shadow
    uint capacity;           // edges for each camera
    float nearestNearness;   // of all blockers that have holes
    bool32 hasFarthestMaps;  // of what may be hidden beneath another caster
};

#ifdef __cplusplus
static_assert(sizeof(SmoothieConstants) == 256);
}  // namespace penumbra::smoothies
#endif
#endif
