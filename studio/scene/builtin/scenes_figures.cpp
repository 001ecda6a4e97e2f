// SPDX-License-Identifier: Apache-2.0
// Set-ups of the papers' figures: Chan and Durand, "Rendering Fake Soft Shadows with Smoothies", 2003; Kirsch
// and Doellner, "Real-Time Soft Shadows Using a Single Light Sample", 2003. The papers give no dimensions:
// these are ours.
#include <numbers>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/builtin/scenes.h"

namespace penumbra::studio::builtin {
namespace {

constexpr float quarterTurn_rad = std::numbers::pi_v<float> / 2;
constexpr float illuminance_lux = 1000;

}  // namespace

// Smoothies, figure 1d: "a simple scene with 10,000 triangles", of which figures 7 and 8 enlarge the
// cylinder.
Scene primitives() {
    SceneBuilder scene("primitives");
    scene.ground(14);

    const int tall = scene.mesh("tall cylinder", penumbra::studio::cylinder(0.35f, 2.2f, 48), terracotta);
    const int drum = scene.mesh("drum", penumbra::studio::cylinder(0.5f, 0.4f, 48), sage);
    const int ring = scene.mesh("ring", penumbra::studio::torus(0.6f, 0.2f, 48, 24), mustard);
    const int hoop = scene.mesh("hoop", penumbra::studio::torus(0.65f, 0.13f, 48, 24), plum);
    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.5f, 32, 16), teal);
    const int marble = scene.mesh("marble", penumbra::studio::sphere(0.28f, 32, 16), cream);
    const int spire = scene.mesh("spire", cone(0.45f, 1.3f, 48), slate);
    const int cube = scene.mesh("cube", box(glm::vec3(0.8f)), cream);
    const int slab = scene.mesh("slab", box({1.4f, 0.25f, 0.7f}), slate);

    scene.place("tall cylinder", tall, at({-1.5f, 1.1f, -0.6f}));
    scene.place("drum", drum, at({2.1f, 0.2f, 1.3f}));
    scene.place("ring", ring, at({0.1f, 0.2f, 1.6f}));
    scene.place("hoop", hoop, at({1.9f, 0.78f, -1.3f}, quarterTurn_rad, {1, 0, 0.35f}));
    scene.place("ball", ball, at({0.2f, 0.5f, -0.4f}));
    scene.place("ball on drum", marble, at({2.1f, 0.68f, 1.3f}));
    scene.place("marble", marble, at({-1.3f, 0.28f, 1.2f}));
    scene.place("ball on cube", marble, at({-0.4f, 1.08f, -2.0f}));
    scene.place("cube", cube, at({-0.4f, 0.4f, -2.0f}, 0.5f));
    scene.place("cube askew", cube, at({-2.6f, 0.4f, 0.9f}, -0.4f));
    scene.place("slab", slab, at({1.2f, 0.125f, 2.7f}, 0.3f));
    scene.place("spire", spire, at({1.2f, 0.65f, 0.3f}));
    scene.place("spire behind", spire, at({-2.6f, 0.65f, -2.0f}));

    scene.light(rectLight("key", 1, 1, {-2.2f, 4.2f, 2.0f}, {0, 0.4f, 0}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {2.2f, 4.4f, 7.8f}, {-0.1f, 0.35f, 0.1f}, 0.65f));
    scene.camera(penumbra::studio::camera("cylinder", {0.5f, 3.4f, 0.4f}, {-1.05f, 0.2f, -0.95f}, 0.65f));
    return std::move(scene).build();
}

// Kirsch and Doellner, figure 1: "torus with soft shadow".
Scene torus() {
    SceneBuilder scene("torus");
    scene.ground(16);
    const int ring = scene.mesh("torus", penumbra::studio::torus(1, 0.38f, 96, 48), mustard);
    scene.place("torus", ring, at({0, 1.7f, 0}, 0.5f, {1, 0, -0.6f}));
    scene.light(rectLight("key", 0.6f, 0.6f, {-1.2f, 6, 1.0f}, {0, 0, 0}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {2.2f, 4.4f, 5.6f}, {0.1f, 0.8f, -0.1f}));
    return std::move(scene).build();
}

// Kirsch and Doellner, figure 4: the shadow-width map of a sphere.
Scene sphere() {
    SceneBuilder scene("sphere");
    scene.ground(16);
    const int ball = scene.mesh("sphere", penumbra::studio::sphere(0.8f, 96, 48), terracotta);
    scene.place("sphere", ball, at({0, 1.5f, 0}));
    scene.light(rectLight("key", 0.8f, 0.8f, {-1.5f, 5.5f, 0.8f}, {0, 0, 0}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {2.0f, 3.4f, 5.4f}, {0.2f, 0.8f, -0.1f}));
    return std::move(scene).build();
}

Scene diskAndSphere() {
    SceneBuilder scene("disk-and-sphere");
    scene.ground(16);
    const int plate = scene.mesh("plate", penumbra::studio::cylinder(0.55f, 0.04f, 96), slate);
    const int ball = scene.mesh("sphere", penumbra::studio::sphere(0.6f, 96, 48), terracotta);
    scene.place("plate", plate, at({-0.9f, 2.3f, 0.1f}));
    scene.place("sphere", ball, at({0, 0.75f, 0}));
    scene.light(diskLight("key", 0.5f, {-0.9f, 5, 0.2f}, {0, 0, 0}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {1.2f, 3.4f, 5.6f}, {-0.45f, 0.9f, 0}));
    return std::move(scene).build();
}

// Kirsch and Doellner, figure 5: "artifacts due to overlapping blockers".
Scene overlappingBlockers() {
    SceneBuilder scene("overlapping-blockers");
    scene.ground(16);
    const int board = scene.mesh("board", box({2.2f, 0.06f, 0.5f}), mustard);
    const int beam = scene.mesh("beam", box({0.35f, 0.08f, 2.4f}), slate);
    const int rod = scene.mesh("rod", penumbra::studio::cylinder(0.09f, 2.6f, 48), plum);
    const int ball = scene.mesh("ball", penumbra::studio::sphere(0.3f, 64, 32), terracotta);
    scene.place("low board", board, at({0.1f, 0.35f, 0.2f}, 0.2f));
    scene.place("middle beam", beam, at({0, 1.2f, 0}, 0.35f));
    scene.place("high rod", rod, at({-0.3f, 2.3f, 0.2f}, quarterTurn_rad, {1, 0, 0.7f}));
    scene.place("highest ball", ball, at({-0.5f, 3.1f, 0.3f}));
    scene.light(rectLight("key", 0.7f, 0.7f, {-0.8f, 6, 0.6f}, {0, 0, 0}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {2.8f, 5.0f, 6.6f}, {0, 1.1f, 0}));
    return std::move(scene).build();
}

// Smoothies, figure 9: box 1 casts a shadow onto box 2 and the ground, softer on the ground.
Scene twoBoxes() {
    SceneBuilder scene("two-boxes");
    scene.ground(16);
    const int upper = scene.mesh("box 1", box({1.1f, 0.3f, 1.1f}), terracotta);
    const int lower = scene.mesh("box 2", box({1.8f, 0.4f, 1.8f}), cream);
    scene.place("box 1", upper, at({-0.75f, 2.0f, 0}));
    scene.place("box 2", lower, at({0.35f, 0.8f, 0}));
    scene.light(rectLight("key", 0.5f, 0.5f, {-0.9f, 6, 0.3f}, {0, 0, 0}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {-2.2f, 3.8f, 5.8f}, {-0.2f, 0.8f, 0}));
    return std::move(scene).build();
}

// Smoothies, figures 7 and 8: the shadow of a cylinder under a light that is large against it.
Scene cylinder() {
    SceneBuilder scene("cylinder");
    scene.ground(16);
    const int column = scene.mesh("cylinder", penumbra::studio::cylinder(0.3f, 2.5f, 96), terracotta);
    scene.place("cylinder", column, at({0, 1.25f, 0}));
    scene.light(rectLight("key", 2, 2, {-3, 4, 1.2f}, {0.4f, 0.4f, -0.2f}, illuminance_lux));
    scene.camera(penumbra::studio::camera("front", {1.4f, 2.6f, 5.4f}, {0.7f, 0.9f, -0.3f}));
    return std::move(scene).build();
}

}  // namespace penumbra::studio::builtin
