// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/light_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra::studio {
namespace {

constexpr double pi = std::numbers::pi;

TEST(LightUnits, OneCandelaOnASphereOfOneMetre) {
    EXPECT_NEAR(radianceFromIntensity_nits(1, 1), 0.31830989, 1e-7);
    EXPECT_NEAR(radianceFromIntensity_nits(100, 0.05f), 12732.395, 0.01);
}

TEST(LightUnits, AHemisphereOfSkyLightsWithPiTimesItsLuminance) {
    EXPECT_NEAR(radianceFromIlluminance_nits(float(pi), float(pi)), 1, 1e-6);
}

TEST(LightUnits, TheSun) {
    // 0.53 degrees across, 100 klx: about 1.5 giganits.
    EXPECT_NEAR(radianceFromIlluminance_nits(1e5f, float(0.53 * pi / 180)) / 1.4880e9, 1, 1e-4);
}

// An isotropic point of I candela emits 4 pi I lumen; a sphere of luminance L emits pi L from each m^2: 4
// pi^2 r^2 L.
TEST(LightUnits, ASphereEmitsTheFluxOfItsPoint) {
    const double intensity_cd = 25, radius_m = 0.3;
    const double radiance_nits = radianceFromIntensity_nits(float(intensity_cd), float(radius_m));
    EXPECT_NEAR(4 * pi * pi * radius_m * radius_m * radiance_nits, 4 * pi * intensity_cd, 1e-4);
}

// A flat one-sided light of luminance L and area A emits pi L A. Integrating the illuminance that a small
// disk gives over the hemisphere of radius R around it must give back the same: E(t) = L A cos t / R^2.
TEST(LightUnits, AFlatLightEmitsPiTimesLuminanceTimesArea) {
    const double radius_m = 0.1, distance_m = 20, illuminance_lux = 3;
    // Seen face on from afar, the disk is a distant light of angle 2 atan(r/d).
    const double radiance_nits =
        radianceFromIlluminance_nits(float(illuminance_lux), float(2 * std::atan(radius_m / distance_m)));
    const double area_m2 = pi * radius_m * radius_m;
    double flux_lm = 0;
    const int steps = 2000;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps * pi / 2;
        flux_lm +=
            illuminance_lux * std::cos(t) * 2 * pi * std::sin(t) * distance_m * distance_m * (pi / 2 / steps);
    }
    EXPECT_NEAR(flux_lm / (pi * radiance_nits * area_m2), 1, 1e-4);
}

}  // namespace
}  // namespace penumbra::studio
