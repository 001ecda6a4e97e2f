// SPDX-License-Identifier: Apache-2.0
// Panels let into ceilings: what lies in a light's own plane, within rounding, hides nothing of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "studio/frame/conversions.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

constexpr glm::vec3 gray(0.5f);

/// A corner of a room, turned and moved as rooms are: a ceiling with a panel or a disk in it, a wall that
/// reaches up to it, a floor with a box. The ceiling is placed by its own matrix, the light by another that
/// means the same plane.
struct Room {
    std::string description;
    Scene casting, receiving;  ///< whether the ceiling casts
};

Room makeRoom(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
    const auto between = [&](float low, float high) { return low + (high - low) * unit(); };
    const float size_m = std::pow(10.0f, between(-1, 1)), height_m = size_m * between(0.2f, 1);
    const glm::vec3 axis = glm::normalize(glm::vec3(between(-1, 1), between(-1, 1), between(-1, 1.1f)));
    const glm::mat4 room =
        glm::translate(glm::mat4(1), size_m * glm::vec3(between(-2, 2), between(-2, 2), between(-2, 2))) *
        glm::rotate(glm::mat4(1), between(0, 3), axis);
    const auto in = [&](float x, float y, float z) { return glm::vec3(room * glm::vec4(x, y, z, 1)); };
    const float turn_rad = between(0, 3), lamp_m = size_m * between(0.02f, 0.2f);
    const glm::vec2 place = size_m * glm::vec2(between(-0.3f, 0.3f), between(-0.3f, 0.3f));
    const bool isDisk = seed % 2 == 0;
    const int cells = 1 + int(random() % 4);

    const auto build = [&](Role role) {
        SceneBuilder scene("room");
        const auto put = [&](const char* name, Mesh mesh, const glm::mat4& roomFromMesh, Role itsRole) {
            const glm::mat4 worldFromMesh = room * roomFromMesh;
            scene.place(
                name, scene.mesh(name, std::move(mesh), gray), [=](double) { return worldFromMesh; },
                itsRole);
        };
        const glm::mat4 one(1);
        put("ceiling", plane(size_m, size_m, cells, cells), glm::translate(one, {0, height_m, 0}), role);
        put("floor", plane(size_m, size_m), one, Role::receiverOnly);
        put("wall", plane(size_m, size_m),
            glm::rotate(glm::translate(one, {0, height_m - 0.5f * size_m, -0.5f * size_m}), 1.5707963f,
                        {1, 0, 0}),
            Role::receiverOnly);
        put("box", box(glm::vec3(0.1f * size_m)), glm::translate(one, {0, 0.05f * size_m, 0}), Role::both);
        const glm::vec3 lamp = in(place.x, height_m, place.y), below = in(place.x, 0, place.y);
        Light light = isDisk ? diskLight("disk", lamp_m, lamp, below, 1000)
                             : rectLight("rect", lamp_m, 2 * lamp_m, lamp, below, 1000);
        const glm::mat4 turned =
            glm::rotate(fromPenumbra(light.shape.worldFromLight), turn_rad, glm::vec3(0, 0, 1));
        light.shape.worldFromLight = toPenumbra(turned);
        scene.light(light);
        scene.camera(camera("eye", in(0.2f * size_m, 0.6f * height_m, 0.49f * size_m),
                            in(0, 0.7f * height_m, -0.4f * size_m), 1.2f));
        return std::move(scene).build();
    };
    return {fmt::format("seed {}: {:.3g} m, {} cells", seed, size_m, cells), build(Role::both),
            build(Role::receiverOnly)};
}

class CeilingTest : public TechniqueTest {
  protected:
    static void expectCeilingHidesNothing(std::string_view name, const Settings& settings) {
        const std::unique_ptr<Technique> technique = workbench().makeTechnique(name);
        for (const auto& [key, value] : settings) setParameter(*technique, key, value);
        for (std::uint32_t seed = 0; seed < 24; ++seed) {
            const Room room = makeRoom(seed);
            const LightResult casting = render(*technique, room.casting, {64, 40});
            const LightResult receiving = render(*technique, room.receiving, {64, 40});
            EXPECT_EQ(casting.visibility.values, receiving.visibility.values) << room.description;
            // The ceiling itself is not reached.
            EXPECT_NE(std::ranges::count(casting.reach.values, 0.0f), 0) << room.description;
        }
    }
};

TEST_F(CeilingTest, HidesNothingFromExact) {
    expectCeilingHidesNothing("exact", {});
    expectCeilingHidesNothing("exact", {{"tile_candidates", "1"}});
}

TEST_F(CeilingTest, HidesNothingFromTheReference) {
    expectCeilingHidesNothing("reference", {{"samples", "32"}, {"cache", "false"}});
}

}  // namespace
}  // namespace penumbra::studio
