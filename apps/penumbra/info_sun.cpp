// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/info_sun.h"

#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "studio/json_text.h"

namespace penumbra::studio {

void printSun(const SunOption& sun, bool json) {
    requireRisen(sun.place, sun.setting, "--sun");
    const SunPosition position = sunPosition(sun.place);
    if (json) {
        const nlohmann::ordered_json report = {{"azimuth_deg", position.azimuth_deg},
                                               {"altitude_deg", position.altitude_deg},
                                               {"refracted_altitude_deg", position.refracted_altitude_deg},
                                               {"diameter_deg", position.diameter_deg},
                                               {"lux", position.illuminance_lux}};
        std::cout << jsonText(report);
        return;
    }
    fmt::print("azimuth     {:.3f} degrees from north, clockwise\n", position.azimuth_deg);
    fmt::print("altitude    {:.3f} degrees; {:.3f} as air bends its light\n", position.altitude_deg,
               position.refracted_altitude_deg);
    fmt::print("diameter    {:.4f} degrees\n", position.diameter_deg);
    fmt::print("light       {:.0f} lux on a surface that faces it, under a clear sky\n",
               position.illuminance_lux);
}

}  // namespace penumbra::studio
