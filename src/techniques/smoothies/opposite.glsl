// SPDX-License-Identifier: Apache-2.0
// A thin blocker lets light past both of its sides. Includer defines INNER_UNIT and includes smoothies.glsl.
layout(binding = INNER_UNIT) uniform sampler2DArray innerSmoothies;

// What comes to `place` past the edge on the far side of the blocker from the edge towards which `outward` points. It is
// looked for within the blocker, from `start` and as far as the penumbra reaches; the smallest step comes first, for
// blockers that are thin.
float oppositeVisibility(int camera, vec2 place, vec2 start, vec2 outward, float width, float receiver) {
    int size_px = textureSize(innerSmoothies, 0).x;
    const float steps[5] = {0.05, 0.12, 0.3, 0.6, 1.0};
    for (int i = 0; i < 5; ++i) {
        ivec2 texel = texelOf(camera, start - outward * (steps[i] * width), size_px);
        vec4 closest = texelFetch(innerSmoothies, ivec3(texel, camera), 0);
        float distance_ = length(closest.xy);
        if (closest.w == 0.0 || receiver >= closest.z || dot(closest.xy, outward) > -0.5 * distance_) continue;
        vec2 normal = closest.xy / max(distance_, 1e-30);
        LightExtent extent = lightExtent(camera, place, normal);
        float x = dot(placeOfTexel(camera, texel, size_px) + closest.xy - place, normal) /
                  smoothieWidth(camera, extent.half_m, closest.z, receiver);
        return falloff(camera, -max(x, 0.0), extent.spread);
    }
    return 0.0;
}
