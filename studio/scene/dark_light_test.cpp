// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/dark_light.h"

#include <gtest/gtest.h>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"

namespace penumbra::studio {
namespace {

std::string whyDark(Mesh caster, const char* name, const glm::vec3& place, const Light& light) {
    SceneBuilder builder("dark");
    builder.ground(10);
    builder.place("thing", builder.mesh("thing", box({1, 1, 1}), {1, 1, 1}), at({0, 0.5f, 0}));
    builder.place(name, builder.mesh(name, std::move(caster), {1, 1, 1}), at(place));
    const Scene scene = std::move(builder).build();
    return whyDark(scene, scene.at(0), light);
}

TEST(DarkLight, NamesWhatEnclosesIt) {
    const Light bulb = sphereLight("lamp", 0.05f, {0, 3, 0}, {0, 0, 0}, 100);
    EXPECT_EQ(whyDark(sphere(0.06f, 12, 8), "Bulb", {0, 3, 0}, bulb),
              ": 'Bulb' encloses it; \"nodes\": {\"Bulb\": {\"casts\": false}} in the file of lights lets it "
              "through");
    EXPECT_EQ(whyDark(sphere(0.06f, 12, 8), "Bulb", {0, 4, 0}, bulb), "");
}

TEST(DarkLight, NamesWhatStandsBeforeIt) {
    const Light panel = rectLight("panel", 0.5f, 0.5f, {0, 3, 0}, {0, 0, 0}, 100);
    EXPECT_TRUE(
        whyDark(plane(0.4f, 0.4f), "Slab", {0, 2.9f, 0}, panel).starts_with(": 'Slab' stands before"));
    EXPECT_EQ(whyDark(plane(0.4f, 0.4f), "Slab", {0, 3.1f, 0}, panel), "") << "it is behind";
    const Light sun = distantLight("sun", 0.5f, {0, -1, 0}, 100);
    EXPECT_TRUE(whyDark(plane(8, 8), "Roof", {0, 5, 0}, sun).starts_with(": 'Roof' stands before"));
    Light unshadowed = sun;
    unshadowed.castsShadow = false;
    EXPECT_EQ(whyDark(plane(8, 8), "Roof", {0, 5, 0}, unshadowed), "");
}

}  // namespace
}  // namespace penumbra::studio
