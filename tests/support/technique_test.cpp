// SPDX-License-Identifier: Apache-2.0
#include "tests/support/technique_test.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "studio/scene/builtin/builtin.h"

namespace penumbra::studio {
namespace {

class ChangedMotion final : public Scene::Motion {
  public:
    ChangedMotion(std::shared_ptr<const Motion> inner, std::function<void(SceneMoment&)> change)
        : inner_(std::move(inner)), change_(std::move(change)) {}
    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, time_s);
        change_(moment);
        return moment;
    }

  private:
    std::shared_ptr<const Motion> inner_;
    std::function<void(SceneMoment&)> change_;
};

}  // namespace

ContextProfile testProfile() {
    const char* const asked = std::getenv("PENUMBRA_TEST_PROFILE");
    return asked != nullptr && std::string_view(asked) == "compatibility" ? ContextProfile::compatibility
                                                                          : ContextProfile::core;
}

void TechniqueTest::TearDown() {
    EXPECT_EQ(workbench().device().severeMessageCount(), 0) << "see the log above";
}

Workbench& TechniqueTest::workbench() {
    static Workbench instance(std::nullopt, testProfile());
    return instance;
}

LightResult TechniqueTest::render(std::string_view technique, const Scene& scene, PictureSize size,
                                  const Settings& settings, double time_s) {
    const std::unique_ptr<Technique> made = workbench().makeTechnique(technique);
    for (const auto& [key, value] : settings) setParameter(*made, key, value);
    return render(*made, scene, size, time_s);
}

LightResult TechniqueTest::render(Technique& technique, const Scene& scene, PictureSize size, double time_s) {
    const SceneMoment moment = scene.at(time_s);
    workbench().open(scene);
    return workbench().run("test", technique, moment, moment.cameras.front(), size).lights.at(0);
}

LightResult TechniqueTest::truth(const Scene& scene, PictureSize size, int samples) {
    return render("reference", scene, size, {{"samples", std::to_string(samples)}, {"cache", "false"}});
}

VisibilityMetrics TechniqueTest::judge(const LightResult& truth, const LightResult& result) {
    std::vector<std::uint8_t> reached;
    for (const float irradiance : truth.reach.values) reached.push_back(irradiance > 0);
    return compareVisibility(truth.visibility, result.visibility, reached);
}

double TechniqueTest::shareOfDifferentPixels(const LightResult& a, const LightResult& b, float tolerance) {
    std::size_t reached = 0, different = 0;
    for (std::size_t i = 0; i < a.reach.values.size(); ++i) {
        if (!(a.reach.values[i] > 0)) continue;
        ++reached;
        // Written so that a NaN counts as different.
        different += !(std::abs(a.visibility.values[i] - b.visibility.values[i]) <= tolerance);
    }
    return reached == 0 ? 0 : double(different) / double(reached);
}

std::optional<std::filesystem::path> fieldScenes() {
    const char* const variable = std::getenv("PENUMBRA_SHARED_SCENES");
    const std::filesystem::path field =
        std::filesystem::path(variable ? variable : PENUMBRA_DEFAULT_SHARED_SCENES) / "field";
    std::error_code error;
    return std::filesystem::is_directory(field, error) ? std::optional(field) : std::nullopt;
}

Scene withLight(Scene scene, const std::function<void(Light&)>& change) {
    return withMoment(std::move(scene), [change](SceneMoment& moment) {
        moment.lights.resize(1);
        change(moment.lights.front());
    });
}

Scene withMoment(Scene scene, const std::function<void(SceneMoment&)>& change) {
    scene.motion = std::make_shared<ChangedMotion>(scene.motion, change);
    return scene;
}

bool isGround(const Instance& instance) {
    return instance.node == groundNode;
}

Scene onReceivingGround(Scene scene) {
    return withMoment(std::move(scene), [](SceneMoment& moment) {
        std::ranges::find_if(moment.instances, isGround)->casts = false;
    });
}

Scene withAlphaMask(Scene scene, Picture picture) {
    constexpr int nearest = 0x2600;  // GL_NEAREST, as in glTF
    scene.pictures.push_back(std::move(picture));
    scene.textures.push_back(
        {.picture = int(scene.pictures.size()) - 1, .minFilter = nearest, .magFilter = nearest});
    for (Material& material : scene.materials) {
        material.alpha = Material::Alpha::mask;
        material.baseColorTexture = int(scene.textures.size()) - 1;
    }
    return scene;
}

void shrinkToPoint(Light& light) {
    light.shape.width_m = light.shape.height_m = light.shape.length_m = 0;
    light.shape.radius_m = light.shape.angle_rad = 0;
    light.texture = -1;
    light.emission.unit =
        light.shape.shape == LightShape::distant ? Emission::Unit::lux : Emission::Unit::candela;
}

}  // namespace penumbra::studio
