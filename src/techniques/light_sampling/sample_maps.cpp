// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/sample_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

#include "src/gl/raster_state.h"

namespace penumbra {
namespace {

constexpr const char* vertexShader = "src/techniques/light_sampling/sample_map.vert.glsl";
constexpr const char* fragmentShader = "src/techniques/light_sampling/sample_map.frag.glsl";

std::vector<std::string> variant(const Device::Internals& device, bool masked = false) {
    std::vector<std::string> defines;
    if (!device.layerFromVertexShader) defines.push_back("LAYER_BY_LAYER");
    if (masked) defines.push_back("MASKED");
    return defines;
}

GLuint createVertexArray() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return name;
}

void grow(gl::Buffer& buffer, std::size_t size_bytes, std::string_view label) {
    if (buffer.size_bytes() < size_bytes || buffer.name() == 0) buffer = gl::Buffer(size_bytes, label);
}

template <typename T>
void upload(gl::Buffer& buffer, std::span<const T> values, std::string_view label) {
    grow(buffer, values.size_bytes(), label);
    if (!values.empty()) buffer.write(std::as_bytes(values));
}

const void* commandAt(std::size_t index) {
    return reinterpret_cast<const void*>(index * sizeof(DrawCommand));  // NOLINT: an offset, as GL wants it
}

void bindStorage(GLuint binding, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

void bindInOrder(std::initializer_list<const gl::Buffer*> buffers) {
    GLuint binding = 0;
    for (const gl::Buffer* buffer : buffers) bindStorage(binding++, *buffer);
}

}  // namespace

SampleMaps::SampleMaps(Device& device)
    : device_(device.internals()),
      opaque_(device_.shaders, {vertexShader}, variant(device_)),
      masked_(device_.shaders, {vertexShader, fragmentShader}, variant(device_, true)),
      placeLayers_(device_.shaders, {"src/techniques/light_sampling/place_layers.comp.glsl"}),
      gather_(device_.shaders, {"src/techniques/light_sampling/gather.comp.glsl"}, variant(device_)),
      clear_(device_.shaders, {"src/techniques/light_sampling/clear.vert.glsl"}, variant(device_)),
      vertices_(gl::makeFloatVertexArray(3, 2)),
      noVertices_(createVertexArray()),
      plan_(sizeof(SamplingPlan), "light sampling plan") {}

void SampleMaps::allocate(int mapSize_px, int layers) {
    if (maps_.width_px() == mapSize_px && maps_.layers() >= layers) return;
    maps_ = {};  // freed first, so that the two need not fit together
    maps_ = gl::Texture({.width_px = mapSize_px,
                         .height_px = mapSize_px,
                         .layers = layers,
                         .format = gl::Format::depth32f,
                         .label = "maps of light samples"});
    framebuffer_ = gl::Framebuffer({}, &maps_, "maps of light samples");
}

void SampleMaps::prepare(std::span<const Caster> casters, const LightSpaceScene& scene,
                         std::span<const LightSample> samples, const SampleCameras& cameras, int mapSize_px,
                         int expectedSamples) {
    if (mapSize_px > device_.maxTextureSize_px) {
        throw Error(Error::Kind::badArgument, "maps of " + std::to_string(mapSize_px) +
                                                  " texels squared are more than this device allows (" +
                                                  std::to_string(device_.maxTextureSize_px) + ")");
    }
    casters_ = casters;
    mapSize_px_ = mapSize_px;
    faces_ = cameras.faces;
    const int facesInMemory = std::max(1, faces_);
    const double map_bytes = 4.0 * mapSize_px * mapSize_px;
    const int mostLayers = int(std::clamp(std::floor(memory_bytes / map_bytes), double(facesInMemory),
                                          double(std::max(facesInMemory, device_.maxLayers))));
    capacity_ = std::clamp(mostLayers / facesInMemory, 1, std::max(1, expectedSamples));
    resident_ = capacity_ >= expectedSamples;
    allocate(mapSize_px, capacity_ * facesInMemory);

    boxes_.clear();
    constants_.clear();
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const BoxCorners& corners = scene.boxes[i];
        CullBox& box = boxes_.emplace_back();
        const bool draws = casters[i].casts && !std::isnan(corners[0].x);
        for (std::size_t j = 0; draws && j < 8; ++j) box.corners[j] = glm::vec4(glm::vec3(corners[j]), 1);
        box.draw = {draws ? glm::uint(casters[i].mesh->indices().size()) : 0u, 0, 0, 0};
        const AlphaMask& mask = casters[i].alphaMask;
        constants_.push_back({.lightFromMesh = scene.lightFromMesh[i],
                              .alphaFactor = mask.factor,
                              .alphaCutoff = mask.cutoff});
    }
    upload<CullBox>(cullBoxes_, boxes_, "light sampling boxes");
    upload<CasterConstants>(casterConstants_, constants_, "light sampling casters");
    upload(samples_, samples, "light samples");
    upload<SampleCamera>(cameras_, cameras.cameras, "cameras of light samples");

    const auto layers = std::size_t(capacity_ * facesInMemory);
    const std::size_t casterLayers = layers * (casters.size() + 1);  // one more list for clearing
    identity_.resize(samples.size());
    std::iota(identity_.begin(), identity_.end(), 0);
    grow(slots_, samples.size() * sizeof(int), "slots of light samples");
    grow(order_, samples.size() * sizeof(int), "order of light samples");
    grow(layerCameras_, layers * sizeof(LightCameraConstants), "light sampling layer cameras");
    grow(layerTaps_, layers * sizeof(LayerTap), "light sampling layer taps");
    grow(layerMasks_, layers * sizeof(LayerMask), "light sampling layer masks");
    grow(layerLists_, casterLayers * sizeof(int), "light sampling layer lists");
    grow(commands_, (device_.layerFromVertexShader ? casters.size() + 1 : casterLayers) * sizeof(DrawCommand),
         "light sampling draws");
}

void SampleMaps::planAll() {
    SamplingPlan plan{};
    const int count = int(identity_.size());
    plan.stages[stageOfAll] = {0, count, 1, 1};
    plan.evaluated.x = count;
    plan_.write(std::as_bytes(std::span(&plan, 1)));
    slots_.write(std::as_bytes(std::span(identity_)));
    order_.write(std::as_bytes(std::span(identity_)));
}

void SampleMaps::setBatch(int stage, int batch) const {
    glUniform1i(0, stage);
    glUniform1i(1, batch * capacity_);
    glUniform1i(2, capacity_);
    glUniform1i(3, faces_);
    glUniform1i(4, resident_);
}

void SampleMaps::bind() const {
    maps_.bind(3);
    bindStorage(0, plan_);
    bindStorage(1, slots_);
    bindStorage(2, samples_);
    bindStorage(3, layerTaps_);
    bindStorage(4, order_);
}

void SampleMaps::placeLayers(int stage, int batch, const SampleCameras& cameras, const Needs& needs) {
    placeLayers_.use();
    setBatch(stage, batch);
    glUniform1i(5, needs.tiles != nullptr ? needs.tileCount : -1);
    glUniform1i(6, cameras.isCube);
    glUniform1f(7, needs.reach);
    glUniform1f(8, float(cameras.nearestBlocker_m));
    glUniform1i(9, mapSize_px_);
    const glm::mat3 faceFromLight(cameras.faceFromLight[0]);
    glUniformMatrix3fv(10, 1, GL_FALSE, &faceFromLight[0][0]);
    glUniform1i(13, needs.asksByQuads);
    const gl::Buffer& tiles = needs.tiles != nullptr ? *needs.tiles : plan_;
    bindInOrder({&plan_, &slots_, &cameras_, &samples_, &tiles, &layerTaps_, &layerCameras_, &layerMasks_});
    if (needs.redraw != nullptr) {
        gl::dispatchIndirect(*needs.redraw, offsetof(RedrawGroups, slots));
    } else {
        constexpr std::size_t countInStage = sizeof(int);
        gl::dispatchIndirect(plan_, std::size_t(stage) * sizeof(glm::ivec4) + countInStage);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SampleMaps::listLayers(int stage, int batch, const Needs& needs) {
    gather_.use();
    setBatch(stage, batch);
    glUniform1i(5, int(casters_.size()));
    glUniform1i(6, capacity_ * faces_);
    glUniform1i(7, needs.redraw != nullptr);
    const gl::Buffer& redraw = needs.redraw != nullptr ? *needs.redraw : plan_;
    bindInOrder({&plan_, &layerCameras_, &layerMasks_, &cullBoxes_, &layerLists_, &commands_, &redraw});
    glDispatchCompute(GLuint(casters_.size()) + 1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SampleMaps::draw(int stage, int batch, const SampleCameras& cameras, const Needs& needs) {
    if (faces_ == 0) return;
    placeLayers(stage, batch, cameras, needs);
    listLayers(stage, batch, needs);
    const auto layers = std::size_t(capacity_ * faces_);
    bindInOrder({&layerCameras_, &casterConstants_, &layerLists_, &layerMasks_});
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
    // In one go where the vertex shader chooses the layer, else layer by layer.
    const std::size_t rounds = device_.layerFromVertexShader ? 1 : layers;
    gl::RasterState state{
        .width_px = mapSize_px_, .height_px = mapSize_px_, .depthWrite = true, .colorWrite = false};
    for (std::size_t round = 0; round < rounds; ++round) {
        if (rounds > 1) framebuffer_.attachDepthLayer(maps_, int(round));
        // Only what is needed of the layers of this batch is cleared: what that is, the device alone may
        // know.
        state.depthTest = gl::Compare::always;
        gl::beginPass(framebuffer_.name(), state);
        glBindVertexArray(noVertices_.name());
        clear_.use();
        const std::size_t clearing = casters_.size() * rounds + round;
        glUniform1i(1, int(device_.layerFromVertexShader ? casters_.size() * layers : clearing));
        glDrawArraysIndirect(GL_TRIANGLES, commandAt(clearing));
        state.depthTest = gl::Compare::greater;
        gl::beginPass(framebuffer_.name(), state);
        glBindVertexArray(vertices_.name());
        for (std::size_t i = 0; i < casters_.size(); ++i) drawCaster(i, i * rounds + round);
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void SampleMaps::drawCaster(std::size_t caster, std::size_t command) const {
    const Mesh& mesh = *casters_[caster].mesh;
    if (boxes_[caster].draw.x == 0) return;
    const AlphaMask& mask = casters_[caster].alphaMask;
    (mask.texture != 0 ? masked_ : opaque_).use();
    gl::attachFloats(vertices_.name(), 0, mesh.positionBuffer(), 3);
    gl::attachFloats(vertices_.name(), 1, mesh.uvBuffer(), 2);
    glVertexArrayElementBuffer(vertices_.name(), mesh.indexBuffer());
    if (mask.texture != 0) glBindTextureUnit(0, mask.texture);
    const auto layers = std::size_t(capacity_ * faces_);
    glUniform1i(0, int(caster));
    glUniform1i(1, int(device_.layerFromVertexShader ? caster * layers : command));
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, commandAt(command));
}

}  // namespace penumbra
