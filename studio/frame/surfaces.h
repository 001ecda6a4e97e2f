// SPDX-License-Identifier: Apache-2.0
// What the pixels of a view's picture show, on the CPU. Rows from the top; reading waits for the device.
#pragma once

#include "penumbra/view.h"
#include "studio/image/image.h"

namespace penumbra::studio {

/// The depths as they are stored.
Image readDepth(const View& view);

/// A stored depth as clip-space z.
double clipZ(const DepthConvention& convention, float stored);

/// What is stored where there is no surface.
inline float backgroundOf(const DepthConvention& convention) {
    return convention.reversed ? 0.0f : 1.0f;
}

struct Surfaces {
    Image depth_m;  ///< from the camera, along the direction in which it looks; infinite without a surface
    Image normals;  ///< world space, unit, of the triangle, on the side that is seen; 0 without a surface
};

/// Of a view that has normals.
Surfaces readSurfaces(const View& view);

}  // namespace penumbra::studio
