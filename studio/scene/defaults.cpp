// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/defaults.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "studio/scene/builtin/placing.h"
#include "studio/scene/default_camera.h"

namespace penumbra::studio {
namespace {

/// Gives a scene the light or the camera that it lacks. Both stand still.
class WithDefaults : public Scene::Motion {
  public:
    WithDefaults(std::shared_ptr<const Scene::Motion> inner, std::optional<Light> light,
                 std::optional<Camera> camera)
        : inner_(std::move(inner)), light_(std::move(light)), camera_(std::move(camera)) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, time_s);
        if (light_) moment.lights.push_back(*light_);
        if (camera_) moment.cameras.push_back(*camera_);
        return moment;
    }

  private:
    std::shared_ptr<const Scene::Motion> inner_;
    std::optional<Light> light_;
    std::optional<Camera> camera_;
};

/// The bounds at all times, near enough: over eight moments of the animations that play.
Bounds boundsOverTime(const Scene& scene, const SceneMoment& start) {
    Bounds bounds = start.bounds;
    if (scene.duration_s() == 0) return bounds;
    constexpr int steps = 8;
    for (int step = 1; step < steps; ++step) {
        const Bounds moved = scene.at(scene.duration_s() * step / steps).bounds;
        if (moved.empty()) continue;
        bounds.include(moved.min);
        bounds.include(moved.max);
    }
    return bounds;
}

}  // namespace

void addDefaults(Scene& scene, const std::string& nameForMessages) {
    const SceneMoment start = scene.at(0);
    if (!start.lights.empty() && !start.cameras.empty()) return;
    const Bounds bounds = boundsOverTime(scene, start);
    std::optional<Light> light;
    std::optional<Camera> camera;
    if (start.lights.empty()) {
        light = keyLight("default key", bounds);
        scene.warnings.push_back(fmt::format("{} has no light: added a key light, {:.3g} m square, over it",
                                             nameForMessages, light->shape.width_m));
    }
    if (start.cameras.empty()) {
        camera = defaultCamera(scene, start, bounds);
        scene.warnings.push_back(fmt::format("{} has no camera: added one", nameForMessages));
    }
    scene.motion = std::make_shared<WithDefaults>(scene.motion, std::move(light), std::move(camera));
}

}  // namespace penumbra::studio
