// SPDX-License-Identifier: Apache-2.0
#version 450
// What a surface point sees when it looks at a light: the light, and what blocks it.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/viewer/canvas_io.h"

uniform sampler2D depthTexture;
uniform sampler2D normals;  // world space
uniform sampler2D albedoTexture;
layout(std140) uniform Constants { LightViewConstants constants; };
layout(rgba8) uniform writeonly image2D picture;

const float miss = -1.0;
const float farAway = 1e30;

// How far along the unit `direction` the light is hit, or `miss`.
float hitDistance(vec3 eye, vec3 direction) {
    if (constants.shape == shapeDistant) return direction.z >= cos(constants.halfAngle_rad) ? farAway : miss;
    if (constants.shape == shapeSphere) {
        float along = -dot(eye, direction);
        float h2 = constants.radius_m * constants.radius_m - dot(eye, eye) + along * along;
        if (h2 < 0.0) return miss;
        float near = along - sqrt(h2);
        return near > 0.0 ? near : along + sqrt(h2);
    }
    if (constants.shape == shapeCylinder) {
        float across2 = dot(direction.yz, direction.yz), along = -dot(eye.yz, direction.yz);
        float h2 = constants.radius_m * constants.radius_m * across2 - dot(eye.yz, eye.yz) * across2 + along * along;
        if (h2 < 0.0 || across2 == 0.0) return miss;
        float t = (along - sqrt(h2)) / across2;
        return t > 0.0 && abs(eye.x + t * direction.x) <= constants.halfSize_m.x ? t : miss;
    }
    if (direction.z == 0.0) return miss;
    float t = -eye.z / direction.z;
    vec2 hit = eye.xy + t * direction.xy;
    bool inside = constants.shape == shapeRect ? all(lessThanEqual(abs(hit), constants.halfSize_m)) : length(hit) <= constants.radius_m;
    return t > 0.0 && inside ? t : miss;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size))) return;
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(size) - 1.0;
    vec4 onRay = constants.lightFromClip * vec4(ndc, 1.0, 1.0);  // on the near plane
    vec3 direction = normalize(onRay.xyz / onRay.w - constants.eyeLight);

    float depth = texelFetch(depthTexture, pixel, 0).r;
    float surface = farAway;
    if (depth > 0.0) {
        vec4 pos = constants.lightFromClip * vec4(ndc, depth, 1.0);
        surface = distance(pos.xyz / pos.w, constants.eyeLight);
    }
    vec3 albedo = texelFetch(albedoTexture, pixel, 0).rgb;
    float facing = abs(dot(texelFetch(normals, pixel, 0).xyz, constants.eyeWorldForward));
    vec3 shaded = depth > 0.0 ? (0.08 + 0.25 * facing) * sqrt(albedo) : vec3(0.05, 0.055, 0.065);

    float light = hitDistance(constants.eyeLight, direction);
    if (light != miss) {
        bool isBlocked = surface < light * (1.0 - 1e-5);
        shaded = isBlocked ? vec3(0.55, 0.12, 0.1) * (0.4 + 0.8 * facing) : vec3(1.0, 0.93, 0.72);
    }
    imageStore(picture, pixel, vec4(shaded, 1.0));
}
