// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/light_units.h"

#include <cmath>
#include <numbers>

namespace penumbra::studio {

float radianceFromIntensity_nits(float intensity_cd, float radius_m) {
    return intensity_cd / (std::numbers::pi_v<float> * radius_m * radius_m);
}

float radianceFromIlluminance_nits(float illuminance_lux, float angle_rad) {
    const float sine = std::sin(0.5f * angle_rad);
    return illuminance_lux / (std::numbers::pi_v<float> * sine * sine);
}

}  // namespace penumbra::studio
