// SPDX-License-Identifier: Apache-2.0
#include "studio/papers/stage.h"

#include <algorithm>
#include <cmath>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/open_scene.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {
namespace {

/// A scene with a square ground under it, eight times as wide as the scene is large.
class OverGround : public Scene::Motion {
  public:
    OverGround(std::shared_ptr<const Scene::Motion> inner, Instance ground)
        : inner_(std::move(inner)), ground_(std::move(ground)) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, time_s);
        moment.worldFromNode.push_back(ground_.worldFromMesh);
        moment.instances.push_back(ground_);
        return moment;
    }

  private:
    std::shared_ptr<const Scene::Motion> inner_;
    Instance ground_;
};

void addGround(Scene& scene) {
    const Bounds bounds = scene.at(0).bounds;
    const float width_m = 8 * bounds.radius();
    Mesh ground = plane(width_m, width_m);
    ground.name = "ground";
    ground.material = int(scene.materials.size());
    scene.materials.push_back({.name = "ground", .baseColor = {0.6f, 0.6f, 0.6f, 1}});
    scene.meshes.push_back(std::move(ground));
    scene.nodeNames.emplace_back("ground");
    Instance instance{
        .mesh = int(scene.meshes.size()) - 1, .node = int(scene.nodeNames.size()) - 1, .casts = false};
    instance.worldFromMesh[3] = glm::vec4(bounds.center().x, bounds.min.y, bounds.center().z, 1);
    scene.motion = std::make_shared<OverGround>(scene.motion, instance);
}

}  // namespace

Stage openStage(const Situation& situation, const std::filesystem::path& models) {
    if (situation.model.empty()) return {openScene(situation.scene), ""};
    const std::filesystem::path file = models / situation.model;
    std::error_code error;
    if (models.empty() || !std::filesystem::exists(file, error)) {
        return {openScene(situation.scene), situation.scene};
    }
    Stage stage{openScene(file.string()), ""};
    if (!situation.placement) addGround(stage.scene);
    return stage;
}

StageView viewOf(const Stage& stage, const Situation& situation) {
    StageView view{.moment = stage.scene.at(situation.time_s), .camera = {}};
    // A stand-in has cameras of its own.
    const bool named = !situation.camera.empty() && stage.standIn.empty();
    view.camera =
        findCamera(view.moment, named ? std::optional<std::string>(situation.camera) : std::nullopt);
    if (situation.placement && stage.standIn.empty()) {
        const Placement& placement = *situation.placement;
        view.camera = camera("placed", placement.eye, placement.target, 1.0f);
        view.moment.lights = {rectLight("key", placement.lightSize_m, placement.lightSize_m, placement.light,
                                        placement.lightTarget, 1000)};
    }
    view.camera.yfov_rad = 2 * std::atan(std::tan(0.5f * view.camera.yfov_rad) / situation.zoom);
    for (Light& light : view.moment.lights) {
        for (float* size : {&light.shape.width_m, &light.shape.height_m, &light.shape.length_m,
                            &light.shape.radius_m, &light.shape.angle_rad})
            *size *= situation.lightScale;
    }
    const bool isBuiltin = situation.model.empty() || !stage.standIn.empty();
    for (Instance& instance : view.moment.instances) {
        if (isBuiltin && instance.node == groundNode) instance.casts = false;
        instance.receives = instance.receives && (situation.blockersReceive || !instance.casts);
    }
    return view;
}

}  // namespace penumbra::studio
