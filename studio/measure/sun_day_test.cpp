// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/sun_day.h"

#include <gtest/gtest.h>

#include <numeric>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr const char* berlin = "52.52,13.405,2026-03-20T12:00+01:00";

std::string messageFor(const std::string& over, const std::string& place) {
    try {
        sunDay(over, place, {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(SunDay, HasItsFirstAndItsLastTime) {
    const std::vector<SunMoment> day = sunDay("08:00-18:00/15min", berlin, {});
    ASSERT_EQ(day.size(), 41u);
    EXPECT_EQ(day.front().clock, "08:00");
    EXPECT_EQ(day.back().clock, "18:00");
    EXPECT_EQ(sunDay("08:00-18:00", berlin, {}).size(), 41u);
    EXPECT_EQ(sunDay("8:00-18:00/1h", berlin, {}).size(), 11u);
    const std::vector<double> hours = hoursOf(day);
    EXPECT_DOUBLE_EQ(std::accumulate(hours.begin(), hours.end(), 0.0), 10);
    EXPECT_DOUBLE_EQ(hours.front(), 0.125);
}

TEST(SunDay, IsOfThePlaceAndItsZone) {
    // At the equinox it culminates at 90 - 52.52 degrees, 6 hours after it has risen.
    const std::vector<SunMoment> day = sunDay("00:00-23:59/1min", berlin, {});
    const SunMoment* noon = &day.front();
    for (const SunMoment& moment : day) {
        if (moment.position.altitude_deg > noon->position.altitude_deg) noon = &moment;
    }
    EXPECT_NEAR(noon->position.altitude_deg, 90 - 52.52, 0.5);
    EXPECT_NEAR(noon->hour, 12 + 0.25, 0.1);
    EXPECT_FALSE(day.front().light.has_value());
    EXPECT_TRUE(noon->light.has_value());
}

TEST(SunDay, TellsWhatIsWrong) {
    EXPECT_NE(messageFor("8-18", berlin).find("HH:MM"), std::string::npos);
    EXPECT_NE(messageFor("08:00-18:00/0min", berlin).find("step"), std::string::npos);
    EXPECT_NE(messageFor("08:00-18:00/15", berlin).find("HH:MM"), std::string::npos);
    EXPECT_NE(messageFor("18:00-08:00", berlin).find("before it begins"), std::string::npos);
    EXPECT_NE(messageFor("08:60-18:00", berlin).find("HH:MM"), std::string::npos);
    EXPECT_NE(messageFor("08:00-99999999999:00", berlin).find("HH:MM"), std::string::npos);
    EXPECT_NE(messageFor("08:00-18:00", "52.52,13.405,2026-03-20T12:00").find("no zone"), std::string::npos);
    EXPECT_NE(messageFor("00:00-03:00", berlin).find("below the horizon"), std::string::npos);
    // North of the polar circle in December.
    EXPECT_NE(messageFor("08:00-18:00", "78.2,15.6,2026-12-21T12:00+01:00").find("below the horizon"),
              std::string::npos);
}

}  // namespace
}  // namespace penumbra::studio
