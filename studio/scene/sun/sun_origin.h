// SPDX-License-Identifier: Apache-2.0
// What makes a light the sun of a place and a time.
#pragma once

#include <glm/glm.hpp>
#include <string>

namespace penumbra::studio {

/// How a scene lies, and what of the air counts.
struct SunSetting {
    /// Clockwise, seen from above, from the scene's -Z to north.
    double north_deg = 0;
    bool refraction = true;
    bool operator==(const SunSetting&) const = default;
};

/// As a file of lights states it.
struct SunOrigin {
    double latitude_deg = 0, longitude_deg = 0;
    std::string time;  ///< ISO 8601 with a zone
    SunSetting setting;
    glm::vec3 multiplier{1};  ///< of its illuminance
};

}  // namespace penumbra::studio
