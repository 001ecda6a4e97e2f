// SPDX-License-Identifier: Apache-2.0
// How wide a penumbra gets between two depths. As footprint.glsl derives, it grows with 1 / z_b - 1 / z_r, and with
// z_r - z_b for distant lights; either is a difference of the two depths' "nearness" (storedNearness).

// No penumbra at all, as a nearness.
const float noPenumbra = -3e38;

// The shear of the footprint lengthens it by no more than a ray is longer than its depth: in this map, by this.
float widestPerExtent(int map) {
    LightCameraConstants camera = lightCameras[map];
    if (camera.depth.isOrthographic) return 1.0;
    vec2 farthest = max(abs(camera.window.min), abs(camera.window.min + 1.0 / camera.window.perExtent));
    return length(vec3(farthest, 1.0));
}

// The nearness below which receivers so many texels from an edge have its penumbra, the light's footprint having at most
// this half extent.
float penumbraBegins(int map, float stored, float width_px, float widest) {
    MapDepth depth = lightCameras[map].depth;
    return widest == 0.0 ? noPenumbra : storedNearness(depth, stored) - max(width_px, 0.0) * depth.texelSize / widest;
}
