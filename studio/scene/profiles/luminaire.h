// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "studio/scene/profiles/light_profile.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Makes `light` the luminaire that the profile is of: its shape, size and candela, `emission` of each. Its
/// place stays. Returns what is not as in the file; empty: nothing.
std::string makeLuminaire(std::shared_ptr<const LightProfile> profile, float turn_rad,
                          const glm::vec3& emission, Light& light);

/// Puts a light of any kind there; a luminaire gives what its file says of its tilt.
void place(Light& light, const glm::mat4& worldFromLight);

/// Where it was put: the place of its shape, unless that is turned within the luminaire
/// (ProfiledEmission::luminaireFromShape).
glm::mat4 worldFromLightOf(const Light& light);

/// Of unit length, in the space of the light's shape: C0 of its profile.
glm::vec3 towardsC0(const ProfiledEmission& profile);

/// The same of the profile's zenith, gamma = 180.
glm::vec3 towardsZenith(const ProfiledEmission& profile);

/// How wide a part of a light may look for its middle to stand for all of it: over it candela change by a
/// fifth of their largest, where they change the most with the vertical angle. 1 to 10 degrees.
double widestPart_rad(const ProfiledEmission& profile);

}  // namespace penumbra::studio
