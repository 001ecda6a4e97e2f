// SPDX-License-Identifier: Apache-2.0
#version 450
// From nits to a display: exposure, a dim even fill so that umbrae keep their shape, highlights compressed, sRGB.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D radianceTexture;
uniform sampler2D albedoTexture;
uniform sampler2D depthTexture;
uniform sampler2D nearnessTexture;  // of lights that are seen themselves; 0: none is
layout(std430) readonly buffer Exposure { float exposure; };
layout(rgba8) uniform writeonly image2D displayImage;

const vec3 background = vec3(0.02, 0.022, 0.027);  // display-linear
const float fill = 0.06;                          // of what a white surface would show at the mean

// Khronos PBR Neutral (2024): colours below the shoulder stay as they are, brighter ones tend to white.
vec3 compress(vec3 color) {
    const float shoulder = 0.8 - 0.04;
    float low = min(color.r, min(color.g, color.b));
    color -= low < 0.08 ? low - 6.25 * low * low : 0.04;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < shoulder) return color;
    const float room = 1.0 - shoulder;
    float newPeak = 1.0 - room * room / (peak + room - shoulder);
    float whiten = 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0);
    return mix(color * newPeak / peak, vec3(newPeak), whiten);
}

vec3 encodeSrgb(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(displayImage)))) return;
    vec4 radiance = texelFetch(radianceTexture, pixel, 0);
    vec4 albedo = texelFetch(albedoTexture, pixel, 0);
    vec3 color = background;
    if (texelFetch(nearnessTexture, pixel, 0).r > 0.0) {
        color = compress(radiance.rgb * exposure);
    } else if (texelFetch(depthTexture, pixel, 0).r > 0.0) {
        color = albedo.a > 0.5 ? compress(radiance.rgb * exposure + fill * albedo.rgb) : albedo.rgb;
    }
    imageStore(displayImage, pixel, vec4(encodeSrgb(clamp(color, 0.0, 1.0)), 1.0));
}
