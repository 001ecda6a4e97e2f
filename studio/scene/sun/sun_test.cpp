// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/sun/sun.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "studio/errors.h"
#include "studio/scene/sun/sun_clock.h"

namespace penumbra::studio {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// Of the positions, and of the three decimals in which the right values are stated.
constexpr double tolerance_deg = 0.003;

struct Known {
    const char* place;
    double azimuth_deg, altitude_deg, refracted_deg;
};

// Places and years far apart, and near the horizon, the zenith and the pole.
const Known known[] = {
    {"51.4779,0,2026-06-21T12:00Z", 179.113, 61.957, 61.966},
    {"27.7172,85.3240,2024-11-05T16:45+05:45", 248.625, 5.806, 5.949},
    {"-33.8688,151.2093,2026-12-21T13:00+11:00", 351.220, 79.455, 79.458},
    {"-0.1807,-78.4678,2026-03-20T12:10-05:00", 85.521, 87.180, 87.181},
    {"90,0,2026-09-22T12:00Z", 181.819, 0.194, 0.649},
    {"52.52,13.405,1955-05-08T18:40+01:00", 287.669, 7.946, 8.057},
};

TEST(Sun, StandsWhereItStands) {
    for (const Known& k : known) {
        const SunPosition position = sunPosition(parseSunPlace(k.place, "--sun"));
        EXPECT_NEAR(position.azimuth_deg, k.azimuth_deg, tolerance_deg) << k.place;
        EXPECT_NEAR(position.altitude_deg, k.altitude_deg, tolerance_deg) << k.place;
        EXPECT_NEAR(position.refracted_altitude_deg, k.refracted_deg, tolerance_deg) << k.place;
    }
}

TEST(Sun, IsLargerInJanuary) {
    const auto diameter = [](const char* time) {
        return sunPosition({45, 0, parseSunTime(time, "--sun")}).diameter_deg;
    };
    EXPECT_NEAR(diameter("2026-01-03T12:00Z"), 0.542, 0.0005);
    EXPECT_NEAR(diameter("2026-07-06T12:00Z"), 0.524, 0.0005);
}

TEST(Sun, LightsLessThroughMoreAir) {
    const SunPosition high = sunPosition(parseSunPlace(known[3].place, "--sun"));
    EXPECT_NEAR(high.illuminance_lux, 127500 * std::exp(-0.21), 0.02 * high.illuminance_lux);
    const SunPosition low = sunPosition(parseSunPlace(known[4].place, "--sun"));
    EXPECT_LT(low.illuminance_lux, 1000);
    EXPECT_GT(low.illuminance_lux, 0);
    EXPECT_EQ(sunPosition(parseSunPlace("52,13,2026-01-01T00:00Z", "--sun")).illuminance_lux, 0);
}

TEST(Sun, TheSameMomentInAnyZone) {
    const double utc = parseSunTime("2024-11-05T11:00Z", "--sun");
    for (const char* time : {"2024-11-05T16:45+05:45", "2024-11-05T16:45:00.000+0545", "2024-11-05t06:00-05",
                             "2024-11-06T00:30+13:30", "2024-11-05 11:00:00z"})
        EXPECT_NEAR(parseSunTime(time, "--sun"), utc, 1e-9) << time;
    EXPECT_NEAR(parseSunTime("2000-01-01T12:00Z", "--sun"), 51544.5, 1e-9);
    EXPECT_NEAR(parseSunTime("1955-05-08T00:00:30.5Z", "--sun") - parseSunTime("1955-05-08T00:00Z", "--sun"),
                30.5 / 86400, 1e-9);
}

std::string errorOf(const char* place) {
    try {
        sunLight("sun", parseSunPlace(place, "--sun"), {}, "--sun");
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(Sun, WhatIsNoPlaceOrTimeIsTurnedDown) {
    EXPECT_EQ(errorOf("51,0,2026-06-21T12:00Z"), "accepted");
    EXPECT_EQ(errorOf("91,0,2026-06-21T12:00Z"),
              "--sun: a latitude lies between -90 and 90 degrees, not at 91");
    EXPECT_NE(errorOf("-90.1,0,2026-06-21T12:00Z").find("latitude"), std::string::npos);
    EXPECT_NE(errorOf("51,181,2026-06-21T12:00Z").find("longitude"), std::string::npos);
    EXPECT_NE(errorOf("51,0,2026-06-21T12:00").find("has no zone"), std::string::npos);
    EXPECT_NE(errorOf("51,0,2026-06-21T00:00Z").find("below the horizon"), std::string::npos);
    for (const char* place : {"",
                              "51",
                              "51,0",
                              "51,0,",
                              "nan,0,2026-06-21T12:00Z",
                              "51,inf,2026-06-21T12:00Z",
                              "51,0,noon",
                              "51,0,2026-06-21",
                              "51,0,2026-06-21T12Z",
                              "51,0,2026-02-29T12:00Z",
                              "51,0,2026-13-01T12:00Z",
                              "51,0,2026-06-21T24:00Z",
                              "51,0,2026-06-21T12:60Z",
                              "51,0,2026-06-21T12:00:75Z",
                              "51,0,2026-06-21T12:00+1",
                              "51,0,2026-06-21T12:00+01:",
                              "51,0,2026-06-21T12:00+99:00",
                              "51,0,2026-06-21T12:00Zulu",
                              "51,0,1850-06-21T12:00Z",
                              "51,0,2150-06-21T12:00Z",
                              "51;0;2026-06-21T12:00Z"}) {
        const std::string message = errorOf(place);
        EXPECT_TRUE(message.starts_with("--sun: ")) << place << ": " << message;
    }
}

TEST(Sun, ShinesFromThereIntoTheScene) {
    const auto towards = [](const SunSetting& setting) {
        const Light light = sunLight("sun", parseSunPlace(known[1].place, "--sun"), setting, "--sun");
        const auto& z = light.shape.worldFromLight.columns[2];
        return glm::dvec3(z[0], z[1], z[2]);
    };
    const double azimuth = known[1].azimuth_deg * radians, altitude = known[1].altitude_deg * radians;
    const double refracted = known[1].refracted_deg * radians;
    // -Z is north, +X east.
    const auto direction = [&](double heading, double up) {
        return glm::dvec3(std::cos(up) * std::sin(heading), std::sin(up), -std::cos(up) * std::cos(heading));
    };
    const double tolerance = tolerance_deg * radians;
    EXPECT_LT(glm::distance(towards({}), direction(azimuth, refracted)), 2 * tolerance);
    EXPECT_LT(glm::distance(towards({.refraction = false}), direction(azimuth, altitude)), 2 * tolerance);
    EXPECT_LT(glm::distance(towards({.north_deg = 90}), direction(azimuth + 90 * radians, refracted)),
              2 * tolerance);

    const Light light = sunLight("sun", parseSunPlace(known[0].place, "--sun"), {}, "--sun");
    const glm::mat4 frame = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    EXPECT_NEAR(glm::determinant(frame), 1, 1e-6);
    const double sine = std::sin(0.5 * light.shape.angle_rad);
    EXPECT_NEAR(light.emission.value.x * std::numbers::pi * sine * sine,
                sunPosition(parseSunPlace(known[0].place, "--sun")).illuminance_lux, 10);
}

TEST(Sun, ClocksAreReadAndWritten) {
    for (const char* text : {"2026-06-21T13:00+01:00", "1955-05-08T18:40:31Z", "2024-02-29T00:00-03:30",
                             "2100-12-31T23:59:59+14:00"}) {
        const SunClock clock = parseSunClock(text, "t");
        EXPECT_EQ(textOf(clock), text);
        EXPECT_EQ(utcDaysOf(clock), parseSunTime(text, "t"));
        EXPECT_NEAR(utcDaysOf(clockOf(utcDaysOf(clock))), utcDaysOf(clock), 1e-9) << text;
    }
    SunClock clock = parseSunClock("2024-02-29T12:00Z", "t");
    EXPECT_EQ(dayOfYear(clock), 60);
    clock.year = 2023;  // which has no such day
    setDayOfYear(clock, dayOfYear(clock));
    EXPECT_EQ(textOf(clock), "2023-03-01T12:00Z");
    setDayOfYear(clock, 366);
    EXPECT_EQ(textOf(clock), "2023-12-31T12:00Z");
    setDayOfYear(clock, 1);
    EXPECT_EQ(textOf(clock), "2023-01-01T12:00Z");
}

TEST(Sun, KnowsWhatItIs) {
    const Light light = sunLight("sun", parseSunPlace("52.52,13.405,2026-06-21T13:00+02:00", "--sun"),
                                 {.north_deg = 20}, "--sun");
    ASSERT_TRUE(light.sun);
    EXPECT_EQ(light.sun->time, "2026-06-21T11:00Z");
    EXPECT_EQ(light.sun->setting.north_deg, 20);
    const Light again = sunLight("sun", *light.sun, "again");
    EXPECT_EQ(again.shape.worldFromLight, light.shape.worldFromLight);
    EXPECT_EQ(again.emission.value, light.emission.value);
}

}  // namespace
}  // namespace penumbra::studio
