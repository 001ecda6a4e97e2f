// SPDX-License-Identifier: Apache-2.0
#version 450
// The light itself, where nothing that is seen stands before it: its luminance in place of what is behind. It is no surface:
// it neither casts nor receives.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/frame/lighting_io.h"

layout(std140) uniform Constants { LightingConstants light; };
layout(std430) readonly buffer Profile { float profileValues[]; };

#include "studio/frame/irradiance.glsl"

uniform sampler2D depthTexture;
uniform sampler2D radianceTexture;
layout(rgba32f) uniform writeonly image2D radianceImage;
layout(r32f) uniform image2D nearnessImage;  // 1 / distance of the nearest light that is seen; 0: none is

struct Ray {
    vec3 origin;
    vec3 direction;  // unit
};

const float missed = -1.0;

// From the near plane on, in light space. At infinity a camera with perspective has directions in place of points.
Ray rayThrough(vec2 ndc) {
    vec4 near = light.lightFromClip * vec4(ndc, 1.0, 1.0), far = light.lightFromClip * vec4(ndc, 0.0, 1.0);
    return Ray(near.xyz / near.w, normalize(far.xyz * near.w - near.xyz * far.w));
}

// Where the ray enters what lies within `radius` of the origin, of as many dimensions as `origin` and `direction` have kept.
float distanceToRound(vec3 origin, vec3 direction, float radius) {
    float length2 = dot(direction, direction);
    float toClosest = -dot(origin, direction) / length2;
    vec3 closest = origin + toClosest * direction;
    float inside2 = radius * radius - dot(closest, closest);
    return inside2 > 0.0 ? toClosest - sqrt(inside2 / length2) : missed;
}

// To where the ray meets the light from a side to which it shines, or `missed`.
float distanceToLight(Ray ray) {
    const vec3 acrossTube = vec3(0.0, 1.0, 1.0);
    if (lightShape == shapeSphere) return distanceToRound(ray.origin, ray.direction, light.radius_m);
    if (lightShape == shapeCylinder) {
        float distance = distanceToRound(acrossTube * ray.origin, acrossTube * ray.direction, light.radius_m);
        return abs(ray.origin.x + distance * ray.direction.x) <= light.halfSize_m.x ? distance : missed;
    }
    if (ray.origin.z >= 0.0 && !light.isTwoSided) return missed;
    float distance = -ray.origin.z / ray.direction.z;
    vec2 place = ray.origin.xy + distance * ray.direction.xy;
    bool isWithin = lightShape == shapeRect ? all(lessThan(abs(place), light.halfSize_m))
                                            : dot(place, place) < light.radius_m * light.radius_m;
    return isWithin ? distance : missed;
}

// What a luminaire shows towards this direction. Candela that go on to the very horizon of a flat one would be of no area.
float shownArea_m2(vec3 direction) {
    const float leastCosine = 0.05;
    float cosine = max(abs(direction.z), leastCosine);
    if (lightShape == shapeRect) return 4.0 * light.halfSize_m.x * light.halfSize_m.y * cosine;
    if (lightShape == shapeDisk) return pi * light.radius_m * light.radius_m * cosine;
    if (lightShape == shapeSphere) return pi * light.radius_m * light.radius_m;
    float sine = max(length(direction.yz), leastCosine);
    return 4.0 * light.halfSize_m.x * light.radius_m * sine;
}

// Of a place of the light, towards a direction away from it.
vec3 luminance_nits(vec3 place, vec3 direction) {
    vec3 nits = light.emission * spotFactor(direction);
    if (light.isTextured) nits *= textureLod(radianceTexture, 0.5 * place.xy / light.halfSize_m + 0.5, 0.0).rgb;
    if (profileType == noProfile) return nits;
    float candela = profileCandela(light.profile, direction);
    return nits * (light.profile.isLuminaire ? candela / shownArea_m2(direction) : candela);
}

// Whether the surface that is seen at `ndc` stands before the light; what lies in a flat one's plane does not.
bool isHidden(vec2 ndc, float depth, Ray ray, float distance) {
    if (depth <= 0.0) return false;
    vec4 pos = light.lightFromClip * vec4(ndc, depth, 1.0);
    vec3 posLight = pos.xyz / pos.w;
    return dot(posLight - ray.origin, ray.direction) < distance && !isInLightPlane(posLight);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light.size_px))) return;
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(light.size_px) - 1.0;
    Ray ray = rayThrough(ndc);
    float distance = distanceToLight(ray);
    if (!(distance > 0.0) || isHidden(ndc, texelFetch(depthTexture, pixel, 0).r, ray, distance)) return;
    float nearness = 1.0 / distance;
    if (nearness <= imageLoad(nearnessImage, pixel).r) return;
    imageStore(nearnessImage, pixel, vec4(nearness));
    imageStore(radianceImage, pixel, vec4(luminance_nits(ray.origin + distance * ray.direction, -ray.direction), 1.0));
}
