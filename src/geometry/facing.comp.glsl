// SPDX-License-Identifier: Apache-2.0
#version 450
// Which triangles of a mesh show their front to the light's point (facing.h). Decided once for each triangle, so that
// all its edges agree.
layout(local_size_x = 256) in;

#include "src/geometry/silhouettes_io.h"

layout(std430) readonly buffer Positions { float positions[]; };
layout(std430) readonly buffer Indices { uint indices[]; };
layout(std430) writeonly buffer Facings { int facings[]; };

layout(std140) uniform Constants { FacingConstants mesh; };

vec3 corner(uint index) {
    uint i = 3u * indices[index];
    return vec3(positions[i], positions[i + 1u], positions[i + 2u]);
}

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= mesh.triangleCount) return;
    vec3 a = corner(3u * triangle);
    // "precise" keeps compilers from fusing products into sums, which would part us from the CPU.
    precise vec3 u = corner(3u * triangle + 1u) - a;
    precise vec3 v = corner(3u * triangle + 2u) - a;
    precise vec3 normal = vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    precise vec3 towardsLight = mesh.lightMesh.xyz - mesh.lightMesh.w * a;
    precise float side = (normal.x * towardsLight.x + normal.y * towardsLight.y) + normal.z * towardsLight.z;
    facings[mesh.firstFacing + triangle] = side > 0.0 ? 1 : -1;
}
