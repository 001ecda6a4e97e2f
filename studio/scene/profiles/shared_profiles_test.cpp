// SPDX-License-Identifier: Apache-2.0
// Profiles as odd as real ones, each with a JSON file beside it that says what is right.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "studio/scene/profiles/test_profiles.h"

namespace penumbra::studio::testing {
namespace {

namespace fs = std::filesystem;

TEST(SharedProfiles, AreReadRight) {
    const char* named = std::getenv("PENUMBRA_SHARED_SCENES");
    const fs::path folder = fs::path(named ? named : PENUMBRA_DEFAULT_SHARED_SCENES) / "profiles";
    if (!fs::exists(folder)) GTEST_SKIP() << "the shared scenes are not here; set PENUMBRA_SHARED_SCENES";
    int read = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!isProfileName(entry.path())) continue;
        const LightProfile profile = readProfile(entry.path());
        const auto right =
            nlohmann::json::parse(std::ifstream(fs::path(entry.path()).replace_extension(".json")));
        for (const auto& direction : right["candela"]) {
            const auto& xyz = direction["xyz"];
            EXPECT_NEAR(profile.grid.at({xyz[0], xyz[1], xyz[2]}), double(direction["cd"]),
                        2e-4 * profile.grid.largest())  // of values with few digits
                << entry.path() << " " << direction;
        }
        EXPECT_NEAR(profile.grid.largest(), double(right["max_candela"]), 1e-3) << entry.path();
        EXPECT_NEAR(profile.grid.integral(), double(right["flux_lm_of_interpolant"]),
                    1e-5 * profile.grid.integral())
            << entry.path();
        const auto& opening = right["opening"];
        const bool circle = opening["shape"] == "circle";
        EXPECT_EQ(profile.opening.name(), opening["shape"].get<std::string>()) << entry.path();
        const auto along = [&](const char* axis, const char* plane) {
            return double(circle                   ? opening["diameter_m"]
                          : opening.contains(axis) ? opening[axis]
                                                   : opening[plane]);
        };
        EXPECT_NEAR(profile.opening.x_m, along("along_X_m", "along_C0_m"), 1e-9) << entry.path();
        EXPECT_NEAR(profile.opening.y_m, along("along_Y_m", "along_C90_m"), 1e-9) << entry.path();
        ++read;
    }
    EXPECT_GE(read, 4);
}

}  // namespace
}  // namespace penumbra::studio::testing
