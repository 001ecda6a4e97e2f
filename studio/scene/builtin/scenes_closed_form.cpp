// SPDX-License-Identifier: Apache-2.0
// Set-ups whose visibility is known exactly. Light in the plane y = H = 4, blocker in the plane y = h = 2,
// receiver in the plane y = 0. A blocker point b hides, from a receiver point p, the light-plane point p + (b
// - p) H/h; so with k = (H - h)/h = 1 an edge at x = 0 appears, from p = x, at -k x beside the light's
// centre.
//
// Both cameras stay under the blocker, which would hide the umbra from above.
#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/builtin/scenes.h"

namespace penumbra::studio::builtin {
namespace {

constexpr float lightHeight_m = 4, blockerHeight_m = 2;
constexpr float blockerLength_m = 40;
constexpr float illuminance_lux = 1000;
constexpr glm::vec3 lightCenter{0, lightHeight_m, 0};

/// "under": in perspective, at an angle; "plan": straight down, parallel, 3 m high, picture right = +X, up =
/// -Z.
void addCameras(SceneBuilder& scene) {
    scene.camera(camera("under", {0, 1.6f, 1.9f}, {0, 0, 0}, 0.9f));
    Camera plan = camera("plan", {0, 1.5f, 0}, {0, 0, 0});
    plan.orthographicHeight_m = 3;
    scene.camera(plan);
}

}  // namespace

Scene halfPlane() {
    SceneBuilder scene("half-plane");
    scene.ground(40);
    const int sheet = scene.mesh("half-plane", plane(0.5f * blockerLength_m, blockerLength_m), terracotta);
    scene.place("half-plane", sheet, at({-0.25f * blockerLength_m, blockerHeight_m, 0}));
    scene.light(rectLight("key", 1, 1, lightCenter, glm::vec3(0), illuminance_lux));
    addCameras(scene);
    return std::move(scene).build();
}

Scene strip() {
    SceneBuilder scene("strip");
    scene.ground(40);
    const int sheet = scene.mesh("strip", plane(0.4f, blockerLength_m), mustard);
    scene.place("strip", sheet, at({0, blockerHeight_m, 0}));
    scene.light(rectLight("key", 1, 1, lightCenter, glm::vec3(0), illuminance_lux));
    addCameras(scene);
    return std::move(scene).build();
}

Scene diskOverGround() {
    // A regular polygon of n sides falls short of its circle's area by 2 pi^2 / (3 n^2): 2.5e-5 of it here.
    constexpr int sides = 512;
    SceneBuilder scene("disk-over-ground");
    scene.ground(40);
    const int sheet = scene.mesh("disk", disk(0.4f, sides), slate);
    scene.place("disk", sheet, at({0, blockerHeight_m, 0}));
    scene.light(diskLight("key", 0.5f, lightCenter, glm::vec3(0), illuminance_lux));
    addCameras(scene);
    return std::move(scene).build();
}

}  // namespace penumbra::studio::builtin
