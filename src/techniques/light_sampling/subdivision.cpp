// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/subdivision.h"

#include <algorithm>
#include <cstddef>

namespace penumbra {
namespace {

void bindStorage(GLuint binding, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

std::vector<std::string> file(const char* name) {
    return {std::string("src/techniques/light_sampling/") + name};
}

void resize(gl::Texture& texture, int width_px, int height_px, gl::Format format, std::string_view label) {
    if (texture.width_px() == width_px && texture.height_px() == height_px && texture.name() != 0) return;
    texture = {};
    texture = gl::Texture({.width_px = width_px, .height_px = height_px, .format = format, .label = label});
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

int SubdivisionOptions::mostSlotsInAll() const {
    return std::min(latticeVertices, maxSamples + std::min(maxSamples, latticeSize(deepestLevel - 1)));
}

SubdivisionPasses::SubdivisionPasses(Device& device)
    : decide_(device.internals().shaders, file("decide.comp.glsl")),
      examine_(device.internals().shaders, file("examine.comp.glsl")),
      weigh_(device.internals().shaders, file("lattice_weights.comp.glsl")),
      illustrate_(device.internals().shaders, file("illustrate.comp.glsl")),
      illustrateQuads_(device.internals().shaders, file("illustrate_quads.comp.glsl")),
      compare_(device, file("compare.comp.glsl").front()),
      tree_(sizeof(Subdivision), "light subdivision") {
    for (Readback& readback : readbacks_) {
        readback.subdivision = gl::Buffer(sizeof(Subdivision), "light subdivision readback");
        readback.plan = gl::Buffer(sizeof(SamplingPlan), "light sampling plan readback");
    }
}

void SubdivisionPasses::prepare(int width_px, int height_px) {
    resize(bits_, width_px, height_px, gl::Format::rgba32ui, "shadow values of light samples");
}

void SubdivisionPasses::start(const SampleMaps& maps, const SubdivisionOptions& options, bool isCoherent) {
    decide(maps, -1, options, isCoherent);
}

void SubdivisionPasses::decide(const SampleMaps& maps, int round, const SubdivisionOptions& options) {
    decide(maps, round, options, false);
}

void SubdivisionPasses::decide(const SampleMaps& maps, int round, const SubdivisionOptions& options,
                               bool isCoherent) {
    decide_.use();
    bindStorage(0, tree_);
    bindStorage(1, maps.plan());
    bindStorage(2, maps.slots());
    glUniform1i(0, round);
    glUniform1i(1, options.maxSamples);
    glUniform1ui(2, GLuint(options.tolerated));
    glUniform1i(3, options.minDepth);
    glUniform1i(4, options.maxDepth);
    glUniform1i(5, options.baseDepth());
    glUniform1i(6, isCoherent);
    glUniform1i(7, options.maxError > 0);
    glUniform2i(8, bits_.width_px(), bits_.height_px());
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SubdivisionPasses::compare(const ShadowInputs& inputs, const SampleCameras& cameras,
                                const SampleMaps& maps, const SubdivisionOptions& options, int stage,
                                int batch) {
    compare_.use(inputs.light, cameras, {}, {});
    maps.bind();
    maps.setBatch(stage, batch);
    bits_.bindImage(0, GL_READ_WRITE);
    glUniform2i(16, bits_.width_px(), bits_.height_px());
    glUniform1i(17, batch == 0 && (stage == 0 || stage == stageOfCoarse));
    glUniform1i(18, options.baseDepth());
    if (stage == stageOfCoarse) {
        gl::dispatchPixels(bits_.width_px(), bits_.height_px());
    } else {
        gl::dispatchIndirect(maps.plan(), offsetof(SamplingPlan, compareGroups));
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SubdivisionPasses::prepareExamination(const SubdivisionOptions& options) {
    examine_.use();
    bits_.bind(0);
    bindStorage(0, tree_);
    glUniform1i(0, options.maxDepth);
    glUniform1f(1, options.maxError);
    glUniform1f(2, options.cellError);
}

void SubdivisionPasses::examine(const SampleMaps& maps, const SubdivisionOptions& options) {
    prepareExamination(options);
    gl::dispatchIndirect(maps.plan(), offsetof(SamplingPlan, examineGroups));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SubdivisionPasses::examineError(const SubdivisionOptions& options) {
    prepareExamination(options);
    glDispatchCompute(GLuint(bits_.width_px() + 15) / 16, GLuint(bits_.height_px() + 15) / 16, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SubdivisionPasses::bind(GLuint unit, GLuint block) const {
    bits_.bind(unit);
    bindStorage(block, tree_);
}

void SubdivisionPasses::weigh(const SampleMaps& maps, bool usesPaperWeights, const gl::Buffer* cellShares) {
    weigh_.use();
    bindStorage(0, tree_);
    bindStorage(1, maps.samples());
    bindStorage(2, cellShares != nullptr ? *cellShares : maps.plan());
    bindStorage(3, maps.order());
    bindStorage(4, maps.plan());
    glUniform1i(0, usesPaperWeights);
    glUniform1i(1, cellShares != nullptr);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SubdivisionPasses::requestReadback(const SampleMaps& maps) {
    newest_ = (newest_ + 1) % framesInFlight;
    Readback& readback = readbacks_[std::size_t(newest_)];
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(tree_.name(), readback.subdivision.name(), 0, 0, sizeof(Subdivision));
    glCopyNamedBufferSubData(maps.plan().name(), readback.plan.name(), 0, 0, sizeof(SamplingPlan));
    readback.fence.set(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
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
    resize(sums_, bits_.width_px(), bits_.height_px(), gl::Format::rgba8, "light sampling sums");
    resize(failing_, bits_.width_px(), bits_.height_px(), gl::Format::rgba8,
           "light sampling failing fragments");
    resize(quads_, quadsPictureSize_px, quadsPictureSize_px, gl::Format::rgba8, "light sampling quads");
    illustrate_.use();
    bits_.bind(0);
    bindStorage(0, tree_);
    sums_.bindImage(0, GL_WRITE_ONLY);
    failing_.bindImage(1, GL_WRITE_ONLY);
    gl::dispatchPixels(bits_.width_px(), bits_.height_px());
    illustrateQuads_.use();
    quads_.bindImage(0, GL_WRITE_ONLY);
    gl::dispatchPixels(quadsPictureSize_px, quadsPictureSize_px);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace penumbra
