// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/reference_technique.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "studio/workbench/reference_inputs.h"
#include "studio/workbench/studio_techniques.h"

namespace penumbra::studio {
namespace {

constexpr std::array<std::string_view, 2> weightNames = {"area", "irradiance"};

/// Of each pixel, what its rays would be within in 999 of 1,000 if they were independent (a normal deviation
/// of 3.29 times the binomial one). They are spread more evenly than that, and are nearer. Bottom row first.
std::vector<float> errorBounds(const Image& visibility, int samples) {
    constexpr float deviations = 3.29f;
    std::vector<float> bounds;
    for (int y = visibility.height_px; y-- > 0;) {
        for (int x = 0; x < visibility.width_px; ++x) {
            float variance = 0;
            for (int c = 0; c < visibility.channels; ++c) {
                const float seen = visibility.at(x, y, c);
                variance = std::max(variance, seen * (1 - seen));
            }
            bounds.push_back(deviations * std::sqrt(variance / float(samples)));
        }
    }
    return bounds;
}

}  // namespace

std::span<const StudioTechnique> studioTechniques() {
    static constexpr StudioTechnique techniques[] = {
        {{"reference", "ray tracing (Embree): the truth, up to its stated noise"},
         []() -> std::unique_ptr<Technique> { return std::make_unique<ReferenceTechnique>(); }}};
    return techniques;
}

void ReferenceTechnique::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "samples", .unit = "rays", .help = "rays for each pixel"}, samples_, {2, 65536});
    visitor.integer({.name = "seed", .help = "chooses the sampling pattern"}, seed_, {0, 1 << 30});
    visitor.choice(
        {.name = "weight", .help = "what a part of the light counts by: its area, or its irradiance"},
        weight_, weightNames);
    visitor.boolean({.name = "cache", .help = "keep traces on disk and use them again"}, cached_);
}

void ReferenceTechnique::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    if (inputs.view.normalTexture == 0) {
        throw Error(Error::Kind::badArgument, "reference: View::normalTexture is missing");
    }
    const ReferenceScene scene = CasterCopies(inputs.casters).makeScene();
    const std::optional<RadianceTexture> radiance = readRadianceTexture(inputs.light.radianceTexture);
    ReferenceCache cache(cached_ ? ReferenceCache::defaultFolder() : std::filesystem::path());
    last_ = cache.trace(scene, readReceivers(inputs.view), inputs.light, radiance ? &*radiance : nullptr,
                        {.samples = samples_,
                         .seed = std::uint32_t(seed_),
                         .weight = ReferenceOptions::Weight(weight_),
                         .progress = progress_});
    writeVisibility(last_.visibility, out);
    errorBound_.fit({.width_px = out.width_px(),
                     .height_px = out.height_px(),
                     .format = gl::Format::r32f,
                     .label = "reference/error bound"});
    const std::vector<float> bounds = errorBounds(last_.visibility, samples_);
    errorBound_.write(std::as_bytes(std::span(bounds)));
}

void ReferenceTechnique::inspect(InspectionVisitor& visitor) const {
    if (errorBound_.name() != 0) visitor.texture({.name = "error bound", .texture = errorBound_.name()});
}

Statistics ReferenceTechnique::statistics() const {
    return {.counts = {{"samples", double(samples_)},
                       {"noise_rms", last_.noise_rms},
                       {"rays", double(last_.rays)},
                       {"trace_seconds", last_.seconds, "s"}},
            .passes = {{"reference/trace", 1e3 * last_.seconds}}};
}

}  // namespace penumbra::studio
