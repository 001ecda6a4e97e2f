// SPDX-License-Identifier: Apache-2.0
// How wide a penumbra gets between two depths. As footprint.glsl derives, it grows with 1 / z_b - 1 / z_r, and with
// z_r - z_b for distant lights; either is a difference of the two depths' "nearness", an affine function of what the
// map stores.
float nearnessOf(vec4 depth, float stored) {
    return depth.z == 1.0 ? stored * (depth.y - depth.x) - depth.y : stored / depth.x;
}

// No penumbra at all, as a nearness.
const float noPenumbra = -3e38;

// The shear of the footprint lengthens it by no more than a ray is longer than its depth: in this map, by this.
float widestPerExtent(int map) {
    LightCameraConstants camera = lightCameras[map];
    if (camera.depth.z == 1.0) return 1.0;
    vec2 farthest = max(abs(camera.window.xy), abs(camera.window.xy + 1.0 / camera.window.zw));
    return length(vec3(farthest, 1.0));
}

// The nearness below which receivers so many texels from an edge have its penumbra, the light's footprint having at most
// this half extent.
float penumbraBegins(int map, float stored, float width_px, float widest) {
    vec4 depth = lightCameras[map].depth;
    return widest == 0.0 ? noPenumbra : nearnessOf(depth, stored) - max(width_px, 0.0) * depth.w / widest;
}
