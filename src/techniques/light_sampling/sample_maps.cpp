// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/sample_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

namespace penumbra::light_sampling {
namespace {

/// Fewer than that at a time are not worth the passes.
constexpr int leastBatch = 16;

constexpr const char* vertexShader = "src/techniques/common/depth_map.vert.glsl";
constexpr const char* fragmentShader = "src/techniques/common/depth_map.frag.glsl";

std::vector<std::string> variant(const Device::Internals& device, bool masked = false) {
    std::vector<std::string> defines;
    if (!device.layerFromVertexShader) defines.push_back("LAYER_BY_LAYER");
    if (masked) defines.push_back("MASKED");
    return defines;
}

template <typename T>
void upload(gl::Buffer& buffer, std::span<const T> values, std::string_view label) {
    buffer.reserve(values.size_bytes(), label);
    if (!values.empty()) buffer.write(std::as_bytes(values));
}

}  // namespace

SampleMaps::SampleMaps(Device& device)
    : device_(internalsOf(device)),
      opaque_(device_.shaders, {vertexShader}, variant(device_)),
      masked_(device_.shaders, {vertexShader, fragmentShader}, variant(device_, true)),
      placeLayers_(device_.shaders, {"src/techniques/light_sampling/place_layers.comp.glsl"}),
      gather_(device_.shaders, {"src/techniques/light_sampling/gather.comp.glsl"}, variant(device_)),
      clear_(device_.shaders, {"src/techniques/light_sampling/clear.vert.glsl"}, variant(device_)),
      batch_("light sampling batch"),
      plan_(sizeof(SamplingPlan), "light sampling plan") {}

void SampleMaps::prepare(std::span<const Caster> casters, const LightSpaceScene& scene,
                         std::span<const LightSample> samples, const SampleCameras& cameras, int mapSize_px,
                         const Room& room) {
    if (mapSize_px > device_.maxTextureSize_px) {
        throw Error(Error::Kind::badArgument, "maps of " + std::to_string(mapSize_px) +
                                                  " texels squared are more than this device allows (" +
                                                  std::to_string(device_.maxTextureSize_px) + ")");
    }
    casters_ = casters;
    light_ = scene.light;
    mapSize_px_ = mapSize_px;
    faces_ = cameras.faces;
    const int facesInMemory = std::max(1, faces_);
    const double map_bytes = texel_bytes * mapSize_px * mapSize_px;
    const int mostLayers = int(std::clamp(std::floor(room.memory_bytes / map_bytes), double(facesInMemory),
                                          double(std::max(facesInMemory, device_.maxLayers))));
    room_ = room;
    capacity_ = std::clamp(mostLayers / facesInMemory, 1, std::max(1, room.samples));
    if (room.staysWithin) room_.samples = capacity_;
    resident_ = isWhole() || capacity_ >= room.compared + leastBatch;
    maps_.fit({.width_px = mapSize_px,
               .height_px = mapSize_px,
               .layers = capacity_ * facesInMemory,
               .format = gl::Format::depth32f,
               .label = "maps of light samples"});
    framebuffer_.fit({}, &maps_, "maps of light samples");

    boxes_.clear();
    constants_.clear();
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const BoxCorners& corners = scene.boxes[i];
        CullBox& box = boxes_.emplace_back();
        const bool draws = casters[i].casts && !std::isnan(corners[0].x);
        for (std::size_t j = 0; draws && j < 8; ++j) box.corners[j] = glm::vec4(glm::vec3(corners[j]), 1);
        box.indexCount = draws ? glm::uint(casters[i].mesh->indices().size()) : 0u;
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
    slots_.reserve(samples.size() * sizeof(int), "slots of light samples");
    order_.reserve(samples.size() * sizeof(int), "order of light samples");
    layerCameras_.reserve(layers * sizeof(LightCameraConstants), "light sampling layer cameras");
    layerTaps_.reserve(layers * sizeof(LayerTap), "light sampling layer taps");
    layerMasks_.reserve(layers * sizeof(LayerMask), "light sampling layer masks");
    instances_.reserve(casterLayers * sizeof(glm::ivec2), "light sampling instances");
    commands_.reserve(
        (device_.layerFromVertexShader ? casters.size() + 1 : casterLayers) * sizeof(DrawCommand),
        "light sampling draws");
}

void SampleMaps::plan(std::span<const int> sampleOfSlot, int first) {
    SamplingPlan plan{};
    const int count = int(sampleOfSlot.size());
    plan.stages[0] = {first, count - first, 1, 1};
    plan.stages[stageOfAll] = {0, count, 1, 1};
    plan.evaluated.x = count;
    plan_.write(std::as_bytes(std::span(&plan, 1)));
    slots_.write(std::as_bytes(sampleOfSlot));
    order_.write(std::as_bytes(std::span(identity_)));
}

int SampleMaps::batchesOfDeepest(int mostSlots) const {
    if (isWhole()) return 1;
    const int inBatch = resident_ ? capacity_ - room_.compared : capacity_;
    return std::max(1, (mostSlots + inBatch - 1) / inBatch);
}

void SampleMaps::choose(int stage, int batch) {
    batch_.write({.stage = stage,
                  .index = batch,
                  .capacity = capacity_,
                  .faces = faces_,
                  .isResident = resident_ && (stage != stageOfAll || isWhole())});
}

void SampleMaps::bindTo(gl::Pass& pass) const {
    pass.bind("BatchBlock", batch_).bind("Plan", plan_).bind("Slots", slots_).bind("Samples", samples_);
    pass.bind("maps", maps_).bind("LayerTaps", layerTaps_);
    if (pass.has("Order")) pass.bind("Order", order_);
}

void SampleMaps::placeLayers(int stage, const SampleCameras& cameras, const Needs& needs) {
    const glm::dmat3& face0FromLight = cameras.faceFromLight[0];
    gl::Pass pass(placeLayers_);
    pass.constants(PlaceLayersConstants{.face0FromLight = glm::mat4(glm::mat3(face0FromLight)),
                                        .tileCount = needs.tiles != nullptr ? needs.tileCount : -1,
                                        .isCube = cameras.isCube,
                                        .reach = needs.reach,
                                        .nearestBlocker_m = float(cameras.nearestBlocker_m),
                                        .mapSize_px = mapSize_px_,
                                        .asksByQuads = needs.asksByQuads})
        .bind("BatchBlock", batch_)
        .bind("Plan", plan_)
        .bind("Slots", slots_)
        .bind("Cameras", cameras_)
        .bind("Samples", samples_)
        .bind("Tiles", needs.tiles != nullptr ? *needs.tiles : plan_)
        .bind("LayerTaps", layerTaps_)
        .bind("LayerCameras", layerCameras_)
        .bind("Masks", layerMasks_);
    if (needs.redraw != nullptr) {
        pass.dispatchIndirect(*needs.redraw, offsetof(RedrawGroups, slots));
    } else {
        constexpr std::size_t countInStage = sizeof(int);
        pass.dispatchIndirect(plan_, std::size_t(stage) * sizeof(glm::ivec4) + countInStage);
    }
}

void SampleMaps::gather(const Needs& needs) {
    gl::Pass(gather_)
        .constants(GatherConstants{.casterCount = int(casters_.size()),
                                   .layersInAll = capacity_ * faces_,
                                   .isKept = needs.redraw != nullptr})
        .bind("BatchBlock", batch_)
        .bind("Plan", plan_)
        .bind("LayerCameras", layerCameras_)
        .bind("Masks", layerMasks_)
        .bind("Boxes", cullBoxes_)
        .bind("Instances", instances_)
        .bind("Commands", commands_)
        .bind("RedrawBlock", needs.redraw != nullptr ? *needs.redraw : plan_)
        .dispatch(casters_.size() + 1);
}

void SampleMaps::draw(int stage, int batch, const SampleCameras& cameras, const Needs& needs) {
    if (faces_ == 0) return;
    choose(stage, batch);
    placeLayers(stage, cameras, needs);
    gather(needs);
    // In one go where the vertex shader chooses the layer, else layer by layer.
    const int rounds = device_.layerFromVertexShader ? 1 : capacity_ * faces_;
    for (int round = 0; round < rounds; ++round) {
        if (rounds > 1) framebuffer_.attachDepthLayer(maps_, round);
        const auto command = [&](std::size_t caster) {
            return (caster * std::size_t(rounds) + std::size_t(round)) * sizeof(DrawCommand);
        };
        clearCells(command(casters_.size()));
        for (const bool hasHoles : {false, true}) {
            if (hasHoles && !anyHasHoles()) continue;
            drawCasters(hasHoles, command);
        }
    }
}

gl::RasterState SampleMaps::rasterState(gl::Compare depthTest) const {
    return {.width_px = mapSize_px_,
            .height_px = mapSize_px_,
            .depthTest = depthTest,
            .depthWrite = true,
            .colorWrite = false};
}

/// Only what is needed of the layers of this batch is cleared: what that is, the device alone may know.
void SampleMaps::clearCells(std::size_t command_bytes) const {
    gl::Pass(clear_)
        .bind("Masks", layerMasks_)
        .vertices("layerAndCaster", instances_, {.perInstance = true})
        .into(framebuffer_, rasterState(gl::Compare::always))
        .drawIndirect(gl::Primitive::triangles, commands_, command_bytes);
}

bool SampleMaps::anyHasHoles() const {
    return std::ranges::any_of(casters_, [](const Caster& caster) { return caster.alphaMask.texture != 0; });
}

template <typename CommandOf>
void SampleMaps::drawCasters(bool haveHoles, CommandOf command_bytes) const {
    gl::Pass pass(haveHoles ? masked_ : opaque_);
    pass.constants(DepthMapConstants{.light = light_})
        .bind("Cameras", layerCameras_)
        .bind("Casters", casterConstants_)
        .vertices("layerAndCaster", instances_, {.perInstance = true})
        .into(framebuffer_, rasterState(gl::Compare::greater));
    for (std::size_t i = 0; i < casters_.size(); ++i) {
        const Mesh& mesh = *casters_[i].mesh;
        const GLuint alphaTexture = casters_[i].alphaMask.texture;
        if (boxes_[i].indexCount == 0 || (alphaTexture != 0) != haveHoles) continue;
        pass.vertices("posMesh", {.buffer = mesh.positionBuffer()}).indices(mesh.indexBuffer());
        if (haveHoles) {
            pass.vertices("uvMesh", {.buffer = mesh.uvBuffer()});
            pass.bind("alphaTexture", gl::TextureRef{.name = alphaTexture});
        }
        pass.drawIndexedIndirect(commands_, command_bytes(i));
    }
}

}  // namespace penumbra::light_sampling
