// SPDX-License-Identifier: Apache-2.0
#version 450
// What a light sends to points: illuminance with its shadows, how far that may be off, and what of the light is seen.
// Defines: ONLY_SHAPE, ONLY_PROFILE and ONLY_EVEN_ANGLES (irradiance.glsl); WITH_TEXTURE; CELLS, along each side of a
// rectangle, for each of which it is known what is seen of it.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/frame/point_lighting_io.h"

layout(std140) uniform Constants { PointLightingConstants points; };
layout(std430) readonly buffer Profile { float profileValues[]; };
#define light points.light

#include "studio/frame/irradiance.glsl"

uniform sampler2D places;   // red: 1 where there is a point; green, blue, alpha: where, in world space
uniform sampler2D normals;  // in world space
uniform sampler2D visibilityTexture;
uniform sampler2D errorBound;
#ifdef WITH_TEXTURE
uniform sampler2D radianceTexture;
#endif
#ifdef CELLS
uniform sampler2DArray cells;  // weights of what is seen of each, and of all of it; nothing where it is as the whole
#endif
layout(rgba32f) uniform writeonly image2D measured;  // lux, its bound, the share seen, lux without shadows

#ifdef WITH_TEXTURE
// Irradiance of a textured rect, whose parts count by what they emit.
vec3 texturedIrradiance(vec3 pos, vec3 normal) {
    const int most = 32;
    float distance_m = length(vec3(max(abs(pos.xy) - light.halfSize_m, 0.0), pos.z));
    vec2 size_m = 2.0 * light.halfSize_m;
    ivec2 parts = min(2 * ivec2(pointsAlong(size_m.x, distance_m, leastPointsPerDistance),
                                pointsAlong(size_m.y, distance_m, leastPointsPerDistance)), most);
    vec2 texels = vec2(textureSize(radianceTexture, 0)) / vec2(parts);
    float level = max(log2(max(texels.x, texels.y)), 0.0);
    vec3 sum = vec3(0.0);
    float whole = 0.0;
    for (int y = 0; y < parts.y; ++y) {
        for (int x = 0; x < parts.x; ++x) {
            vec2 place = (vec2(x, y) + 0.5) / vec2(parts);
            vec3 towards = vec3((2.0 * place - 1.0) * light.halfSize_m, 0.0) - pos;
            float distance2 = dot(towards, towards);
            float part = max(dot(normal, towards), 0.0) * abs(towards.z) / max(distance2 * distance2, 1e-30);
            sum += part * textureLod(radianceTexture, place, level).rgb;
            whole += part;
        }
    }
    return whole > 0.0 ? sum / whole * irradiance(pos, normal) : vec3(0.0);
}
#endif

#ifdef CELLS
// Where a profile makes the cells of a rectangle send unlike to a point, what each sends and what is seen of it go together.
struct OfCells {
    float seen, whole, brightest;  // irradiance, of an emission of 1
};

OfCells irradianceOfCells(vec3 pos, vec3 normal, ivec2 pixel, float seenOfWhole) {
    OfCells sum = OfCells(0.0, 0.0, 0.0);
    if (isAside(pos)) return sum;
    float share = light.profile.isLuminaire ? 1.0 / float(CELLS * CELLS) : 1.0;  // candela are the whole luminaire's
    share *= spotFactor(pos);
    for (int i = 0; i < CELLS * CELLS; ++i) {
        vec2 place = (vec2(i % CELLS, i / CELLS) + 0.5) * (2.0 / float(CELLS)) - 1.0;
        vec3 posCell = pos - vec3(place * light.halfSize_m, 0.0);
        float part = share * profiledRect(light.profile, posCell, normal, light.halfSize_m / float(CELLS));
        vec2 weights = texelFetch(cells, ivec3(pixel, i), 0).rg;
        sum.whole += part;
        sum.seen += part * (weights.y > 0.0 ? weights.x / weights.y : seenOfWhole);
        sum.brightest = max(sum.brightest, part);
    }
    return sum;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light.size_px))) return;
    vec4 result = vec4(0.0);
    vec4 place = texelFetch(places, pixel, 0);
    if (place.r > 0.0) {
        vec3 pos = (light.lightFromWorld * vec4(place.gba, 1.0)).xyz;
        vec3 normal = normalize(mat3(light.lightFromWorld) * texelFetch(normals, pixel, 0).xyz);
#ifdef CELLS
        OfCells ofCells = irradianceOfCells(pos, normal, pixel, texelFetch(visibilityTexture, pixel, 0).r);
        float perIrradiance = dot(light.emission, luminanceOfRec709);
        // Samples that may be seen or hidden may all be the brightest cell's.
        float bound = texelFetch(errorBound, pixel, 0).r * ofCells.brightest * float(CELLS * CELLS) * perIrradiance;
        float share = ofCells.whole > 0.0 ? ofCells.seen / ofCells.whole : 0.0;
        result = vec4(ofCells.seen * perIrradiance, bound, share, ofCells.whole * perIrradiance);
#else
        vec3 unshadowed = light.emission;
#ifdef WITH_TEXTURE
        unshadowed *= texturedIrradiance(pos, normal);
#else
        unshadowed *= irradiance(pos, normal);
#endif
        vec3 seen = vec3(1.0);
        if (points.isShadowed) {
            vec4 visibility = texelFetch(visibilityTexture, pixel, 0);
            seen = light.isVisibilityColored ? visibility.rgb : visibility.rrr;
        }
        float lux = dot(unshadowed, luminanceOfRec709);
        float bound = points.isShadowed ? texelFetch(errorBound, pixel, 0).r * lux : 0.0;
        float share = lux > 0.0 ? dot(unshadowed * seen, luminanceOfRec709) / lux : 0.0;
        result = vec4(dot(unshadowed * seen, luminanceOfRec709), bound, share, lux);
#endif
    }
    imageStore(measured, pixel, result);
}
