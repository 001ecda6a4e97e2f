// SPDX-License-Identifier: Apache-2.0
// What the silhouette passes share; one struct for C++ and GLSL (std430).
#ifndef PENUMBRA_SILHOUETTES_IO_H
#define PENUMBRA_SILHOUETTES_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

// An edge that the light's point sees as a silhouette. Seen from there and walking from a to b, the surface
// lies to the left where the weight is positive, to the right where it is negative. The weight is the number
// of layers of surface that begin there: 2 at a fold (its front and its back), 1 at a boundary.
struct SilhouetteEdge {
    vec3 aLight;
    int weight;
    vec3 bLight;
    uint caster;  // its number in the list that was extracted from
    uint a;       // the ends' vertices, counted through all meshes of that list; welded ones share one number
    uint b;
    uint unused0;
    uint unused1;
};

// A mesh, and where its triangles' facings begin in the list of all meshes.
SHARED_STRUCT FacingConstants {
    vec4 lightMesh;  // the light's point, in mesh space, homogeneous
    uint triangleCount;
    uint firstFacing;
};

SHARED_STRUCT SilhouetteConstants {
    mat4 lightFromMesh;
    uint edgeCount;
    uint firstFacing;
    uint firstBlock;
    uint caster;       // as of SilhouetteEdge
    uint firstVertex;  // what its vertices are counted from
};

SHARED_STRUCT ScanConstants {
    uint blockCount;
    uint verticesPerEdge;  // of SilhouetteCommands
    uint instances;
};

// Counts on the device, ready for indirect calls.
struct SilhouetteCommands {
    uint vertexCount;  // DrawArraysIndirectCommand
    uint instanceCount;
    uint firstVertex;
    uint baseInstance;
    uint groupsX;  // DispatchIndirectCommand
    uint groupsY;
    uint groupsZ;
    uint edgeCount;
};

#ifdef __cplusplus
static_assert(sizeof(SilhouetteEdge) == 48);
static_assert(sizeof(SilhouetteCommands) == 32);
}  // namespace penumbra
#endif
#endif
