// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 5, as their code has it (figure 11): comparisons with the shadow map and with the
// smoothies' depth, and alpha, each filtered over the four nearest texels; any blocker among these is umbra. Variants:
// COLORED, for textured lights.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"
#include "src/techniques/smoothies/light_profile.glsl"

uniform sampler2DArray storedAlpha;  // and depth
uniform writeonly image2D visibility;

Seen visibilityAt(Receiver receiver) {
    if (horizonOf(receiver).height <= -1.0) return Seen(0.0);
    Lookup l;
    if (!findCamera(receiver, l)) return Seen(1.0);
    int size_px = textureSize(depthMaps, 0).x;
    vec2 place_px = l.point.uv * float(size_px) - 0.5;
    ivec2 base = ivec2(floor(place_px));
    vec2 f = place_px - vec2(base);
    float alpha = 0.0;
    bool isUnderSmoothie = false;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(base + offset, ivec2(0), ivec2(size_px - 1));
        if (isBehindBlocker(l, texel, 64.0 * l.point.texel_m, 0.0)) return Seen(0.0);
        vec2 weights = mix(1.0 - f, f, vec2(offset));
        vec2 stored = texelFetch(storedAlpha, ivec3(texel, l.camera), 0).rg;
        alpha += weights.x * weights.y * stored.x;
        isUnderSmoothie = isUnderSmoothie || l.point.posFace.z - l.tolerance_m > stored.y;
    }
    if (!isUnderSmoothie) return Seen(1.0);
    // No texel knows how the edge runs: the light's own falloff is the one across the window.
    LightExtent extent = lightExtent(l.camera, placeOf(l.camera, l.point.uv), vec2(1.0, 0.0));
    return falloff(l.camera, extent, 2.0 * alpha - 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    Seen seen = Seen(1.0);
    if (loadReceiver(pixel, receiver)) seen = visibilityAt(receiver);
#ifdef COLORED
    imageStore(visibility, pixel, vec4(seen, 1.0));
#else
    imageStore(visibility, pixel, vec4(seen));
#endif
}
