// SPDX-License-Identifier: Apache-2.0
// What hands do to a light: pure changes of one.
#pragma once

#include "studio/scene/scene.h"

namespace penumbra::studio::viewer {

/// A square that shines at `posWorld`, where a surface has that normal, from so far before it; it gives 500
/// lux.
Light newLight(const glm::vec3& posWorld, const glm::vec3& normalWorld, float distance_m);

/// Another shape of the same brightness and about the same size at the same place. A texture stays with
/// rects.
void changeShape(Light& light, LightShape shape);

/// Where the light of a lamp's middle comes from: azimuth clockwise, seen from above, from the world's -Z;
/// altitude above the horizon, 90 of a lamp that shines down.
struct Bearing {
    float azimuth_deg = 0, altitude_deg = 0;
};
Bearing bearingOf(const Light& light);
void setBearing(Light& light, const Bearing& bearing);

/// Turns the light so that it shines at the point, where that is not its own place. A distant light has its
/// place at the origin.
void aimAt(Light& light, const glm::vec3& target);

}  // namespace penumbra::studio::viewer
