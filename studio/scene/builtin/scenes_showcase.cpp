// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/builtin/scenes.h"

namespace penumbra::studio::builtin {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// 4 x 4 panes of coloured glass in a dark frame, 16 pixels a pane.
Picture stainedGlass() {
    using Color = std::array<std::uint8_t, 3>;
    constexpr Color red{230, 40, 30}, amber{250, 170, 30}, green{40, 170, 70}, blue{40, 80, 220},
        violet{150, 50, 190}, clear{250, 240, 220}, lead{8, 8, 8};
    constexpr std::array<std::array<Color, 4>, 4> panes{{{red, amber, blue, violet},
                                                         {amber, clear, green, blue},
                                                         {blue, green, clear, amber},
                                                         {violet, blue, amber, red}}};
    constexpr int pane_px = 16;
    Picture picture{"stained glass", 4 * pane_px, 4 * pane_px, {}};
    for (int y = 0; y < picture.height_px; ++y)
        for (int x = 0; x < picture.width_px; ++x) {
            const auto isLead = [](int i) { return i % pane_px == 0 || i % pane_px == pane_px - 1; };
            const Color& color = isLead(x) || isLead(y) ? lead : panes[y / pane_px][x / pane_px];
            picture.rgba.insert(picture.rgba.end(), {color[0], color[1], color[2], 255});
        }
    return picture;
}

glm::mat4 moved(const glm::vec3& position) {
    return glm::translate(glm::mat4(1), position);
}

}  // namespace

Scene columns() {
    SceneBuilder scene("columns");
    const int walls = scene.mesh("room", room({9, 4, 9}), {0.62f, 0.58f, 0.52f});
    const int shaft = scene.mesh("shaft", penumbra::studio::cylinder(0.26f, 3.4f, 48), cream);
    const int foot = scene.mesh("foot", box({0.8f, 0.3f, 0.8f}), cream);
    scene.place("room", walls, at({0, 2, 0}));
    int number = 0;
    for (float x : {-2.2f, 2.2f})
        for (float z : {-2.8f, 0.0f, 2.8f}) {
            const std::string name = "column " + std::to_string(++number);
            scene.place(name + " base", foot, at({x, 0.15f, z}));
            scene.place(name + " shaft", shaft, at({x, 2, z}));
            scene.place(name + " capital", foot, at({x, 3.85f, z}));
        }
    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.45f, 64, 32), terracotta);
    scene.place("ball", ball, at({-0.7f, 0.45f, -1.6f}));
    scene.light(sphereLight("bulb", 0.2f, {0.3f, 2.3f, -0.6f}, {0, 0, 0}, 600, {1, 0.9f, 0.78f}));
    scene.camera(camera("entrance", {0.9f, 1.7f, 4.2f}, {-0.15f, 1.4f, -1}, 1.0f));
    return std::move(scene).build();
}

Scene moving() {
    SceneBuilder scene("moving");
    scene.ground(16);
    constexpr float duration_s = 4;
    scene.loop("loop", duration_s);
    const auto turn_rad = [](double time_s) { return float(2 * std::numbers::pi * time_s / duration_s); };

    const int pole = scene.mesh("pole", penumbra::studio::cylinder(0.04f, 2.6f, 24), cream);
    const int cloth = scene.mesh("cloth", flag(1.3f, 0.16f, 1.25f, 32), plum);
    scene.place("pole", pole, at({-1.9f, 1.3f, -0.9f}));
    scene.place("cloth", cloth, at({-1.86f, 1.9f, -0.9f}), Role::both, [turn_rad](double time_s) {
        return std::vector{std::cos(2 * turn_rad(time_s)), std::sin(2 * turn_rad(time_s))};
    });

    const int ring = scene.mesh("torus", penumbra::studio::torus(0.6f, 0.18f, 64, 32), mustard);
    scene.place("torus", ring, [turn_rad](double time_s) {
        return glm::rotate(moved({0.3f, 1.3f, 0}), turn_rad(time_s), glm::normalize(glm::vec3(1, 0.3f, 0)));
    });

    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.35f, 48, 24), terracotta);
    scene.place("ball", ball, [turn_rad](double time_s) {
        return moved({1.7f, 0.35f + 1.1f * std::abs(std::sin(turn_rad(time_s))), 0.9f});
    });

    const int satellite = scene.mesh("box", box({0.5f, 0.5f, 0.5f}), teal);
    scene.place("box", satellite, [turn_rad](double time_s) {
        const float angle_rad = turn_rad(time_s);
        return glm::rotate(moved({0.3f + 1.4f * std::cos(angle_rad), 0.3f, 1.4f * std::sin(angle_rad)}),
                           -angle_rad, glm::vec3(0, 1, 0));
    });

    scene.light(rectLight("key", 1, 1, {-2.0f, 4.6f, 2.4f}, {0, 0.4f, 0}, 1000));
    scene.camera(camera("front", {1.8f, 3.4f, 6.8f}, {0.2f, 0.8f, 0}));
    return std::move(scene).build();
}

Scene texturedWindow() {
    SceneBuilder scene("textured-window");
    scene.ground(16);
    const int pillar = scene.mesh("pillar", penumbra::studio::cylinder(0.12f, 1.8f, 48), cream);
    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.4f, 64, 32), cream);
    const int bench = scene.mesh("bench", box({0.5f, 0.4f, 1.6f}), cream);
    scene.place("left pillar", pillar, at({-0.6f, 0.9f, -1}));
    scene.place("middle pillar", pillar, at({-0.6f, 0.9f, 0}));
    scene.place("right pillar", pillar, at({-0.6f, 0.9f, 1}));
    scene.place("ball", ball, at({0.7f, 0.4f, 0.6f}));
    scene.place("bench", bench, at({0.8f, 0.2f, -0.9f}, 0.3f));
    Light window = rectLight("window", 1.6f, 1.6f, {-2.8f, 3.2f, 0.4f}, {0.2f, 0.2f, 0}, 4000);
    window.texture = scene.texture(stainedGlass());
    scene.light(window);
    scene.camera(camera("front", {3.4f, 3.0f, 4.0f}, {0.1f, 0.4f, 0}));
    return std::move(scene).build();
}

Scene manyLights() {
    SceneBuilder scene("many-lights");
    scene.ground(16);
    const int ring = scene.mesh("torus", penumbra::studio::torus(0.55f, 0.18f, 64, 32), cream);
    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.45f, 64, 32), cream);
    const int spire = scene.mesh("spire", cone(0.4f, 1.3f, 64), cream);
    const int cube = scene.mesh("cube", box(glm::vec3(0.7f)), cream);
    scene.place("torus", ring, at({0.2f, 0.73f, 0.1f}, 0.5f * pi, {1, 0, 0.4f}));
    scene.place("ball", ball, at({-1.3f, 0.45f, 0.5f}));
    scene.place("spire", spire, at({1.5f, 0.65f, -0.4f}));
    scene.place("cube", cube, at({-0.5f, 0.35f, -1.3f}, 0.6f));

    const glm::vec3 target(0, 0.3f, 0);
    scene.light(rectLight("warm panel", 1.2f, 0.8f, {-3, 3.4f, 1.8f}, target, 450, {1, 0.55f, 0.25f}));
    scene.light(rectLight("cool strip", 2.4f, 0.1f, {0, 3.6f, -2.8f}, target, 350, {0.3f, 0.55f, 1}));
    scene.light(diskLight("green spot", 0.4f, {3.2f, 3, 1.4f}, target, 300, {0.35f, 1, 0.4f}));
    scene.light(sphereLight("rose bulb", 0.25f, {1.4f, 3.2f, 3.2f}, target, 250, {1, 0.3f, 0.5f}));
    scene.light(distantLight("moon", 2 * pi / 180, {0.5f, -1, -0.35f}, 150, {0.75f, 0.85f, 1}));
    scene.camera(camera("front", {0.8f, 3.0f, 5.0f}, {0.1f, 0.4f, -0.1f}));
    return std::move(scene).build();
}

}  // namespace penumbra::studio::builtin
