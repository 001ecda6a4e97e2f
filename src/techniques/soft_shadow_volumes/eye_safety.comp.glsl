// SPDX-License-Identifier: Apache-2.0
#version 450
// Is the eye so close to the side of a shadow volume that rounding may put it on the wrong one? Then Z-pass would
// shade half the picture wrongly, and the sides are counted from behind instead.
layout(local_size_x = 64) in;

#include "src/geometry/silhouettes_io.h"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430) readonly buffer Commands { SilhouetteCommands commands; };
layout(std430) buffer Eye { EyeState eye; };

// Some hundred roundings of the largest coordinate that enters the side's plane.
const float tolerance = 1e-5;

void main() {
    if (gl_GlobalInvocationID.x >= commands.edgeCount) return;
    vec3 a = silhouettes[gl_GlobalInvocationID.x].aLight, b = silhouettes[gl_GlobalInvocationID.x].bLight;
    vec3 downA = shadowDirection(a), downB = shadowDirection(b);
    vec3 normal = cross(downA, b - a);
    vec3 fromA = volume.eyeLight.xyz - volume.eyeLight.w * a, fromB = volume.eyeLight.xyz - volume.eyeLight.w * b;
    float near = tolerance * (length(volume.eyeLight.xyz) + volume.eyeLight.w * max(length(a), length(b)));
    bool isInPlane = abs(dot(normal, fromA)) <= near * length(normal);
    // In the shadow that falls from between the edge's ends, not where the light comes from.
    float slack = near * length(normal);
    bool isBetween = dot(cross(normal, downA), fromA) >= -slack * length(downA) &&
                     dot(cross(normal, downB), fromB) <= slack * length(downB) &&
                     (volume.eyeLight.w != 0.0 || dot(downA + downB, volume.eyeLight.xyz) > 0.0);
    if (isInPlane && isBetween) eye.unsafe = 1;
}
