// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/workbench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>

#include "studio/errors.h"

namespace penumbra::studio {

Workbench::Workbench(std::optional<int> device, ContextProfile profile)
    : context_(device, profile),
      device_(DeviceOptions{.log = logFromDevice}),
      clock_(device_),
      frame_(device_) {
    spdlog::info("OpenGL on {}", device_.renderer());
}

std::unique_ptr<Technique> Workbench::makeTechnique(std::string_view name) {
    return makeAnyTechnique(device_, name);
}

void Workbench::open(const Scene& scene) {
    scene_ = std::make_unique<GpuScene>(device_, scene);
}

TechniqueResult Workbench::run(std::string_view name, Technique& technique, const SceneMoment& moment,
                               const Camera& camera, PictureSize size, int timedRuns) {
    return run(
        name, [&](const Light&) -> Technique& { return technique; }, moment, camera, size, timedRuns);
}

TechniqueResult Workbench::run(std::string_view name, const TechniqueOf& techniqueOf,
                               const SceneMoment& moment, const Camera& camera, PictureSize size,
                               int timedRuns) {
    requireSize(size);
    scene_->update(moment);
    frame_.draw(*scene_, moment, camera, size.width_px, size.height_px);

    TechniqueResult result{.technique = std::string(name),
                           .lights = std::vector<LightResult>(moment.lights.size())};
    std::vector<VisibilityBuffer> visibilities = frame_.makeVisibilities(moment.lights);
    std::vector<Technique*> techniques;
    for (const Light& light : moment.lights) techniques.push_back(&techniqueOf(light));
    // Lights side by side that have one technique at once.
    for (std::size_t begin = 0, end = 0; begin < moment.lights.size(); begin = end) {
        while (end < moment.lights.size() && techniques[end] == techniques[begin]) ++end;
        const std::vector<FrameLight> lights =
            frame_.frameLights(std::span(moment.lights).subspan(begin, end - begin),
                               std::span(visibilities).subspan(begin, end - begin));
        FrameInputs inputs = frame_.frameInputs(lights);
        inputs.answered = [&](std::size_t i) {
            result.lights[begin + i].statistics = techniques[begin]->statistics();
        };
        techniques[begin]->renderLights(inputs);
    }
    for (std::size_t i = 0; i < moment.lights.size(); ++i) {
        const Light& light = moment.lights[i];
        LightResult& lightResult = result.lights[i];
        lightResult.light = light.name;
        for (int run = 0; run < timedRuns; ++run) {
            lightResult.milliseconds.push_back(clock_.milliseconds(
                [&] { techniques[i]->render(frame_.shadowInputs(light), visibilities[i]); }));
            lightResult.statistics = techniques[i]->statistics();
        }
        lightResult.visibility = frame_.readVisibility(visibilities[i]);
        frame_.addLight(light, visibilities[i]);
        lightResult.reach = frame_.readReach();
    }
    frame_.addLuminaires(moment.lights);
    result.display = frame_.readDisplay();
    result.exposureValue = frame_.readExposureValue();
    result.radiance = frame_.readRadiance();
    return result;
}

void Workbench::requireSize(PictureSize size) const {
    const int limit = device_.maxTextureSize_px();
    if (size.width_px < 1 || size.height_px < 1 || size.width_px > limit || size.height_px > limit) {
        throw UsageError(
            fmt::format("a picture of {}x{} pixels cannot be made; this device allows 1x1 to {}x{}",
                        size.width_px, size.height_px, limit, limit));
    }
}

const Camera& findCamera(const SceneMoment& moment, const std::optional<std::string>& nameOrIndex) {
    if (!nameOrIndex) return moment.cameras.front();
    const auto byName = std::ranges::find(moment.cameras, *nameOrIndex, &Camera::name);
    if (byName != moment.cameras.end()) return *byName;
    std::size_t index = 0;
    const char* const end = nameOrIndex->data() + nameOrIndex->size();
    const auto parsed = std::from_chars(nameOrIndex->data(), end, index);
    if (parsed.ec == std::errc() && parsed.ptr == end && index < moment.cameras.size())
        return moment.cameras[index];
    std::vector<std::string> names;
    for (const Camera& camera : moment.cameras)
        names.push_back(fmt::format("{} ({})", names.size(), camera.name));
    throw UsageError(
        fmt::format("there is no camera '{}'; the scene has: {}", *nameOrIndex, fmt::join(names, ", ")));
}

}  // namespace penumbra::studio
