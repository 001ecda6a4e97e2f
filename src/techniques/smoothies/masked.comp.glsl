// SPDX-License-Identifier: Apache-2.0
#version 450
// Blockers with holes: their silhouettes are in a texture and not in a mesh, so they get no smoothies. They have a depth
// map of their own, which is filtered over the light's shadow of itself: a search for the blockers' mean nearness, then the
// share of the light that blockers there hide (after Fernando 2005, with the widths of smoothies.glsl). The lesser of this
// visibility and the other blockers' counts, as among smoothies. Variants: COLORED, for textured lights.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"

#ifdef COLORED
layout(binding = 0, rgba16f) uniform image2D visibility;
#else
layout(binding = 0, r32f) uniform image2D visibility;
#endif
layout(location = 3) uniform float nearestNearness;  // of all blockers that have holes

const int taps = 48;

// A point of the light in face space, spread evenly over its shape by the R2 sequence (M. Roberts, The unreasonable
// effectiveness of quasirandom sequences, 2018).
vec3 lightPoint(int i, vec2 place) {
    SmoothieConstants c = smoothies[0];
    vec2 u = fract(vec2(0.7548776662, 0.5698402910) * float(i) + 0.5);
    if (c.settings.x == shapeRect) return (2.0 * u.x - 1.0) * c.halfX.xyz + (2.0 * u.y - 1.0) * c.halfY.xyz;
    vec2 disk = sqrt(u.x) * vec2(cos(6.28318531 * u.y), sin(6.28318531 * u.y));
    if (c.settings.x == shapeDisk) return disk.x * c.halfX.xyz + disk.y * c.halfY.xyz;
    if (c.settings.x == shapeDistant) return vec3(c.widths.x * disk, 0.0);
    // The disk that a sphere shows.
    vec3 x = normalize(vec3(1.0, 0.0, -place.x));
    vec3 y = normalize(cross(vec3(place, 1.0), x));
    return c.widths.x * (disk.x * x + disk.y * y);
}

// Whether a point of the light is hidden, if blockers are at nearness `blocker`; returned is what the map holds there.
float lookPast(Lookup l, int i, float blocker, float receiver, out bool hides) {
    vec2 place = placeOf(l.camera, l.point.uv);
    vec3 s = lightPoint(i, place);
    vec2 uv = uvOf(l.camera, place + (s.xy - s.z * place) * (blocker - receiver));
    hides = false;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0)))) return 0.0;
    ivec2 texel = ivec2(uv * float(textureSize(depthMaps, 0).x));
    hides = isBehindBlocker(l, texel, 1e6 * l.point.texel_m);
    return storedNearness(l.camera, texelFetch(depthMaps, ivec3(texel, l.camera), 0).r);
}

float visibilityAt(Receiver pixel) {
    Lookup l;
    if (!findCamera(pixel, l)) return 1.0;
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    if (receiver >= nearestNearness) return 1.0;
    float sum = 0.0, count = 0.0;
    bool hides;
    for (int i = 0; i < taps; ++i) {
        float blocker = lookPast(l, i, nearestNearness, receiver, hides);
        if (hides) sum += blocker;
        if (hides) count += 1.0;
    }
    if (count == 0.0) return 1.0;
    float mean = max(sum / count, receiver);
    float hidden = 0.0;
    for (int i = 0; i < taps; ++i) {
        lookPast(l, i, mean, receiver, hides);
        if (hides) hidden += 1.0;
    }
    return 1.0 - hidden / float(taps);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    if (!loadReceiver(pixel, receiver)) return;
    imageStore(visibility, pixel, min(imageLoad(visibility, pixel), visibilityAt(receiver)));
}
