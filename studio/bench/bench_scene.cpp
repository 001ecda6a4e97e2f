// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/bench_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"

namespace penumbra::studio {
namespace {

constexpr int perSide = 4;
constexpr const char* casterName = "torus";

}  // namespace

Scene makeBenchScene(const BenchSceneSpec& spec) {
    SceneBuilder scene("bench");
    scene.ground(16);
    // A torus has 2 segments x sides triangles, here with twice as many segments as sides.
    const int sides = std::max(3, int(std::lround(std::sqrt(spec.triangles / (4.0 * perSide * perSide)))));
    const int ring = scene.mesh(casterName, torus(0.45f, 0.16f, 2 * sides, sides), {0.62f, 0.4f, 0.2f});
    for (int i = 0; i < perSide * perSide; ++i) {
        const float x = 1.5f * float(i % perSide) - 2.25f, z = 1.5f * float(i / perSide) - 2.25f;
        const glm::vec3 axis = glm::normalize(glm::vec3(1, 0.2f, float(i % 3) - 1));
        scene.place(std::string(casterName) + " " + std::to_string(i), ring,
                    at({x, 0.6f + 0.25f * float(i % 4), z}, 0.4f * float(i), axis));
    }
    for (int i = 0; i < spec.lights; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * float(i) / float(spec.lights) + 2.2f;
        scene.light(rectLight("light " + std::to_string(i), spec.lightSize_m, spec.lightSize_m,
                              {2.5f * std::cos(angle), 5, 2.5f * std::sin(angle)}, {0, 0.5f, 0},
                              1000 / float(spec.lights)));
    }
    scene.camera(camera("front", {1.5f, 5, 7.5f}, {0, 0.4f, 0.2f}, 0.7f));
    return std::move(scene).build();
}

int trianglesOf(const Scene& scene) {
    std::size_t indices = 0;
    for (const Instance& instance : scene.at(0).instances) {
        if (instance.casts) indices += scene.meshes[std::size_t(instance.mesh)].indices.size();
    }
    return int(indices / 3);
}

}  // namespace penumbra::studio
