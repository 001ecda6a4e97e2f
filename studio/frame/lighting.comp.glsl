// SPDX-License-Identifier: Apache-2.0
#version 450
// One light: unshadowed irradiance times visibility times albedo, added to what other lights have left.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/frame/lighting_io.h"

layout(std140) uniform Constants { LightingConstants light; };
layout(std430) readonly buffer Profile { float profileValues[]; };

#include "studio/frame/irradiance.glsl"

uniform sampler2D depthTexture;
uniform sampler2D shadingNormals;
uniform sampler2D albedoTexture;
uniform sampler2D visibilityTexture;
uniform sampler2D radianceTexture;
layout(rgba32f) uniform image2D radianceImage;           // with shadows
layout(rgba32f) uniform image2D unshadowedImage;         // without
layout(r32f) uniform writeonly image2D reachImage;       // this light's unshadowed irradiance
layout(r32f) uniform image2D illuminanceImage;           // lux, with shadows

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
        vec3 emission = light.emission;
        if (light.isTextured) emission *= textureLod(radianceTexture, vec2(0.5), 99.0).rgb;  // its mean
        vec4 visibility = texelFetch(visibilityTexture, pixel, 0);
        vec3 seen = light.isVisibilityColored ? visibility.rgb : visibility.rrr;
        vec3 reflected = albedo.rgb / pi * emission * reach;
        vec3 shadowed = reflected * seen;
        // Emission is in photometric units, of which a colour's luminance is the Rec. 709 weighted sum.
        float lux = dot(emission * seen, luminanceOfRec709) * reach;
        imageStore(illuminanceImage, pixel, imageLoad(illuminanceImage, pixel) + lux);
        imageStore(radianceImage, pixel, imageLoad(radianceImage, pixel) + vec4(shadowed, 0.0));
        imageStore(unshadowedImage, pixel, imageLoad(unshadowedImage, pixel) + vec4(reflected, 0.0));
    }
    imageStore(reachImage, pixel, vec4(reach));
}
