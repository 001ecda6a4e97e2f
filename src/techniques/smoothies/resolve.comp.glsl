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
#define INNER_UNIT 5
#include "src/techniques/smoothies/opposite.glsl"
layout(binding = 0) uniform writeonly image2D visibility;
layout(location = 0) uniform int mapCount;
layout(location = 1) uniform bool isDistant;
layout(location = 2) uniform bool isOneSided;
layout(location = 3) uniform bool hasSmoothies;  // without: a hard shadow

// A surface that bends within a texel rises over its plane by a texel's size times the slopes that meet; one texel
// covers a right angle lit at 45 degrees.
const float toleranceTexels = 1.0;
const float tolerancePrecision = 4e-6;  // some 32 ulps: a 32-bit depth buffer and three transforms

// A sliver of a light above the horizon is taken for none: the quotient of two such parts is all noise.
const float leastPart = 0.004;

// The part of the light above the receiver's horizon. A hard shadow knows the centre alone.
float partAboveHorizon(Receiver receiver) {
    if (isOneSided && receiver.posLight.z >= 0.0) return 0.0;
    vec3 normal = receiver.normalLight;
    float elevation = dot(normal, isDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight);
    if (!hasSmoothies) return elevation > 0.0 ? 1.0 : 0.0;
    SmoothieConstants c = smoothies[0];
    float half_m, spread = 0.0;
    if (c.settings.x == shapeDistant) {
        half_m = c.widths.x * sqrt(max(1.0 - elevation * elevation, 0.0));
    } else if (c.settings.x == shapeSphere) {
        half_m = c.widths.x;
    } else {
        vec3 normalFace = mat3(lightCameras[0].faceFromLight) * normal;
        float x = abs(dot(c.halfX.xyz, normalFace)), y = abs(dot(c.halfY.xyz, normalFace));
        half_m = c.settings.x == shapeDisk ? length(vec2(x, y)) : x + y;
        spread = min(x, y) / max(x + y, 1e-30);
    }
    return half_m > 0.0 ? lightVisible(0, elevation / half_m, spread) : float(elevation > 0.0);
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

// What comes past an edge to a receiver that the light's centre does not see: the edge that is closest to `texel`,
// measured from the receiver itself.
float innerVisibility(Lookup l, ivec2 texel, int size_px) {
    vec4 closest = texelFetch(innerSmoothies, ivec3(texel, l.camera), 0);
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    if (closest.w == 0.0 || receiver >= closest.z) return 0.0;
    vec2 place = placeOf(l.camera, l.point.uv);
    vec2 edge = placeOfTexel(l.camera, texel, size_px) + closest.xy;
    vec2 outward = closest.xy / max(length(closest.xy), 1e-30);
    float distance_ = max(dot(edge - place, outward), 0.0);
    LightExtent extent = lightExtent(l.camera, place, outward);
    float width = smoothieWidth(l.camera, extent.half_m, closest.z, receiver);
    if (distance_ >= width) return 0.0;
    // The receiver's plane must be lit just beyond the edge, or else something under the blocker covers it too.
    float windowTexel = lightCameras[l.camera].depth.w;
    ivec2 beyond = texelOf(l.camera, edge + 1.5 * windowTexel * outward, size_px);
    float far_m = 2.0 * (distance_ / windowTexel + 2.0) * l.point.texel_m;
    float beyond_m = receiverPlaneDepth_m(l.camera, l.point, l.normalFace, (vec2(beyond) + 0.5) / float(size_px), far_m);
    if (isBehindBlocker(l, beyond, beyond_m)) return 0.0;
    return min(falloff(l.camera, -distance_ / width, extent.spread) +
                   oppositeVisibility(l.camera, place, place, outward, width, receiver), 1.0);
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
        if (!hasSmoothies) {
            ivec2 texel = ivec2(place_px);
            return isBehindBlocker(l, texel, receiverDepth_m(l, (vec2(texel) + 0.5) / float(size_px))) ? 0.0 : 1.0;
        }
        ivec2 base = ivec2(floor(place_px - 0.5));
        vec2 f = place_px - 0.5 - vec2(base);
        float seen = 0.0, behind = 0.0, most = 0.0;
        ivec2 behindTexel = base;
        for (int i = 0; i < 4; ++i) {
            ivec2 offset = ivec2(i & 1, i >> 1);
            vec2 weights = mix(1.0 - f, f, vec2(offset));
            float weight = weights.x * weights.y;
            ivec2 texel = clamp(base + offset, ivec2(0), ivec2(size_px - 1));
            float receiver_m = receiverDepth_m(l, (vec2(texel) + 0.5) / float(size_px));
            if (isBehindBlocker(l, texel, receiver_m)) {
                behind += weight;
                if (weight > most) behindTexel = texel;
                most = max(most, weight);
            } else {
                vec2 smoothie = texelFetch(outerSmoothies, ivec3(texel, camera), 0).rg;
                seen += weight * (receiver_m - l.tolerance_m > smoothie.x ? smoothie.y : 1.0);
            }
        }
        if (behind > 0.0 && smoothies[camera].settings.w == 1) {
            seen += behind * innerVisibility(l, behindTexel, size_px);
        }
        return seen;
    }
    return 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    float seen = 1.0;
    if (loadReceiver(pixel, receiver)) {
        // Edges tell the part of the whole light that is seen. A surface's own horizon is an edge like others, which is
        // why smoothies darken the terminator; asked for is the part of what is above that horizon.
        float above = partAboveHorizon(receiver);
        seen = above > leastPart ? min(visibilityAt(receiver) / above, 1.0) : 0.0;
    }
    imageStore(visibility, pixel, vec4(seen));
}
