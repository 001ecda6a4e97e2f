// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 5: one or two depth comparisons at each of the four nearest texels, bilinearly
// interpolated.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#define DEPTH_MAP_UNIT 3
#define DEPTH_MAP_BLOCK 0
#define SMOOTHIE_BLOCK 1
#include "src/techniques/smoothies/smoothies.glsl"

layout(binding = 4) uniform sampler2DArray outerSmoothies;
layout(binding = 5) uniform sampler2DArray innerSmoothies;
layout(binding = 0) uniform writeonly image2D visibility;
layout(location = 0) uniform int mapCount;
layout(location = 1) uniform bool isDistant;
layout(location = 2) uniform bool isOneSided;
layout(location = 3) uniform bool hasSmoothies;  // without: a hard shadow

// A surface that bends within a texel rises over its plane by a texel's size times the slopes that meet; one texel
// covers a right angle lit at 45 degrees.
const float toleranceTexels = 1.0;
const float tolerancePrecision = 4e-6;  // some 32 ulps: a 32-bit depth buffer and three transforms

bool isFacing(Receiver receiver) {
    vec3 towardsLight = isDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight;
    return dot(receiver.normalLight, towardsLight) > 0.0 && (!isOneSided || receiver.posLight.z < 0.0);
}

struct Lookup {
    int camera;
    MapPoint point;
    vec3 normalFace;
    float tolerance_m;
};

// The receiver's own plane, where a texel's centre sees it: compared with that, no plane shadows itself.
float receiverDepth_m(Lookup l, vec2 uv) {
    return receiverPlaneDepth_m(l.camera, l.point, l.normalFace, uv, 64.0 * l.point.texel_m);
}

bool isBehindBlocker(Lookup l, ivec2 texel, float receiver_m) {
    float stored = texelFetch(depthMaps, ivec3(texel, l.camera), 0).r;
    return receiver_m - l.tolerance_m > depthFace_m(l.camera, stored);
}

// What comes past the closest edge to a receiver that the light's centre does not see.
float innerVisibility(Lookup l, ivec2 texel, float receiver_m, int size_px) {
    vec4 closest = texelFetch(innerSmoothies, ivec3(texel, l.camera), 0);
    if (closest.w == 0.0 || !(receiver_m > 0.0 || isOrthographic(l.camera))) return 0.0;
    float receiver = nearnessOf(l.camera, receiver_m);
    if (receiver >= closest.z) return 0.0;
    float distance_px = length(closest.xy);
    vec2 outward = closest.xy / max(distance_px, 1e-6);
    LightExtent extent = lightExtent(l.camera, placeOf(l.camera, (vec2(texel) + 0.5) / float(size_px)), outward);
    float width = smoothieWidth(l.camera, extent.half_m, closest.z, receiver);
    float x = distance_px * lightCameras[l.camera].depth.w / width;
    if (x >= 1.0) return 0.0;
    // The receiver's plane must be lit just beyond the edge, or else something under the blocker covers it too.
    vec2 beyond_px = vec2(texel) + 0.5 + closest.xy + 1.5 * outward;
    ivec2 beyond = clamp(ivec2(floor(beyond_px)), ivec2(0), ivec2(size_px - 1));
    float far_m = 2.0 * (distance_px + 2.0) * l.point.texel_m;
    float beyond_m = receiverPlaneDepth_m(l.camera, l.point, l.normalFace, (vec2(beyond) + 0.5) / float(size_px), far_m);
    if (isBehindBlocker(l, beyond, beyond_m)) return 0.0;
    return falloff(l.camera, -x, extent.spread);
}

float texelVisibility(Lookup l, ivec2 texel, int size_px) {
    float receiver_m = receiverDepth_m(l, (vec2(texel) + 0.5) / float(size_px));
    if (isBehindBlocker(l, texel, receiver_m)) {
        return hasSmoothies && smoothies[l.camera].settings.w == 1
                   ? innerVisibility(l, texel, receiver_m, size_px) : 0.0;
    }
    if (!hasSmoothies) return 1.0;
    vec2 smoothie = texelFetch(outerSmoothies, ivec3(texel, l.camera), 0).rg;
    return receiver_m - l.tolerance_m > smoothie.x ? smoothie.y : 1.0;
}

float visibilityAt(Receiver receiver) {
    int size_px = textureSize(depthMaps, 0).x;
    for (int camera = 0; camera < mapCount; ++camera) {
        Lookup l;
        l.camera = camera;
        l.point = mapPoint(camera, receiver.posLight);
        if (!isInWindow(camera, l.point)) continue;
        l.normalFace = mat3(lightCameras[camera].faceFromLight) * receiver.normalLight;
        l.tolerance_m = toleranceTexels * l.point.texel_m + tolerancePrecision * length(l.point.posFace);
        vec2 place_px = l.point.uv * float(size_px);
        if (!hasSmoothies) return texelVisibility(l, ivec2(place_px), size_px);
        ivec2 base = ivec2(floor(place_px - 0.5));
        vec2 f = place_px - 0.5 - vec2(base);
        ivec2 limit = ivec2(size_px - 1);
        vec4 v;
        for (int i = 0; i < 4; ++i) {
            v[i] = texelVisibility(l, clamp(base + ivec2(i & 1, i >> 1), ivec2(0), limit), size_px);
        }
        return mix(mix(v[0], v[1], f.x), mix(v[2], v[3], f.x), f.y);
    }
    return 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    float seen = 1.0;
    if (loadReceiver(pixel, receiver)) seen = isFacing(receiver) ? visibilityAt(receiver) : 0.0;
    imageStore(visibility, pixel, vec4(seen));
}
