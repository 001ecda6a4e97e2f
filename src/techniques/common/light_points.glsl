// SPDX-License-Identifier: Apache-2.0
// Points of the light as a place in a light camera's window shows them.
#ifndef PENUMBRA_LIGHT_POINTS
#define PENUMBRA_LIGHT_POINTS
#include "src/techniques/common/light_io.h"

// In a camera's face space, metres: half axes of a rect or a disk; of a sphere the radius, of a distant light the tangent of
// half its angle.
struct LightFigure {
    int shape;  // shapeRect, ...
    vec3 halfX, halfY;
    float radius;
};

// The point at a place in the unit square, which is spread evenly over the light's shape; from the light's centre, in face
// space; of a distant light in tangents.
vec3 lightPoint(LightFigure light, vec2 u, vec2 place) {
    if (light.shape == shapeRect) return (2.0 * u.x - 1.0) * light.halfX + (2.0 * u.y - 1.0) * light.halfY;
    vec2 disk = sqrt(u.x) * vec2(cos(6.28318531 * u.y), sin(6.28318531 * u.y));
    if (light.shape == shapeDisk) return disk.x * light.halfX + disk.y * light.halfY;
    if (light.shape == shapeDistant) return vec3(light.radius * disk, 0.0);
    // The disk that a sphere shows.
    vec3 x = normalize(vec3(1.0, 0.0, -place.x));
    vec3 y = normalize(cross(vec3(place, 1.0), x));
    return light.radius * (disk.x * x + disk.y * y);
}

// Of any number of points, by the R2 sequence (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
vec3 lightPoint(LightFigure light, int i, vec2 place) {
    return lightPoint(light, fract(vec2(0.7548776662, 0.5698402910) * float(i) + 0.5), place);
}
#endif
