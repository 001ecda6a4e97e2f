// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/judge.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "studio/frame/conversions.h"
#include "studio/metrics/flicker.h"
#include "studio/metrics/flip.h"
#include "studio/workbench/reference_technique.h"
#include "studio/workbench/settle.h"

namespace penumbra::studio {
namespace {

constexpr double framesPerSecond = 24;

/// Where the unshadowed light arrives: nothing else is judged.
std::vector<std::uint8_t> reachedPixels(const Image& reach) {
    std::vector<std::uint8_t> mask(reach.pixelCount());
    std::ranges::transform(reach.values, mask.begin(), [](float irradiance) { return irradiance > 0; });
    return mask;
}

double countOf(const Statistics& statistics, std::string_view name) {
    const auto found = std::ranges::find(statistics.counts, name, &Statistic::name);
    return found == statistics.counts.end() ? 0 : found->value;
}

ReferenceSummary summarize(const TechniqueResult& truth, int samples) {
    ReferenceSummary summary{.samples = samples, .display = truth.display};
    double rays = 0, seconds = 0;
    for (const LightResult& light : truth.lights) {
        summary.noise_rms = std::max(summary.noise_rms, countOf(light.statistics, "noise_rms"));
        summary.visibilities.push_back(light.visibility);
        rays += countOf(light.statistics, "rays");
        seconds += countOf(light.statistics, "trace_seconds");
    }
    summary.raysPerSecond = seconds > 0 ? rays / seconds : 0;
    return summary;
}

TechniqueComparison compareOne(const TechniqueResult& truth, TechniqueResult&& result) {
    TechniqueComparison comparison{.technique = result.technique,
                                   .flip = flip(truth.display, result.display),
                                   .display = std::move(result.display)};
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
        LightResult& light = result.lights[i];
        LightComparison& judged = comparison.lights.emplace_back();
        judged.light = light.light;
        judged.metrics =
            compareVisibility(truth.lights[i].visibility, light.visibility, reachedPixels(light.reach));
        judged.milliseconds = std::move(light.milliseconds);
        for (const Statistic& count : light.statistics.counts) {
            judged.counts.emplace_back(count.name, count.value);
        }
        judged.chosen = describe(light.statistics.chosen);
        judged.visibility = std::move(light.visibility);
        if (judged.metrics.notFinite > 0) {
            throw std::runtime_error(
                fmt::format("{}: {} visibility values are not finite, the first at pixel {}, {}",
                            comparison.technique, judged.metrics.notFinite, judged.metrics.firstNotFinite->x,
                            judged.metrics.firstNotFinite->y));
        }
    }
    return comparison;
}

std::unique_ptr<Technique> makeSettled(Workbench& workbench, const Contender& contender,
                                       const SceneMoment& moment, const Camera& camera, PictureSize size) {
    std::unique_ptr<Technique> technique = makeTechnique(workbench, contender);
    settle(
        workbench, [&](const Light&) -> Technique& { return *technique; }, moment, camera, size);
    return technique;
}

/// More than contact shadows that coarse maps lose.
constexpr double suspiciousShare = 0.02;

/// Where all techniques, which look in different ways, see light that rays do not, the rays are to be doubted
/// first.
void doubtTruth(const TechniqueResult& truth, const Comparison& comparison) {
    if (comparison.techniques.size() < 2) return;
    for (std::size_t i = 0; i < truth.lights.size(); ++i) {
        std::vector<Image> results;
        for (const TechniqueComparison& technique : comparison.techniques)
            results.push_back(technique.lights[i].visibility);
        const LightResult& light = truth.lights[i];
        const double share = shareDarkInTruthAlone(light.visibility, results, reachedPixels(light.reach));
        if (share <= suspiciousShare) continue;
        spdlog::warn(
            "light '{}': {:.1f} % of what it reaches is dark by the reference and lit by all {} techniques: "
            "the "
            "reference may be wrong there; look at its picture before you judge by it",
            light.light, 100 * share, results.size());
    }
}

/// All frames of the motion, every technique in each, so that each technique keeps what it keeps between
/// frames.
void measureFlicker(Workbench& workbench, const Scene& scene, const SceneMoment& moment, const Camera& camera,
                    PictureSize size, std::span<const Contender> contenders, const JudgeOptions& options,
                    ReferenceTechnique& reference, Comparison& comparison) {
    std::vector<std::unique_ptr<Technique>> techniques;
    for (const Contender& contender : contenders)
        techniques.push_back(makeSettled(workbench, contender, moment, camera, size));
    std::vector<std::vector<FlickerMeter>> meters(contenders.size(),
                                                  std::vector<FlickerMeter>(moment.lights.size()));
    for (int frame = 0; frame < flickerFrames; ++frame) {
        options.progress(double(frame) / flickerFrames, "flicker");
        const MovedFrame moved = movedFrame(scene, moment, camera, size, *options.flicker, frame);
        const TechniqueResult truth = workbench.run("reference", reference, moved.moment, moved.camera, size);
        for (std::size_t i = 0; i < techniques.size(); ++i) {
            const TechniqueResult result =
                workbench.run(contenders[i].label, *techniques[i], moved.moment, moved.camera, size);
            for (std::size_t k = 0; k < result.lights.size(); ++k) {
                meters[i][k].add(truth.lights[k].visibility, result.lights[k].visibility,
                                 reachedPixels(result.lights[k].reach));
            }
        }
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        for (std::size_t k = 0; k < moment.lights.size(); ++k)
            comparison.techniques[i].lights[k].flicker = meters[i][k].result();
    }
}

}  // namespace

MovedFrame movedFrame(const Scene& scene, const SceneMoment& start, const Camera& camera, PictureSize size,
                      FlickerMotion motion, int frame) {
    MovedFrame moved{start, camera};
    switch (motion) {
        case FlickerMotion::animation:
            moved.moment = scene.at(start.time_s + frame / framesPerSecond);
            // The camera may move, too: the one of the same place in the list.
            for (std::size_t i = 0; i < start.cameras.size(); ++i) {
                if (start.cameras[i].name == camera.name) moved.camera = moved.moment.cameras[i];
            }
            break;
        case FlickerMotion::camera: {
            const float pixel_rad = camera.yfov_rad / float(size.height_px);
            moved.camera.worldFromCamera =
                glm::rotate(camera.worldFromCamera, 0.5f * pixel_rad * float(frame), glm::vec3(0, 1, 0));
            break;
        }
        case FlickerMotion::light: {
            const float step_m = 0.002f * start.bounds.radius() * float(frame);
            for (Light& light : moved.moment.lights) {
                const glm::mat4 worldFromLight = fromPenumbra(light.shape.worldFromLight);
                // A distant light has no place: it turns by as much as one at the scene's radius would.
                light.shape.worldFromLight =
                    toPenumbra(light.shape.shape == LightShape::distant
                                   ? glm::rotate(worldFromLight, 0.002f * float(frame), glm::vec3(0, 1, 0))
                                   : glm::translate(worldFromLight, glm::vec3(step_m, 0, 0)));
            }
            break;
        }
    }
    return moved;
}

bool canJudge() {
    return true;
}

Comparison judge(Workbench& workbench, const Scene& scene, const SceneMoment& moment, const Camera& camera,
                 PictureSize size, std::span<const Contender> contenders, const JudgeOptions& options) {
    ReferenceTechnique reference;
    setParameter(reference, "samples", std::to_string(options.samples));
    reference.setProgress([&](double fraction) { options.progress(fraction, "reference"); });
    const TechniqueResult truth = workbench.run("reference", reference, moment, camera, size);
    reference.setProgress({});

    Comparison comparison{.width_px = size.width_px,
                          .height_px = size.height_px,
                          .renderer = workbench.renderer(),
                          .clock = std::string(workbench.clock().name()),
                          .reference = summarize(truth, options.samples)};
    for (const Contender& contender : contenders) {
        options.progress(double(comparison.techniques.size()) / double(contenders.size()), "techniques");
        const std::unique_ptr<Technique> technique = makeSettled(workbench, contender, moment, camera, size);
        comparison.techniques.push_back(compareOne(
            truth, workbench.run(contender.label, *technique, moment, camera, size, options.timedRuns)));
        options.inspect(contender, *technique);
    }
    doubtTruth(truth, comparison);
    if (options.flicker) {
        measureFlicker(workbench, scene, moment, camera, size, contenders, options, reference, comparison);
    }
    return comparison;
}

}  // namespace penumbra::studio
