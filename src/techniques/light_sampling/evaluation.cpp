// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/evaluation.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "src/techniques/light_sampling/subdivision.h"

namespace penumbra::light_sampling {

void EvaluationOptions::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> paths = {"array", "accumulation"};
    static constexpr std::array<std::string_view, 2> weightings = {"area", "irradiance"};
    visitor.choice(
        {.name = "evaluation", .help = "all maps of a batch in one pass, or an accumulation pass a map"},
        path, paths);
    visitor.integer(
        {.name = "filter", .unit = "texels", .help = "side of the kernel that smooths each map; 1: none"},
        filter, {1, 3});
    visitor.choice(
        {.name = "weight", .help = "what a part of the light counts by: its area, or its irradiance"},
        weighting, weightings);
}

SampleLookup::SampleLookup(Device& device, std::vector<std::string> files)
    : device_(internalsOf(device)), files_(std::move(files)), constants_("light sampling lookups") {}

std::vector<std::string> SampleLookup::Variant::defines() const {
    std::vector<std::string> defines = {"FILTER " + std::to_string(filter)};
    if (features.colored) defines.push_back("COLORED");
    if (features.bits) defines.push_back("BITS");
    if (features.smooth) defines.push_back("SMOOTH");
    if (features.partial) defines.push_back("PARTIAL");
    if (features.kept) defines.push_back("KEPT");
    if (distant) defines.push_back("DISTANT");
    if (sphere) defines.push_back("SPHERE");
    if (cube) defines.push_back("CUBE");
    if (box) defines.push_back("BOX_KERNEL");
    if (volume) defines.push_back("VOLUME");
    return defines;
}

const gl::Program& SampleLookup::prepare(const AreaLight& light, const SampleCameras& cameras,
                                         const EvaluationOptions& options, const Features& features) {
    const bool isBall = light.shape == LightShape::sphere && light.radius_m > 0;
    const Variant variant{.features = features,
                          .filter = options.filter,
                          .distant = light.shape == LightShape::distant,
                          .sphere = isBall && !options.emitsThroughout,
                          .cube = cameras.isCube,
                          .box = options.hasBoxKernel,
                          .volume = isBall && options.emitsThroughout};
    auto found = programs_.find(variant);
    if (found == programs_.end()) {
        found = programs_.emplace(variant, gl::Program(device_.shaders, files_, variant.defines())).first;
    }
    LookupConstants constants{.light = lightConstants(light),
                              .near_m = float(cameras.near_m),
                              .far_m = float(cameras.far_m),
                              .isWeightedByIrradiance = options.weighting == 1};
    for (std::size_t i = 0; i < cameras.faceFromLight.size(); ++i) {
        constants.faceFromLight[i] = glm::mat4(glm::mat3(cameras.faceFromLight[i]));
    }
    constants_.write(constants);
    return found->second;
}

SampleEvaluation::SampleEvaluation(Device& device)
    : lookup_(device, {"src/techniques/light_sampling/evaluate.comp.glsl"}),
      restore_(internalsOf(device).shaders, {"src/techniques/common/restore.comp.glsl"}) {}

void SampleEvaluation::restore(VisibilityBuffer& out) {
    gl::Pass(restore_)
        .bind("kept", kept_)
        .bind("visibility", imageOf(out))
        .dispatchPixels(out.width_px(), out.height_px());
}

void SampleEvaluation::add(const ShadowInputs& inputs, const ViewBinding& view, const SampleCameras& cameras,
                           const EvaluationOptions& options, SampleMaps& maps, const Batch& batch,
                           VisibilityBuffer& out) {
    const bool byPass = options.path == EvaluationOptions::accumulation && batch.mostSlots > 1;
    const bool isPartial = byPass || !batch.isOnlyOne;
    const gl::TextureSpec spec{.width_px = out.width_px(),
                               .height_px = out.height_px(),
                               .format = out.colored() ? gl::Format::rgba32f : gl::Format::r32f,
                               .label = "light sampling accumulation"};
    if (isPartial) {
        seen_.fit(spec);
        whole_.fit(spec);
    }
    if (batch.isKept) kept_.fit(spec);
    maps.choose(batch.stage, batch.batch);
    gl::Pass pass(lookup_.prepare(inputs.light, cameras, options,
                                  {.colored = out.colored(),
                                   .bits = batch.bits != nullptr,
                                   .smooth = batch.taps > 0,
                                   .partial = isPartial,
                                   .kept = batch.isKept}));
    pass.bind(view).bind(maps).bind(lookup_).bind("visibility", imageOf(out));
    if (batch.bits != nullptr) pass.bind(*batch.bits);
    if (isPartial) pass.bind("seenSoFar", seen_).bind("wholeSoFar", whole_).inOrder();
    if (batch.isKept) pass.bind("kept", kept_);
    const int step = byPass ? 1 : batch.mostSlots;
    for (int slot = 0; slot < batch.mostSlots; slot += step) {
        pass.constants(EvaluateConstants{.firstSlot = slot, .endSlot = slot + step, .taps = batch.taps});
        if (batch.redraw != nullptr) {
            pass.dispatchIndirect(*batch.redraw, offsetof(RedrawGroups, pixels));
        } else {
            pass.dispatchPixels(out.width_px(), out.height_px());
        }
    }
}

void LatticeShares::set(bool hasCorners) {
    const int perSide = 2 * (hasCorners ? latticeSide - 1 : latticeSide);
    if (perSide == perSide_) return;
    perSide_ = perSide;
    cells_.clear();
    for (const PatternPoint& cell : makePattern(SamplePattern::cells, perSide, 0, false))
        cells_.emplace_back(glm::vec2(cell.cellMin), glm::vec2(cell.cellMax));
    LightSample share{};
    setShare(share, 1.0f / float(cells_.size()));
    const std::vector<LightSample> shares(cells_.size(), share);
    shares_ = gl::Buffer(std::as_bytes(std::span(shares)), "light sampling cell shares");
}

RadianceWeights::RadianceWeights(Device& device)
    : program_(internalsOf(device).shaders, {"src/techniques/light_sampling/weigh.comp.glsl"}),
      cells_("light sampling cells") {}

void RadianceWeights::weigh(GLuint radianceTexture, std::span<const glm::vec4> cells,
                            const gl::Buffer& samples) {
    cells_.write(cells);
    gl::Pass(program_)
        .constants(WeighConstants{.count = int(cells.size())})
        .bind("radiance", gl::TextureRef{.name = radianceTexture})
        .bind("Cells", cells_)
        .bind("Samples", samples)
        .dispatch((cells.size() + 63) / 64);
}

}  // namespace penumbra::light_sampling
