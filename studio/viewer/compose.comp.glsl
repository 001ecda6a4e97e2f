// SPDX-License-Identifier: Apache-2.0
#version 450
// The canvas: pictures side by side, or a number of each pixel as a colour.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/viewer/canvas_io.h"

layout(std140) uniform Constants { ComposeConstants constants; };
uniform sampler2D displayA;
uniform sampler2D displayB;
uniform sampler2D visibilityA;
uniform sampler2D visibilityB;
uniform sampler2D illuminanceA;
uniform sampler2D illuminanceB;
uniform sampler2D depthTexture;
uniform sampler2D normalTexture;
uniform sampler2D reachTexture;
uniform sampler2D orderedMap;
uniform sampler2D divergingMap;
layout(rgba8) uniform writeonly image2D canvasImage;
layout(r32f) uniform writeonly image2D isolineImage;

// Coloured visibility counts by the mean of its channels; others repeat their one (their textures are swizzled so).
float visibility(sampler2D visibilityTexture, ivec2 pixel) {
    return dot(texelFetch(visibilityTexture, pixel, 0).rgb, vec3(1.0 / 3.0));
}

float illuminance(ivec2 pixel) {
    pixel = clamp(pixel, ivec2(0), constants.size_px - 1);
    return pixel.x < constants.firstColumnOfB ? texelFetch(illuminanceA, pixel, 0).r
                                            : texelFetch(illuminanceB, pixel, 0).r;
}

// Place of a value in the map's range, in [0, 1].
float placeOf(float value) {
    vec2 range = vec2(constants.rangeMin, constants.rangeMax);
    if (constants.isLogarithmic) {
        value = log(max(value, 1e-20));
        range = log(max(range, 1e-20));
    }
    return clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
}

vec3 colorOf(sampler2D map, float place) {
    return texelFetch(map, ivec2(clamp(place, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
}

// How many of the levels ... 0.5, 1, 2, 5, 10 ... lie at or below the value.
int levelsBelow(float value) {
    if (value < 1e-6) return -100;
    float decade = floor(log(value) / log(10.0) + 1e-6);
    float digit = value / pow(10.0, decade);
    return 3 * int(decade) + (digit >= 4.9999 ? 2 : digit >= 1.9999 ? 1 : 0);
}

float levelOf(int index) {
    int decade = int(floor(float(index) / 3.0));
    int digit = index - 3 * decade;
    return (digit == 2 ? 5.0 : digit == 1 ? 2.0 : 1.0) * pow(10.0, float(decade));
}

float depth(ivec2 pixel) {
    return texelFetch(depthTexture, clamp(pixel, ivec2(0), constants.size_px - 1), 0).r;
}

// Whether a neighbour shows the same surface: depth, which is the inverse of distance or linear in it, goes on as
// it does on a plane on one of the two sides, and there is no crease.
bool isSameSurface(ivec2 pixel, ivec2 way) {
    ivec2 neighbour = pixel + way;
    if (any(greaterThanEqual(neighbour, constants.size_px))) return false;
    float here = depth(pixel), there = depth(neighbour);
    if (here <= 0.0 || there <= 0.0) return false;
    float step = there - here;
    float bend = min(abs(step - (here - depth(pixel - way))), abs(step - (depth(neighbour + way) - there)));
    const float flatness = 0.003, crease = 0.95;  // of the depth; the cosine of 18 degrees
    vec3 normalHere = texelFetch(normalTexture, pixel, 0).xyz;
    vec3 normalThere = texelFetch(normalTexture, neighbour, 0).xyz;
    return bend < flatness * here && dot(normalHere, normalThere) > crease;
}

// The level that lies between the pixel and its neighbours, or noIsoline. What differs from surface to surface is
// an outline.
float isolineAt(ivec2 pixel) {
    const float leastShare = 1e-4;  // of what is shown: below it dark surfaces differ by rounding
    float least = max(constants.rangeMin, leastShare * constants.rangeMax);
    int here = levelsBelow(illuminance(pixel));
    for (int axis = 0; axis < 2; ++axis) {
        ivec2 way = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        int there = levelsBelow(illuminance(pixel + way));
        float level = levelOf(max(here, there));
        if (here != there && level >= least && isSameSurface(pixel, way)) return level;
    }
    return noIsoline;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, constants.size_px))) return;
    bool isB = pixel.x >= constants.firstColumnOfB;
    vec3 shown = isB ? texelFetch(displayB, pixel, 0).rgb : texelFetch(displayA, pixel, 0).rgb;
    int kind = constants.shown;
    bool hasSurface = texelFetch(depthTexture, pixel, 0).r > 0.0;
    // Errors count where the unshadowed light arrives and nowhere else.
    bool isJudged = hasSurface && texelFetch(reachTexture, pixel, 0).r > 0.0;
    vec3 faded = vec3(0.1 + 0.15 * dot(shown, vec3(0.3, 0.6, 0.1)));

    if (kind == shownDifference) {
        float difference = visibility(visibilityA, pixel) - visibility(visibilityB, pixel);
        shown = isJudged ? colorOf(divergingMap, 0.5 + 0.5 * difference / constants.rangeMax) : faded;
    } else if (kind == shownError) {
        float difference = visibility(visibilityA, pixel) - visibility(visibilityB, pixel);
        shown = isJudged ? colorOf(orderedMap, placeOf(abs(difference))) : faded;
    } else if (kind == shownVisibility) {
        float value = isB ? visibility(visibilityB, pixel) : visibility(visibilityA, pixel);
        shown = isJudged ? colorOf(orderedMap, placeOf(value)) : faded;
    } else if (kind == shownIlluminance) {
        float value = illuminance(pixel);
        shown = hasSurface ? colorOf(orderedMap, placeOf(value)) : vec3(0.1);
        float level = hasSurface && constants.hasIsolines ? isolineAt(pixel) : noIsoline;
        // Dark on light colours, light on dark ones.
        if (level != noIsoline) shown = placeOf(value) > 0.45 ? vec3(0.0) : vec3(1.0);
        imageStore(isolineImage, pixel, vec4(level));
    }
    imageStore(canvasImage, pixel, vec4(shown, 1.0));
}
