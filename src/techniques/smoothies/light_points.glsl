// SPDX-License-Identifier: Apache-2.0
// Points of the light, and whether the depth map hides them from a receiver. Includer includes lookup.glsl.

// A point of the light as seen from a place in the window, from the light's centre, in face space. Points are spread evenly
// over its shape by the R2 sequence (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
vec3 lightPoint(int i, vec2 place) {
    SmoothieConstants c = smoothies[0];
    vec2 u = fract(vec2(0.7548776662, 0.5698402910) * float(i) + 0.5);
    if (c.light.shape == shapeRect) return (2.0 * u.x - 1.0) * c.halfX + (2.0 * u.y - 1.0) * c.halfY;
    vec2 disk = sqrt(u.x) * vec2(cos(6.28318531 * u.y), sin(6.28318531 * u.y));
    if (c.light.shape == shapeDisk) return disk.x * c.halfX + disk.y * c.halfY;
    if (c.light.shape == shapeDistant) return vec3(c.radius * disk, 0.0);
    // The disk that a sphere shows.
    vec3 x = normalize(vec3(1.0, 0.0, -place.x));
    vec3 y = normalize(cross(vec3(place, 1.0), x));
    return c.radius * (disk.x * x + disk.y * y);
}

struct Glance {
    bool isInWindow;  // or else nothing is known
    bool isHidden;
    float nearness;  // of what the map holds there
};

// From the receiver to a point of the light, as far as to blockers of some nearness.
Glance glanceAt(Lookup l, int i, float blocker) {
    vec2 place = placeOf(l.camera, l.point.uv);
    vec3 s = lightPoint(i, place);
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
