// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/subdivision.h"

#include <algorithm>
#include <cstddef>

namespace penumbra::light_sampling {
namespace {

std::vector<std::string> file(const char* name) {
    return {std::string("src/techniques/light_sampling/") + name};
}

constexpr int quadsPictureSize_px = 257;

int latticeSize(int depth) {
    const int side = (1 << depth) + 1;
    return side * side;
}

}  // namespace

int SubdivisionOptions::baseDepth() const {
    int depth = std::min(minDepth, maxDepth);
    while (depth > 0 && latticeSize(depth) > maxSamples) --depth;
    return depth;
}

int SubdivisionOptions::mostSlots(int round) const {
    const int depth = baseDepth() + round;
    return std::min(maxSamples,
                    round == 0 ? latticeSize(depth) : latticeSize(depth) - latticeSize(depth - 1));
}

int SubdivisionOptions::mostCompared() const {
    return maxDepth == 0 ? 0 : latticeSize(maxDepth - 1);
}

int SubdivisionOptions::mostSlotsInAll() const {
    // Where the samples do not suffice for a single split all trees are the same.
    constexpr int newOfFirstSplit = 5;
    if (rounds() == 0 || latticeSize(baseDepth()) + newOfFirstSplit > maxSamples)
        return std::min(maxSamples, latticeSize(baseDepth()));
    return std::min(latticeVertices, maxSamples + std::min(maxSamples, latticeSize(deepestLevel - 1)));
}

SubdivisionPasses::SubdivisionPasses(Device& device)
    : decide_(internalsOf(device).shaders, file("decide.comp.glsl")),
      examine_(internalsOf(device).shaders, file("examine.comp.glsl")),
      weigh_(internalsOf(device).shaders, file("lattice_weights.comp.glsl")),
      illustrate_(internalsOf(device).shaders, file("illustrate.comp.glsl")),
      illustrateQuads_(internalsOf(device).shaders, file("illustrate_quads.comp.glsl")),
      compare_(device, file("compare.comp.glsl")),
      tree_(sizeof(Subdivision), "light subdivision") {
    for (Readback& readback : readbacks_) {
        readback.subdivision = gl::Buffer(sizeof(Subdivision), "light subdivision readback");
        readback.plan = gl::Buffer(sizeof(SamplingPlan), "light sampling plan readback");
    }
}

void SubdivisionPasses::prepare(int width_px, int height_px) {
    bits_.fit({.width_px = width_px,
               .height_px = height_px,
               .format = gl::Format::rgba32ui,
               .label = "shadow values of light samples"});
}

void SubdivisionPasses::start(const SampleMaps& maps, const SubdivisionOptions& options, bool isCoherent) {
    decide(maps, -1, options, isCoherent);
}

void SubdivisionPasses::decide(const SampleMaps& maps, int round, const SubdivisionOptions& options) {
    decide(maps, round, options, false);
}

void SubdivisionPasses::decide(const SampleMaps& maps, int round, const SubdivisionOptions& options,
                               bool isCoherent) {
    gl::Pass(decide_)
        .constants(DecideConstants{.target_px = {bits_.width_px(), bits_.height_px()},
                                   .round = round,
                                   .maxSamples = options.maxSamples,
                                   .tolerated = glm::uint(options.tolerated),
                                   .minDepth = options.minDepth,
                                   .maxDepth = options.maxDepth,
                                   .baseDepth = options.baseDepth(),
                                   .isCoherent = isCoherent,
                                   .isOneLevelARound = options.maxError > 0})
        .bind("SubdivisionBlock", tree_)
        .bind("Plan", maps.plan())
        .bind("Slots", maps.slots())
        .dispatch(1);
}

void SubdivisionPasses::compare(const ShadowInputs& inputs, const ViewBinding& view,
                                const SampleCameras& cameras, SampleMaps& maps,
                                const SubdivisionOptions& options, int stage, int batch,
                                const gl::Buffer* redraw) {
    maps.choose(stage, batch);
    gl::Pass pass(compare_.prepare(inputs.light, cameras, {}, {}));
    pass.constants(CompareConstants{.target_px = {bits_.width_px(), bits_.height_px()},
                                    .starts = batch == 0 && (stage == 0 || stage == stageOfCoarse),
                                    .baseDepth = options.baseDepth()})
        .bind(view)
        .bind(maps)
        .bind(compare_)
        .bind("shadowBits", bits_);
    if (redraw != nullptr) {
        pass.dispatchIndirect(*redraw, offsetof(RedrawGroups, pixels));
    } else {
        pass.dispatchIndirect(maps.plan(), offsetof(SamplingPlan, compareGroups));
    }
}

void SubdivisionPasses::examine(const SampleMaps* maps, const SubdivisionOptions& options) {
    gl::Pass pass(examine_);
    pass.constants(ExamineConstants{
                       .maxDepth = options.maxDepth,
                       .maxError = options.maxError,
                       .cellError = options.cellError,
                   })
        .bind(*this);
    if (maps != nullptr) {
        pass.dispatchIndirect(maps->plan(), offsetof(SamplingPlan, examineGroups));
    } else {
        pass.dispatch(std::size_t(bits_.width_px() + 15) / 16, std::size_t(bits_.height_px() + 15) / 16);
    }
}

void SubdivisionPasses::examine(const SampleMaps& maps, const SubdivisionOptions& options) {
    examine(&maps, options);
}

void SubdivisionPasses::examineError(const SubdivisionOptions& options) {
    examine(nullptr, options);
}

void SubdivisionPasses::weigh(const SampleMaps& maps, bool usesPaperWeights, const LatticeShares& shares,
                              bool isTextured) {
    gl::Pass(weigh_)
        .constants(LatticeWeightsConstants{
            .usesPaperWeights = usesPaperWeights, .isTextured = isTextured, .cellsPerSide = shares.perSide()})
        .bind("SubdivisionBlock", tree_)
        .bind("Samples", maps.samples())
        .bind("Cells", shares.buffer())
        .bind("Order", maps.order())
        .bind("Plan", maps.plan())
        .dispatch(1);
}

void SubdivisionPasses::requestReadback(const SampleMaps& maps) {
    newest_ = (newest_ + 1) % framesInFlight;
    Readback& readback = readbacks_[std::size_t(newest_)];
    tree_.copyTo(readback.subdivision, sizeof(Subdivision));
    maps.plan().copyTo(readback.plan, sizeof(SamplingPlan));
    readback.fence.set();
}

std::optional<SubdivisionPasses::Snapshot> SubdivisionPasses::latest() const {
    for (int i = 0; i < framesInFlight; ++i) {
        const Readback& readback = readbacks_[std::size_t((newest_ + framesInFlight - i) % framesInFlight)];
        if (!readback.fence.hasPassed()) continue;
        Snapshot snapshot;
        readback.subdivision.read(std::as_writable_bytes(std::span(&snapshot.subdivision, 1)));
        readback.plan.read(std::as_writable_bytes(std::span(&snapshot.plan, 1)));
        latest_ = snapshot;
        break;
    }
    return latest_;
}

void SubdivisionPasses::illustrate() const {
    gl::TextureSpec spec{.width_px = bits_.width_px(),
                         .height_px = bits_.height_px(),
                         .format = gl::Format::rgba8,
                         .label = "light sampling pictures"};
    sums_.fit(spec);
    failing_.fit(spec);
    spec.width_px = spec.height_px = quadsPictureSize_px;
    quads_.fit(spec);
    gl::Pass(illustrate_)
        .bind(*this)
        .bind("sumsPicture", sums_)
        .bind("failingPicture", failing_)
        .dispatchPixels(bits_.width_px(), bits_.height_px());
    gl::Pass(illustrateQuads_)
        .bind("SubdivisionBlock", tree_)
        .bind("picture", quads_)
        .dispatchPixels(quadsPictureSize_px, quadsPictureSize_px);
}

}  // namespace penumbra::light_sampling
