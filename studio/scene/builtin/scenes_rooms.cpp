// SPDX-License-Identifier: Apache-2.0
// Rooms as people have them: everything casts, and lights hang where lights hang.
#include <numbers>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/builtin/scenes.h"

namespace penumbra::studio::builtin {
namespace {

constexpr glm::vec3 plaster{0.62f, 0.58f, 0.52f};

/// One box of its own mesh, by its middle.
void put(SceneBuilder& scene, const char* name, const glm::vec3& size_m, const glm::vec3& middle,
         const glm::vec3& color, float turn_rad = 0) {
    scene.place(name, scene.mesh(name, box(size_m), color), at(middle, turn_rad));
}

}  // namespace

Scene office() {
    SceneBuilder scene("office");
    constexpr float height_m = 2.7f;
    scene.place("room", scene.mesh("room", room({5, height_m, 4}), plaster), at({0, 0.5f * height_m, 0}));

    put(scene, "desk top", {1.6f, 0.04f, 0.8f}, {0.3f, 0.74f, -0.6f}, mustard);
    put(scene, "desk side left", {0.04f, 0.72f, 0.7f}, {-0.4f, 0.36f, -0.6f}, mustard);
    put(scene, "desk side right", {0.04f, 0.72f, 0.7f}, {1.0f, 0.36f, -0.6f}, mustard);
    put(scene, "screen", {0.6f, 0.36f, 0.03f}, {0.4f, 1.04f, -0.75f}, slate);
    put(scene, "screen's foot", {0.2f, 0.1f, 0.12f}, {0.4f, 0.81f, -0.75f}, slate);
    put(scene, "seat", {0.45f, 0.06f, 0.45f}, {0.2f, 0.46f, 0.25f}, plum, 0.3f);
    put(scene, "chair's back", {0.42f, 0.4f, 0.05f}, {0.27f, 0.82f, 0.46f}, plum, 0.3f);
    const int leg = scene.mesh("leg", penumbra::studio::cylinder(0.03f, 0.43f, 24), slate);
    scene.place("chair's leg", leg, at({0.2f, 0.215f, 0.25f}));

    put(scene, "shelf left", {0.3f, 1.8f, 0.03f}, {-2.35f, 0.9f, -1.4f}, cream);
    put(scene, "shelf right", {0.3f, 1.8f, 0.03f}, {-2.35f, 0.9f, -0.2f}, cream);
    const int board = scene.mesh("board", box({0.3f, 0.03f, 1.17f}), cream);
    int number = 0;
    for (const float y : {0.1f, 0.65f, 1.2f, 1.75f})
        scene.place("board " + std::to_string(++number), board, at({-2.35f, y, -0.8f}));
    put(scene, "books", {0.2f, 0.28f, 0.5f}, {-2.38f, 0.805f, -0.95f}, terracotta);
    const int pot = scene.mesh("pot", penumbra::studio::cylinder(0.16f, 0.3f, 32), terracotta);
    const int bush = scene.mesh("bush", penumbra::studio::sphere(0.3f, 32, 16), sage);
    scene.place("pot", pot, at({-1.9f, 0.15f, 0.6f}));
    scene.place("bush", bush, at({-1.9f, 0.56f, 0.6f}));

    scene.light(rectLight("panel", 1.2f, 0.6f, {-0.2f, height_m, -0.3f}, {-0.2f, 0, -0.3f}, 500));
    scene.camera(camera("door", {2.2f, 1.6f, 1.7f}, {-0.5f, 0.75f, -0.6f}, 1.0f));
    return std::move(scene).build();
}

Scene sunnyWindow() {
    SceneBuilder scene("sunny-window");
    // 4 x 4 m within, 2.6 m high; walls of 0.2 m, the window in the one on the right.
    scene.ground(6);
    put(scene, "ceiling", {4.4f, 0.2f, 4.4f}, {0, 2.7f, 0}, plaster);
    put(scene, "wall left", {0.2f, 2.6f, 4.4f}, {-2.1f, 1.3f, 0}, plaster);
    put(scene, "wall behind", {4, 2.6f, 0.2f}, {0, 1.3f, -2.1f}, plaster);
    put(scene, "wall in front", {4, 2.6f, 0.2f}, {0, 1.3f, 2.1f}, plaster);
    put(scene, "wall below the window", {0.2f, 0.9f, 1.6f}, {2.1f, 0.45f, 0}, plaster);
    put(scene, "wall above the window", {0.2f, 0.4f, 1.6f}, {2.1f, 2.4f, 0}, plaster);
    put(scene, "wall beyond the window", {0.2f, 2.6f, 1.4f}, {2.1f, 1.3f, -1.5f}, plaster);
    put(scene, "wall before the window", {0.2f, 2.6f, 1.4f}, {2.1f, 1.3f, 1.5f}, plaster);
    put(scene, "mullion", {0.06f, 1.3f, 0.06f}, {2.1f, 1.55f, 0}, cream);
    put(scene, "transom", {0.06f, 0.06f, 1.6f}, {2.1f, 1.75f, 0}, cream);

    put(scene, "table top", {1.1f, 0.04f, 0.8f}, {0.2f, 0.72f, -0.3f}, mustard);
    const int leg = scene.mesh("leg", box({0.06f, 0.7f, 0.06f}), mustard);
    int number = 0;
    for (const float x : {-0.3f, 0.7f})
        for (const float z : {-0.65f, 0.05f})
            scene.place("leg " + std::to_string(++number), leg, at({x, 0.35f, z}));
    const int vase = scene.mesh("vase", penumbra::studio::cylinder(0.07f, 0.3f, 32), teal);
    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.22f, 48, 24), terracotta);
    scene.place("vase", vase, at({0.3f, 0.89f, -0.3f}));
    scene.place("ball", ball, at({-0.9f, 0.22f, 0.5f}));

    constexpr float seenFromEarth_rad = 0.53f * std::numbers::pi_v<float> / 180;
    scene.light(distantLight("sun", seenFromEarth_rad, {-0.8f, -0.5f, -0.18f}, 80'000, {1, 0.95f, 0.88f}));
    scene.camera(camera("corner", {1.7f, 1.6f, 1.8f}, {-0.5f, 0.5f, -0.5f}, 1.0f));
    return std::move(scene).build();
}

Scene lampShade() {
    SceneBuilder scene("lamp-shade");
    scene.ground(5);
    put(scene, "wall", {5, 2.6f, 0.1f}, {0, 1.3f, -1.3f}, plaster);
    const int foot = scene.mesh("foot", penumbra::studio::cylinder(0.18f, 0.04f, 48), slate);
    const int pole = scene.mesh("pole", penumbra::studio::cylinder(0.015f, 1.44f, 24), slate);
    const int shade = scene.mesh("shade", penumbra::studio::cylinder(0.2f, 0.26f, 64, Ends::open), mustard);
    scene.place("foot", foot, at({-0.4f, 0.02f, -0.8f}));
    scene.place("pole", pole, at({-0.4f, 0.76f, -0.8f}));
    scene.place("shade", shade, at({-0.4f, 1.62f, -0.8f}));
    put(scene, "seat", {0.7f, 0.4f, 0.7f}, {0.5f, 0.2f, -0.5f}, plum, -0.25f);
    put(scene, "seat's back", {0.7f, 0.5f, 0.16f}, {0.57f, 0.65f, -0.77f}, plum, -0.25f);
    const int table = scene.mesh("table", penumbra::studio::cylinder(0.3f, 0.03f, 48), cream);
    const int leg = scene.mesh("leg", penumbra::studio::cylinder(0.03f, 0.45f, 24), slate);
    const int cup = scene.mesh("cup", penumbra::studio::cylinder(0.04f, 0.09f, 32), teal);
    scene.place("table", table, at({-0.6f, 0.465f, 0}));
    scene.place("table's leg", leg, at({-0.6f, 0.225f, 0}));
    scene.place("cup", cup, at({-0.65f, 0.525f, 0.05f}));

    scene.light(
        sphereLight("bulb", 0.04f, {-0.4f, 1.6f, -0.8f}, {-0.4f, 0.6f, -0.8f}, 150, {1, 0.85f, 0.65f}));
    scene.camera(camera("front", {0.4f, 1.5f, 3.0f}, {0, 0.85f, -0.8f}, 0.8f));
    return std::move(scene).build();
}

}  // namespace penumbra::studio::builtin
