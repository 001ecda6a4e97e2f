// SPDX-License-Identifier: Apache-2.0
#include "tests/support/random_ground.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"

namespace penumbra::studio {
namespace {

constexpr glm::vec3 gray(0.5f);

/// A triangle around the origin that is about `size_m` wide, facing +Y.
Mesh triangle(float size_m) {
    Mesh mesh;
    mesh.positions = {{-size_m, 0, -size_m}, {-size_m, 0, size_m}, {2 * size_m, 0, 0.1f * size_m}};
    mesh.normals.assign(3, {0, 1, 0});
    mesh.indices = {0, 1, 2};
    return mesh;
}

struct Ground {
    float size_m;
    int cells;  // a side; 0: one triangle
    glm::mat4 worldFromGround;
    glm::vec3 eye, target;
    Light light;
    glm::mat4 worldFromBox;
    glm::vec3 boxSize_m;

    Scene build(Role role) const {
        SceneBuilder scene("ground");
        const Mesh mesh = cells == 0 ? triangle(size_m) : plane(size_m, size_m, cells, cells);
        const glm::mat4 ground = worldFromGround, box = worldFromBox;
        scene.place(
            "ground", scene.mesh("ground", mesh, gray), [=](double) { return ground; }, role);
        scene.place("box", scene.mesh("box", penumbra::studio::box(boxSize_m), gray),
                    [=](double) { return box; });
        scene.light(light);
        scene.camera(camera("eye", eye, target));
        return std::move(scene).build();
    }
};

}  // namespace

RandomGround makeRandomGround(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
    const auto between = [&](float low, float high) { return low + (high - low) * unit(); };
    const auto scaled = [&](float low, float high) { return low * std::pow(high / low, unit()); };

    Ground ground{};
    ground.size_m = scaled(1, 10'000);
    ground.cells = unit() < 0.2f ? 0 : int(scaled(1, 70.9f));
    const float tilt_rad = unit() < 0.5f ? 0 : between(0, 0.5236f), turn_rad = between(0, 6.2832f);
    const glm::mat4 turned = glm::rotate(glm::mat4(1), turn_rad, glm::vec3(0, 1, 0));
    const glm::mat4 tilted =
        glm::rotate(glm::mat4(1), tilt_rad, glm::normalize(glm::vec3(between(-1, 1), 0, between(-1, 1.1f))));
    // The ground's middle may be up to a quarter of it away.
    const float away_m = between(0, 0.25f) * ground.size_m;
    ground.worldFromGround = tilted * glm::translate(glm::mat4(1), {away_m, 0, 0.5f * away_m}) * turned;

    const auto onGround = [&](float x, float y, float z) {
        return glm::vec3(tilted * glm::vec4(x, y, z, 1));
    };
    const float height_m = scaled(0.05f, 100), far_m = height_m * between(0.1f, 4);
    ground.eye = onGround(0.3f * far_m, height_m, far_m);
    ground.target = onGround(0, 0.1f * height_m, 0);
    const float scale_m = 0.3f * height_m;
    ground.boxSize_m = scale_m * glm::vec3(between(0.2f, 1), between(0.2f, 1), between(0.2f, 1));
    ground.worldFromBox = tilted * glm::translate(glm::mat4(1), {0, 0.5f * ground.boxSize_m.y, 0}) * turned;

    const glm::vec3 lamp =
        onGround(between(-6, 6) * scale_m, between(4, 8) * scale_m, between(-6, 6) * scale_m);
    const glm::vec3 lit = onGround(0, 0, 0);
    switch (random() % 4) {
        case 0:
            ground.light = rectLight("rect", scale_m, 2 * scale_m, lamp, lit, 1000);
            break;
        case 1:
            ground.light = diskLight("disk", scale_m, lamp, lit, 1000);
            break;
        case 2:
            ground.light = sphereLight("sphere", scale_m, lamp, lit, 1000);
            break;
        default:
            ground.light = distantLight("distant", 0.1f, lit - lamp, 1000);
    }
    return {ground.build(Role::both), ground.build(Role::receiverOnly),
            fmt::format("seed {}: {:.4g} m, {} cells, tilted by {:.3f}, from {:.3g} m, {} light", seed,
                        ground.size_m, ground.cells, tilt_rad, height_m, ground.light.name)};
}

}  // namespace penumbra::studio
