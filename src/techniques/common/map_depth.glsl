// SPDX-License-Identifier: Apache-2.0
// What a depth map stores, and how exactly it can be compared with a receiver.
#ifndef PENUMBRA_MAP_DEPTH
#define PENUMBRA_MAP_DEPTH
#include "src/techniques/common/light_camera_io.h"

// Linear depth along the camera's axis, in metres, from the reversed depth that is stored; no caster is infinitely far.
float storedDepth_m(MapDepth depth, float stored) {
    if (stored == 0.0) return uintBitsToFloat(0x7f800000u);
    return depth.isOrthographic ? depth.far_m - stored * (depth.far_m - depth.near_m) : depth.near_m / stored;
}

// 1 / depth in perspective, -depth in an orthographic map: affine in what is stored, and on any plane in the window.
float storedNearness(MapDepth depth, float stored) {
    return depth.isOrthographic ? stored * (depth.far_m - depth.near_m) - depth.far_m : stored / depth.near_m;
}

// The receiver is compared with the map where its own plane is seen through the texel's centre, so that a flat surface
// compares equal with itself up to rounding, however steeply it is lit. What remains is a surface that bends within a
// texel: it rises over the plane by a texel's size times the slopes that meet; one texel covers a right angle lit at 45
// degrees. The price is that a blocker less than a texel above its receiver, along the light's axis, casts no shadow there.
const float toleranceTexels = 1.0;
const float tolerancePrecision = 4e-6;  // some 32 ulps: positions come out of a 32-bit depth buffer and three transforms

float mapTolerance_m(float texel_m, vec3 posFace) {
    return toleranceTexels * texel_m + tolerancePrecision * length(posFace);
}
#endif
