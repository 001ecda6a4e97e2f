// SPDX-License-Identifier: Apache-2.0
// Whether the depth map hides points of the light from a receiver. Includer includes lookup.glsl.
#include "src/techniques/common/light_points.glsl"

LightFigure lightFigure(int camera) {
    SmoothieConstants c = smoothies[camera];
    return LightFigure(c.light.shape, c.halfX, c.halfY, c.radius);
}

struct Glance {
    bool isInWindow;  // or else nothing is known
    bool isHidden;
    float nearness;  // of what the map holds there
};

// From the receiver to a point of the light, as far as to blockers of some nearness.
Glance glanceAt(Lookup l, int i, float blocker) {
    vec2 place = placeOf(l.camera, l.point.uv);
    vec3 s = lightPoint(lightFigure(l.camera), i, place);
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    vec2 uv = uvOf(l.camera, place + (s.xy - s.z * place) * (blocker - receiver));
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0)))) return Glance(false, false, 0.0);
    float size_px = float(textureSize(depthMaps, 0).x);
    ivec2 texel = ivec2(uv * size_px);
    float stored = texelFetch(depthMaps, ivec3(texel, l.camera), 0).r;
    float unbounded_m = 1e6 * l.point.texel_m;
    vec2 uvSeen = (vec2(texel) + 0.5) / size_px;
    float plane_m = receiverPlaneDepth_m(l.camera, l.point, l.normalFace, uvSeen, unbounded_m, unbounded_m);
    bool isHidden = plane_m - l.tolerance_m > depthFace_m(l.camera, stored);
    return Glance(true, isHidden, storedNearness(l.camera, stored));
}
