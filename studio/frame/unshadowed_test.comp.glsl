// SPDX-License-Identifier: Apache-2.0
#version 450
// Evaluates the closed forms at given receivers, for frame_test.cpp.
layout(local_size_x = 1) in;

#include "studio/frame/unshadowed.glsl"

struct Case {
    vec4 pos;     // w: shape
    vec4 normal;  // w: result
    vec4 size;    // xy: half extents; z: radius; w: half angle
};
layout(std430) buffer Cases { Case cases[]; };

void main() {
    Case c = cases[gl_GlobalInvocationID.x];
    float result;
    if (c.pos.w == float(shapeRect)) {
        result = rectIrradiance(c.pos.xyz, c.normal.xyz, c.size.xy);
    } else if (c.pos.w == float(shapeDisk)) {
        result = diskIrradiance(c.pos.xyz, c.normal.xyz, c.size.z);
    } else if (c.pos.w == float(shapeSphere)) {
        result = coneIrradiance(-normalize(c.pos.xyz), c.normal.xyz, min(1.0, c.size.z / length(c.pos.xyz)));
    } else if (c.pos.w == float(shapeCylinder)) {
        result = tubeIrradiance(c.pos.xyz, c.normal.xyz, c.size.x, c.size.z);
    } else {
        result = coneIrradiance(vec3(0.0, 0.0, 1.0), c.normal.xyz, sin(c.size.w));
    }
    cases[gl_GlobalInvocationID.x].normal.w = result;
}
