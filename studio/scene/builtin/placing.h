// SPDX-License-Identifier: Apache-2.0
// Where to put lights and cameras, and how strong a light must be. Used by the built-in scenes and by the
// defaults of scenes that come without.
#pragma once

#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// The rigid transform of something at `eye` that looks (or shines) along its -Z at `target`, with +Y as near
/// to world up (+Y) as can be; looking straight down or up, +Y is world -Z. `target` must differ from `eye`.
glm::mat4 worldFromLookAt(const glm::vec3& eye, const glm::vec3& target);

/// An area light at `eye` that shines at `target` and gives a surface there that faces it about
/// `illuminance_lux`, tinted by `color`. Sizes must be positive. (The rectangle's falls short a little where
/// it is near: E = L A / d^2.)
Light rectLight(std::string name, float width_m, float height_m, const glm::vec3& eye,
                const glm::vec3& target, float illuminance_lux, const glm::vec3& color = glm::vec3(1));
Light diskLight(std::string name, float radius_m, const glm::vec3& eye, const glm::vec3& target,
                float illuminance_lux, const glm::vec3& color = glm::vec3(1));
Light sphereLight(std::string name, float radius_m, const glm::vec3& center, const glm::vec3& target,
                  float illuminance_lux, const glm::vec3& color = glm::vec3(1));
/// A tube that lies level and across the way to `target`.
Light tubeLight(std::string name, float length_m, float radius_m, const glm::vec3& center,
                const glm::vec3& target, float illuminance_lux, const glm::vec3& color = glm::vec3(1));
Light distantLight(std::string name, float angle_rad, const glm::vec3& direction, float illuminance_lux,
                   const glm::vec3& color = glm::vec3(1));

/// A perspective camera at `eye` looking at `target`.
Camera camera(std::string name, const glm::vec3& eye, const glm::vec3& target, float yfov_rad = 0.7f);

/// A camera that sees all of `bounds` from the front, the right and above, in a picture of any shape from
/// square to wide. Empty bounds count as a ball of one metre around the origin.
Camera framingCamera(std::string name, const Bounds& bounds);

/// A square key light above and to the left of `bounds`, outside of them, a quarter as wide as it is far from
/// their centre.
Light keyLight(std::string name, const Bounds& bounds, float illuminance_lux = 1000);

}  // namespace penumbra::studio
