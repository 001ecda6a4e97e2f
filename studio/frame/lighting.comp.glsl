// SPDX-License-Identifier: Apache-2.0
#version 450
// One light: unshadowed irradiance times visibility times albedo, added to what other lights have left.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/frame/lighting_io.h"
#include "studio/frame/unshadowed.glsl"

layout(std140, binding = 0) uniform LightingBlock { LightingConstants light; };
layout(binding = 0) uniform sampler2D depthTexture;
layout(binding = 1) uniform sampler2D shadingNormals;
layout(binding = 2) uniform sampler2D albedoTexture;
layout(binding = 3) uniform sampler2D visibilityTexture;
layout(binding = 4) uniform sampler2D radianceTexture;
layout(binding = 0, rgba32f) uniform image2D radianceImage;      // with shadows
layout(binding = 1, rgba32f) uniform image2D unshadowedImage;  // without
layout(binding = 2, r32f) uniform writeonly image2D reachImage;  // this light's unshadowed irradiance
layout(binding = 3, r32f) uniform image2D illuminanceImage;      // lux, with shadows

// Irradiance of a light of size zero whose emission is 1 candela or 1 lux.
float pointIrradiance(vec3 pos, vec3 normal) {
    vec3 towards = light.kind.x == shapeDistant ? vec3(0.0, 0.0, 1.0) : -pos;
    float distance2 = light.kind.x == shapeDistant ? 1.0 : dot(towards, towards);
    return distance2 > 0.0 ? max(0.0, dot(normal, normalize(towards))) / distance2 : 0.0;
}

float irradiance(vec3 pos, vec3 normal) {
    int shape = light.kind.x;
    bool behind = pos.z >= 0.0;
    if ((shape == shapeRect || shape == shapeDisk) && behind && light.kind.y == 0) return 0.0;
    if (light.kind.z == 1) return pointIrradiance(pos, normal);
    if (shape == shapeRect) return rectIrradiance(pos, normal, light.size.xy);
    if (shape == shapeDisk) return diskIrradiance(pos, normal, light.size.z);
    if (shape == shapeSphere) {
        float distance = length(pos);
        return distance > 0.0 ? coneIrradiance(-pos / distance, normal, min(1.0, light.size.z / distance)) : 0.0;
    }
    return coneIrradiance(vec3(0.0, 0.0, 1.0), normal, sin(light.size.w));
}

// The falloff of KHR_lights_punctual, between the inner and the outer cone.
float spotFactor(vec3 pos) {
    if (light.cone.y < -1.5) return 1.0;
    float cosine = dot(normalize(pos), vec3(0.0, 0.0, -1.0));
    float factor = clamp((cosine - light.cone.y) / max(1e-4, light.cone.x - light.cone.y), 0.0, 1.0);
    return factor * factor;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light.target.xy))) return;
    float reach = 0.0;

    float depth = texelFetch(depthTexture, pixel, 0).r;
    vec4 albedo = texelFetch(albedoTexture, pixel, 0);
    if (depth > 0.0 && albedo.a > 0.5) {
        vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(light.target.xy) - 1.0;
        vec4 pos = light.lightFromClip * vec4(ndc, depth, 1.0);
        vec3 posLight = pos.xyz / pos.w;
        vec3 normalLight = normalize(mat3(light.lightFromWorld) * texelFetch(shadingNormals, pixel, 0).rgb);
        reach = irradiance(posLight, normalLight);
        if (reach > 0.0) reach *= spotFactor(posLight);
        vec3 emission = light.emission.rgb;
        if (light.kind.w == 1) emission *= textureLod(radianceTexture, vec2(0.5), 99.0).rgb;  // its mean
        vec4 visibility = texelFetch(visibilityTexture, pixel, 0);
        vec3 seen = light.target.z == 1 ? visibility.rgb : visibility.rrr;
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
