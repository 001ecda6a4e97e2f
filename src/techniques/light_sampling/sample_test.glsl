// SPDX-License-Identifier: Apache-2.0
// Whether a receiver sees samples of the light, and how much of the light each stands for.
// Variants: DISTANT, SPHERE; CUBE, where receivers surround the light; FILTER 2 or 3, a side of the kernel in texels,
// BOX_KERNEL, whose texels count alike; VOLUME, a ball that shines from all of its inside.
// LEAST_HEIGHT: how far a sample must be above the horizon to count, in parts of its distance.
#ifndef LEAST_HEIGHT
#define LEAST_HEIGHT 0.0
#endif
#include "src/techniques/common/light_plane.glsl"
#include "src/techniques/common/map_depth.glsl"
#include "src/techniques/light_sampling/batch.glsl"

uniform sampler2DArray maps;
layout(std430) readonly buffer Slots { int sampleOfSlot[]; };
layout(std430) readonly buffer Samples { LightSample samples[]; };
layout(std430) readonly buffer LayerTaps { LayerTap layerTaps[]; };

layout(std140) uniform LookupBlock { LookupConstants sampling; };

// A receiver in the axes of the maps; in a cube's, in those of the light.
struct Lookup {
    vec3 pos;
    vec3 normal;
};

Lookup makeLookup(Receiver receiver) {
#ifdef CUBE
    return Lookup(receiver.posLight, receiver.normalLight);
#else
    return Lookup(mat3(sampling.faceFromLight[0]) * receiver.posLight, mat3(sampling.faceFromLight[0]) * receiver.normalLight);
#endif
}

// No sample counts: the surface is on the side to which the light does not emit, or in its plane.
bool isBehindLight(Receiver receiver) { return isOutsideEmission(receiver.posLight, sampling.light); }

// What a sample counts for this receiver, per unit of its weight; 0 below the horizon. Rects and disks: 1, so that
// weights are areas. Distant: 1, weights being solid angles. Sphere: the solid angle dA cos / d^2 of the piece of
// surface that the sample stands for; from inside, its back counts. With irradiance, both cosines and 1 / d^2.
float countOf(LightSample light, Receiver receiver) {
#ifdef DISTANT
    float cosine = dot(receiver.normalLight, light.place);
    return cosine > LEAST_HEIGHT ? (sampling.isWeightedByIrradiance ? cosine : 1.0) : 0.0;
#else
    vec3 toSample = light.place - receiver.posLight;
    float above = dot(receiver.normalLight, toSample);
    float distance2 = dot(toSample, toSample);
    if (!(above > LEAST_HEIGHT * sqrt(distance2))) return 0.0;
#ifdef SPHERE
    // Relative to the sphere as seen from its centre's distance; the floor leaves something to compare where none of a
    // few samples faces the receiver.
    float radius2 = dot(light.place, light.place);
    float center2 = dot(receiver.posLight, receiver.posLight);
    float cosine = -dot(light.outward, toSample) * inversesqrt(distance2);
    if (center2 < radius2) cosine = abs(cosine);
    float count = max(cosine, 0.0) * light.perDensity * center2 / distance2 + 1e-4;
    return sampling.isWeightedByIrradiance ? count * above * inversesqrt(distance2) : count;
#elif defined(VOLUME)
    // A piece of the volume shines alike in all directions: 1 / d^2, relative to the centre's.
    float center2 = dot(receiver.posLight, receiver.posLight);
    float radius = sampling.light.halfSize.x;
    float count = (center2 + radius * radius) / max(distance2, 1e-6 * radius * radius);
    return sampling.isWeightedByIrradiance ? count * above * inversesqrt(distance2) : count;
#else
    if (!sampling.isWeightedByIrradiance) return 1.0;
    return above * abs(receiver.posLight.z) / (distance2 * distance2);
#endif
#endif
}

// One texel's comparison, free of bias for planes (see shadow_map's comparison, which this follows): the receiver's
// plane is intersected with the ray through the texel's centre. Multiplied by the stored depth so that nothing is
// divided by the background's 0.
float texelLit(int layer, LayerTap tap, vec3 pos, vec3 normal, float across, vec2 texel, float size_px) {
    float stored = texelFetch(maps, ivec3(clamp(ivec2(texel), ivec2(0), ivec2(size_px) - 1), layer), 0).r;
    vec2 place = (texel + 0.5) / (size_px * tap.window.perExtent) + tap.window.min;
#ifdef DISTANT
    float texel_m = tap.texelSize;
    float along = dot(normal.xy, tap.origin.xy) + normal.z;
    float receiver_m = (across - dot(normal.xy, place)) / along;
    if (along == 0.0) receiver_m = pos.z;
#else
    float texel_m = tap.texelSize * pos.z;
    float along = dot(normal, vec3(place, 1.0));
    float receiver_m = across * along > 0.0 ? across / along : pos.z + 64.0 * texel_m;
#endif
    receiver_m = clamp(receiver_m, pos.z - 64.0 * texel_m, pos.z);
    receiver_m -= mapTolerance_m(texel_m, pos);
#ifdef DISTANT
    return receiver_m <= sampling.far_m - stored * (sampling.far_m - sampling.near_m) || stored == 0.0 ? 1.0 : 0.0;
#else
    return receiver_m * stored <= sampling.near_m ? 1.0 : 0.0;
#endif
}

#ifdef DISTANT
// Of a sample's maps for parts of the picture, from `layer` on, the finest that shows the receiver.
int layerOfPart(int layer, vec3 pos) {
    for (int part = 0; part + 1 < batch.faces; ++part) {
        LayerTap tap = layerTaps[layer + part];
        vec2 uv = (pos.xy - tap.origin.xy * pos.z - tap.window.min) * tap.window.perExtent;
        if (all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)))) return layer + part;
    }
    return layer + batch.faces - 1;
}
#endif

#if !defined(CUBE)
// What a sample's map tells of its surroundings on the light. A blocker at some depth between receiver and light is
// seen from a place that lies `step` beside the sample where the line from there to the receiver passes its depth: so
// the map is asked there. `nearness` says how near to the light the blocker is: 1 / depth, less that of the receiver,
// or for distant lights the depth between the two. Depths are those in the map.
float blockerNearness(int layer, Lookup lookup) {
#ifdef DISTANT
    layer = layerOfPart(layer, lookup.pos);
#endif
    LayerTap tap = layerTaps[layer];
    vec3 pos = lookup.pos;
#ifdef DISTANT
    vec2 place = pos.xy - tap.origin.xy * pos.z;
#else
    pos -= tap.origin;
    vec2 place = pos.xy / pos.z;
#endif
    float size_px = float(textureSize(maps, 0).x);
    vec2 at = (place - tap.window.min) * tap.window.perExtent * size_px;
    float stored = texelFetch(maps, ivec3(clamp(ivec2(at), ivec2(0), ivec2(size_px) - 1), layer), 0).r;
#ifdef DISTANT
    return pos.z - (sampling.far_m - stored * (sampling.far_m - sampling.near_m));
#else
    return stored / sampling.near_m - 1.0 / pos.z;
#endif
}

// Negative where the map does not show that place.
float besideSampleLit(int layer, Lookup lookup, vec3 place, vec3 step, float nearness) {
    vec3 pos = lookup.pos;
#ifdef DISTANT
    layer = layerOfPart(layer, pos);
    LayerTap tap = layerTaps[layer];
    vec3 beside = mat3(sampling.faceFromLight[0]) * (place + step);
    vec2 slopes = beside.xy / min(beside.z, -1e-6);
    vec2 seenAt = pos.xy - tap.origin.xy * pos.z - (slopes - tap.origin.xy) * nearness;
#else
    LayerTap tap = layerTaps[layer];
    pos -= tap.origin;
    if (!(pos.z > 0.0)) return 1.0;
    float blocked = nearness * pos.z / (1.0 + nearness * pos.z);
    vec3 passes = mix(pos, mat3(sampling.faceFromLight[0]) * step, blocked);
    if (!(passes.z > 0.0)) return -1.0;
    vec2 seenAt = passes.xy / passes.z;
#endif
    float size_px = float(textureSize(maps, 0).x);
    vec2 at = (seenAt - tap.window.min) * tap.window.perExtent * size_px;
    if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(size_px))))) return -1.0;
    return texelLit(layer, tap, pos, lookup.normal, dot(lookup.normal, pos), floor(at), size_px);
}
#endif

// Share of the sample that the receiver sees: 0 or 1, and between them where maps are filtered.
float sampleLit(int layer, Lookup lookup) {
    vec3 pos = lookup.pos;
    vec3 normal = lookup.normal;
#ifdef CUBE
    LayerTap tap;
    vec3 posFace = vec3(0.0, 0.0, -1.0);
    vec2 place = vec2(2.0);
    int face = 0;
    for (; face < batch.faces; ++face) {
        tap = layerTaps[layer + face];
        posFace = mat3(sampling.faceFromLight[face]) * pos - tap.origin;
        place = posFace.xy / posFace.z;
        if (posFace.z > 0.0 && all(lessThanEqual(abs(place), vec2(1.0)))) break;
    }
    if (face == batch.faces) return 1.0;
    layer += face;
    pos = posFace;
    normal = mat3(sampling.faceFromLight[face]) * normal;
    float across = dot(normal, pos);
#elif defined(DISTANT)
    layer = layerOfPart(layer, pos);
    LayerTap tap = layerTaps[layer];
    vec2 place = pos.xy - tap.origin.xy * pos.z;
    float across = dot(normal, pos);
#else
    LayerTap tap = layerTaps[layer];
    pos -= tap.origin;
    vec2 place = pos.xy / pos.z;
    float across = dot(normal, pos);
    if (!(pos.z > 0.0)) return 1.0;
#endif
    float size_px = float(textureSize(maps, 0).x);
    vec2 at = (place - tap.window.min) * tap.window.perExtent * size_px;
    if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(size_px))))) return 1.0;
#if FILTER == 3 && defined(BOX_KERNEL)
    // The plain mean of 3 x 3 tests.
    float lit = 0.0;
    for (int i = 0; i < 9; ++i)
        lit += texelLit(layer, tap, pos, normal, across, floor(at) + vec2(i % 3 - 1, i / 3 - 1), size_px);
    return lit / 9.0;
#elif FILTER == 3
    // Quadratic B-spline over 3 x 3 texels.
    vec2 middle = floor(at), f = at - middle - 0.5;
    vec2 weights[3] = vec2[3](0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f));
    float lit = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 step = ivec2(i % 3, i / 3);
        lit += weights[step.x].x * weights[step.y].y *
               texelLit(layer, tap, pos, normal, across, middle + vec2(step - 1), size_px);
    }
    return lit;
#elif FILTER == 2
    // Bilinear over 2 x 2.
    vec2 low = floor(at - 0.5), f = at - 0.5 - low;
    float lit = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - f, f, vec2(step));
        lit += weight.x * weight.y * texelLit(layer, tap, pos, normal, across, low + vec2(step), size_px);
    }
    return lit;
#else
    return texelLit(layer, tap, pos, normal, across, floor(at), size_px);
#endif
}
