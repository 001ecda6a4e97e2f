// SPDX-License-Identifier: Apache-2.0
#version 450
// Sends the sides to the one or the other way of counting, and draws caps only where they are needed.
layout(local_size_x = 64) in;

#include "src/geometry/silhouettes_io.h"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer Commands { SilhouetteCommands commands; };
layout(std430) buffer Eye { EyeState eye; };
struct CapCommand { uint count, instanceCount, firstIndex, baseVertex, baseInstance; };
layout(std430) buffer Caps { CapCommand caps[]; };  // for Z-pass and Z-fail in turn

layout(std140) uniform Constants { CountingConstants how; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    bool fail = how.counting == 2 || (how.counting == 0 && eye.unsafe == 1);
    bool isOrthographic = volume.eyeLight.w == 0.0;
    if (i < how.casterCount) {
        caps[2u * i].instanceCount = !fail && how.mayHide ? 1u : 0u;
        // In parallel projection all far caps lie in one point.
        caps[2u * i + 1u].instanceCount = fail ? (isOrthographic ? 1u : 2u) : 0u;
    }
    if (i > 0u) return;
    uint vertices = how.hasEdges ? commands.vertexCount : 0u;
    eye.passSides = uvec4(vertices, fail ? 0u : 1u, 0u, 0u);
    eye.failSides = uvec4(vertices, fail ? 1u : 0u, 0u, 0u);
    eye.wedges = uvec4(4u * vertices, 1u, 0u, 0u);  // of 24 vertices, where sides have 6
    if (fail) eye.blockers = isOrthographic ? eye.blockersBehind : 0;
}
