// SPDX-License-Identifier: Apache-2.0
// What this room's shaders are told; one struct each for C++ and GLSL (std140).
#ifndef PENUMBRA_SHADOW_WIDTH_IO_H
#define PENUMBRA_SHADOW_WIDTH_IO_H

#include "src/gl/shared_types.h"
#include "src/techniques/common/light_camera_io.h"
#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra::shadow_width_map {
#endif

// How far windows are widened at most, beyond the receivers that they were fitted to, in shares of
// themselves.
const float widestMargin = 1.0f / 6.0f;

// The light and the maps, for all that resolves. Directions are in the receivers' space: the map's where
// there is one map, else the light's. Half axes are (width / 2, 0, 0) and (0, height / 2, 0) of a rect in the
// light's space, (radius, 0, 0) and (0, radius, 0) of a disk, 0 of others.
SHARED_STRUCT ShadowWidthConstants {
    LightConstants light;
    vec3 halfAxisX;
    float radius;  // of a sphere, metres; of a distant light tan(angle / 2); 0 of others
    vec3 halfAxisY;
    int mapCount;
    vec3 emission;                     // where the light's -Z points
    int kinds;                         // of edges (edge_cells.glsl)
    LightCameraConstants firstCamera;  // of the depth maps; with one map, in that map's space
    int cell_px;                       // a cell's width in texels
    int cellsAcross;                   // a map
};

// Exact mode: for the passes that find edges.
SHARED_STRUCT EdgeConstants {
    int kinds;
    int cell_px;  // 1, 2, 4 or 8
    int mapCount;
    float halfExtent;  // the light's largest: metres, or a tangent
};

// A step of compositing.
SHARED_STRUCT CompositeConstants {
    int neighbours;  // 3 or 6, evenly around; 0: the inverted occlusion map itself
    float distance_px;
    float difference;
    float background;  // the depth where there is no caster
};

// The published attenuation.
SHARED_STRUCT AttenuationConstants {
    bool32 isPhysical;  // c_scale follows from the light
    float cScale;
    float cBias;
    float unit_px;         // texels to a unit of width
    float curveEnd;        // the ratio sw / sd that the table ends at
    float umbraBegins;     // the ratio at which it has no light left
    float meanHalfExtent;  // the light's: metres, or a tangent
    float background;      // the depth where there is no caster
    float plane_m;         // where widths are measured; 0: at the receiver
};

#ifdef __cplusplus
static_assert(sizeof(ShadowWidthConstants) == 256);
}  // namespace penumbra::shadow_width_map
#endif
#endif
