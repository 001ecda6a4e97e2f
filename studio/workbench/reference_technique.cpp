// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/reference_technique.h"

#include <array>

#include "studio/workbench/reference_inputs.h"
#include "studio/workbench/studio_techniques.h"

namespace penumbra::studio {
namespace {

constexpr std::array<std::string_view, 2> weightNames = {"area", "irradiance"};

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
}

Statistics ReferenceTechnique::statistics() const {
    return {.counts = {{"samples", double(samples_)},
                       {"noise_rms", last_.noise_rms},
                       {"rays", double(last_.rays)},
                       {"trace_seconds", last_.seconds, "s"}},
            .passes = {{"reference/trace", 1e3 * last_.seconds}}};
}

}  // namespace penumbra::studio
