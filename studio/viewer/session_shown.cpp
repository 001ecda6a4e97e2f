// SPDX-License-Identifier: Apache-2.0
// What a session shows: the truth beside the picture, their errors, illuminance, and buffers.
#include <algorithm>
#include <cmath>

#include "studio/viewer/canvas_io.h"
#include "studio/viewer/session.h"
#include "studio/workbench/reference_inputs.h"

namespace penumbra::studio::viewer {
namespace {

/// Of illuminance: from what a few pixels in a hundred fall below to what next to none exceeds, on nice
/// levels. Where logarithmic at most four decades, else from 0.
ValueRange rangeThatShows(std::vector<float> lux, bool logarithmic) {
    std::erase_if(lux, [](float value) { return !(value > 0) || !std::isfinite(value); });
    if (lux.empty()) return niceRange(0, logarithmic);
    std::ranges::sort(lux);
    const auto at = [&](double share) { return lux[std::size_t(share * double(lux.size() - 1))]; };
    constexpr double low = 0.02, high = 0.995;
    ValueRange range = niceRange(at(high), logarithmic);
    if (!logarithmic) return range;
    constexpr float decades = 1e-4f, narrowest = 0.2f;
    const float least = std::clamp(at(low), decades * range.max, narrowest * range.max);
    const std::vector<float> below = niceLevels(0.1f * least, least);
    range.min = below.empty() ? least : below.back();
    return range;
}

/// A number for each line in about every hundredth part of the picture, so far apart that they can be read.
std::vector<IsolineNumber> numbersOn(const Image& levels) {
    constexpr int parts = 9;
    const int block = std::max({levels.width_px, levels.height_px, parts}) / parts;
    std::vector<IsolineNumber> numbers;
    for (int top = 0; top < levels.height_px; top += block) {
        for (int left = 0; left < levels.width_px; left += block) {
            const glm::vec2 middle(float(left) + 0.5f * float(block), float(top) + 0.5f * float(block));
            std::optional<IsolineNumber> nearest;
            float nearest_px = 0.5f * float(block);
            for (int y = top; y < std::min(top + block, levels.height_px); ++y) {
                for (int x = left; x < std::min(left + block, levels.width_px); ++x) {
                    if (levels.at(x, y) == noIsoline) continue;
                    const float distance_px = glm::distance(middle, glm::vec2(x, y));
                    if (distance_px >= nearest_px) continue;
                    nearest_px = distance_px;
                    nearest = IsolineNumber{x, y, levels.at(x, y)};
                }
            }
            const auto isNear = [&](const IsolineNumber& other) {
                return glm::distance(glm::vec2(other.x, other.y), glm::vec2(nearest->x, nearest->y)) <
                       0.6f * float(block);
            };
            if (nearest && std::ranges::none_of(numbers, isNear)) numbers.push_back(*nearest);
        }
    }
    return numbers;
}

class Collector final : public InspectionVisitor {
  public:
    void texture(const InspectedTexture& texture) override { textures.push_back(texture); }
    std::vector<InspectedTexture> textures;
};

}  // namespace

void Session::startReference() {
    referenceStale_ = false;
    if (!casters_ || castersRevision_ != document_->castersRevision()) {
        casters_ = std::make_shared<const CasterCopies>(document_->gpuScene().casters());
        castersRevision_ = document_->castersRevision();
    }
    ProgressiveReference::Request request{.casters = casters_,
                                          .receivers = readReceivers(frame_.gbuffer().view()),
                                          .maxSamples = choices_.referenceSamples};
    for (const Light& light : document_->moment().lights) {
        const ShadowInputs inputs = frame_.shadowInputs(light);
        request.lights.push_back(
            {inputs.light, readRadianceTexture(inputs.light.radianceTexture), light.castsShadow});
    }
    reference_.start(std::move(request));
}

bool Session::showsTruth(std::size_t side) const {
    const std::vector<LightStatistics>& lights = sides_.side(side).statistics;
    return std::ranges::count(lights, referenceName, &LightStatistics::technique) != 0;
}

bool Session::complete() const {
    const bool needsTruth = showsTruth(0) || (showsOther() && showsTruth(1));
    return !canvasStale_ && (!needsTruth || (truth_ && truth_->samples == choices_.referenceSamples));
}

void Session::takeTruth() {
    auto best = reference_.best();
    if (best == truth_ || !best) return;
    truth_ = std::move(best);
    for (std::size_t side = 0; side < 2; ++side) {
        if (!showsTruth(side)) continue;
        sideStale_[side] = true;
        canvasStale_ = true;
    }
    judge();
}

void Session::judge() {
    metrics_ = {};
    if (!truth_ || choices_.light >= truth_->lights.size()) return;
    const Image& truth = truth_->lights[choices_.light].visibility;
    for (std::size_t i = 0; i < 2; ++i) {
        const Side& side = sides_.side(i);
        if (sideStale_[i] || choices_.light >= side.visibilities.size()) continue;
        if (side.statistics[choices_.light].technique == referenceName) continue;
        const Image reach = readTexture(side.reach.name(), width_px_, height_px_, 1);
        std::vector<std::uint8_t> reached;
        for (const float irradiance : reach.values) reached.push_back(irradiance > 0);
        const VisibilityBuffer& visibility = side.visibilities[choices_.light];
        metrics_[i] = compareVisibility(truth, frame_.readVisibility(visibility), reached);
    }
}

bool Session::isCertain(double error) const {
    constexpr double share = 0.1;
    return truth_ && choices_.light < truth_->lights.size() &&
           truth_->lights[choices_.light].noise_rms < share * error;
}

CanvasOptions Session::canvasOptions() const {
    CanvasOptions options{.shown = choices_.shown, .isolines = choices_.isolines, .light = choices_.light};
    if (choices_.comparing) options.firstColumnOfB = int(std::lround(choices_.wipe * float(width_px_)));
    if (choices_.flipped) options.firstColumnOfB = 0;
    switch (choices_.shown) {
        case Shown::picture:
        case Shown::visibility:
            break;
        case Shown::difference:
        case Shown::error:
            options.range.max = choices_.differenceRange;
            break;
        case Shown::illuminance:
            options.logarithmic = choices_.logarithmic;
            options.range =
                choices_.largestLux > 0
                    ? ValueRange{choices_.logarithmic ? 1e-3f * choices_.largestLux : 0, choices_.largestLux}
                    : fittedLux_.value_or(niceRange(0, choices_.logarithmic));
            break;
    }
    return options;
}

void Session::compose() {
    const Side& a = sides_.side(0);
    const Side& b = showsOther() ? sides_.side(1) : a;
    if (choices_.shown == Shown::illuminance && choices_.largestLux <= 0 && !fittedLux_)
        fittedLux_ = rangeThatShows(readTexture(a.illuminance.name(), width_px_, height_px_, 1).values,
                                    choices_.logarithmic);
    canvas_.compose(frame_, a, b, canvasOptions());
    numberIsolines();
}

void Session::numberIsolines() {
    isolineNumbers_.clear();
    if (choices_.shown != Shown::illuminance || !choices_.isolines) return;
    const Image levels = readTexture(canvas_.isolines().name(), width_px_, height_px_, 1);
    isolineNumbers_ = numbersOn(levels);
}

std::vector<InspectedTexture> Session::inspected() {
    Collector collector;
    const Side& a = sides_.side(0);
    if (choices_.light < a.visibilities.size()) {
        collector.texture({.name = "visibility", .texture = a.visibilities[choices_.light].texture()});
        collector.texture({.name = "reach (unshadowed irradiance)", .texture = a.reach.name()});
    }
    const GBuffer& gbuffer = frame_.gbuffer();
    collector.texture({.name = "normals", .texture = gbuffer.view().normalTexture, .black = -1});
    collector.texture({.name = "albedo", .texture = gbuffer.albedo().name()});
    collector.texture({.name = "depth (reversed)", .texture = gbuffer.view().depthTexture});
    if (choices_.light < a.statistics.size()) {
        const std::string& name = a.statistics[choices_.light].technique;
        if (name != referenceName) techniques_.get(name).inspect(collector);
    }
    return collector.textures;
}

void Session::inspect(const InspectedTexture& texture, int layer, bool stretched) {
    inspection_.inspect(texture, std::clamp(layer, 0, texture.layers - 1), stretched);
}

}  // namespace penumbra::studio::viewer
