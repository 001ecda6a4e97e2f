// SPDX-License-Identifier: Apache-2.0
#version 450
// One light: unshadowed irradiance times visibility times albedo, added to what other lights have left.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/frame/lighting_io.h"
#include "studio/frame/unshadowed.glsl"

layout(std140) uniform Constants { LightingConstants light; };
layout(std430) readonly buffer Profile { float profileValues[]; };

#include "studio/frame/profile.glsl"

uniform sampler2D depthTexture;
uniform sampler2D shadingNormals;
uniform sampler2D albedoTexture;
uniform sampler2D visibilityTexture;
uniform sampler2D radianceTexture;
layout(rgba32f) uniform image2D radianceImage;           // with shadows
layout(rgba32f) uniform image2D unshadowedImage;         // without
layout(r32f) uniform writeonly image2D reachImage;       // this light's unshadowed irradiance
layout(r32f) uniform image2D illuminanceImage;           // lux, with shadows

// Irradiance of a light of size zero whose emission is 1 candela or 1 lux.
float pointIrradiance(vec3 pos, vec3 normal) {
    vec3 towards = light.shape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -pos;
    float distance2 = light.shape == shapeDistant ? 1.0 : dot(towards, towards);
    return distance2 > 0.0 ? max(0.0, dot(normal, normalize(towards))) / distance2 : 0.0;
}

float irradiance(vec3 pos, vec3 normal) {
    int shape = light.shape;
    bool behind = pos.z >= 0.0;
    if ((shape == shapeRect || shape == shapeDisk) && behind && !light.isTwoSided) return 0.0;
    // What lies in the plane of a flat light sees nothing of it.
    vec2 halfSize_m = shape == shapeRect ? light.halfSize_m : vec2(light.radius_m);
    bool isFlat = (shape == shapeRect || shape == shapeDisk) && !light.isPoint;
    if (isFlat && abs(pos.z) <= light.planeTolerance * (length(pos) + length(halfSize_m))) return 0.0;
    if (light.profile.type != noProfile)
        return profiledIrradiance(light.profile, shape, light.isPoint, light.halfSize_m, light.radius_m, pos, normal);
    if (light.isPoint) return pointIrradiance(pos, normal);
    if (shape == shapeRect) return rectIrradiance(pos, normal, light.halfSize_m);
    if (shape == shapeDisk) return diskIrradiance(pos, normal, light.radius_m);
    if (shape == shapeSphere) {
        float distance = length(pos);
        return distance > 0.0 ? coneIrradiance(-pos / distance, normal, min(1.0, light.radius_m / distance)) : 0.0;
    }
    return coneIrradiance(vec3(0.0, 0.0, 1.0), normal, sin(light.halfAngle_rad));
}

// The falloff of KHR_lights_punctual, between the inner and the outer cone.
float spotFactor(vec3 pos) {
    if (light.coneCosines.y < -1.5) return 1.0;
    float cosine = dot(normalize(pos), vec3(0.0, 0.0, -1.0));
    float factor = clamp((cosine - light.coneCosines.y) / max(1e-4, light.coneCosines.x - light.coneCosines.y), 0.0, 1.0);
    return factor * factor;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light.size_px))) return;
    float reach = 0.0;

    float depth = texelFetch(depthTexture, pixel, 0).r;
    vec4 albedo = texelFetch(albedoTexture, pixel, 0);
    if (depth > 0.0 && albedo.a > 0.5) {
        vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(light.size_px) - 1.0;
        vec4 pos = light.lightFromClip * vec4(ndc, depth, 1.0);
        vec3 posLight = pos.xyz / pos.w;
        vec3 normalLight = normalize(mat3(light.lightFromWorld) * texelFetch(shadingNormals, pixel, 0).rgb);
        reach = irradiance(posLight, normalLight);
        if (reach > 0.0) reach *= spotFactor(posLight);
        vec3 emission = light.emission;
        if (light.isTextured) emission *= textureLod(radianceTexture, vec2(0.5), 99.0).rgb;  // its mean
        vec4 visibility = texelFetch(visibilityTexture, pixel, 0);
        vec3 seen = light.isVisibilityColored ? visibility.rgb : visibility.rrr;
        vec3 reflected = albedo.rgb / pi * emission * reach;
        vec3 shadowed = reflected * seen;
        // Emission is in photometric units, of which a colour's luminance is the Rec. 709 weighted sum.
        float lux = dot(emission * seen, vec3(0.2126, 0.7152, 0.0722)) * reach;
        imageStore(illuminanceImage, pixel, imageLoad(illuminanceImage, pixel) + lux);
        imageStore(radianceImage, pixel, imageLoad(radianceImage, pixel) + vec4(shadowed, 0.0));
        imageStore(unshadowedImage, pixel, imageLoad(unshadowedImage, pixel) + vec4(reflected, 0.0));
    }
    imageStore(reachImage, pixel, vec4(reach));
}
