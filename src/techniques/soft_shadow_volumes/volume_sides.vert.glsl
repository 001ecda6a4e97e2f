// SPDX-License-Identifier: Apache-2.0
#version 450
// The sides of shadow volumes: each silhouette edge, drawn away from the light to infinity (Everitt and Kilgard 2003).
#include "src/geometry/silhouettes_io.h"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430) readonly buffer Layers { int layersEach[]; };  // a triangle of each caster counts for
layout(std140) uniform Constants { SidesConstants sides; };
layout(location = 0) flat out float change;

const float edgeOn = 1e-6;  // some ten roundings

const int corners[6] = int[](0, 1, 3, 0, 3, 2);

void main() {
    SilhouetteEdge edge = silhouettes[gl_VertexID / 6];
    int corner = corners[gl_VertexID % 6];
    vec3 place = (corner & 1) == 0 ? edge.aLight : edge.bLight;
    gl_Position = volume.clipFromLight * ((corner & 2) == 0 ? vec4(place, 1.0) : vec4(shadowDirection(place), 0.0));
    // Passing to the side where sideOfEdge is positive, one leaves `weight` layers.
    vec3 normal = cross(shadowDirection(edge.aLight), edge.bLight - edge.aLight);
    vec3 toEye = volume.eyeLight.xyz - volume.eyeLight.w * edge.aLight;
    float ofEye = dot(normal, toEye);
    change = sides.sign * float(edge.weight * layersEach[edge.caster]) * (ofEye < 0.0 ? -1.0 : 1.0);
    // Seen edge-on a side covers nothing, but its rounded corners at infinity may lie anywhere.
    if (abs(ofEye) <= edgeOn * length(normal) * length(toEye)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
