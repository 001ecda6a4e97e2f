// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/depth_map.h"

#include <algorithm>
#include <string>
#include <vector>

namespace penumbra {
namespace {

constexpr const char* vertexShader = "src/techniques/common/depth_map.vert.glsl";
constexpr const char* fragmentShader = "src/techniques/common/depth_map.frag.glsl";

std::vector<std::string> variant(const Device::Internals& device, bool masked) {
    std::vector<std::string> defines;
    if (!device.layerFromVertexShader) defines.push_back("LAYER_BY_LAYER");
    if (masked) defines.push_back("MASKED");
    return defines;
}

}  // namespace

DepthMap::DepthMap(Device& device)
    : device_(internalsOf(device)),
      opaque_(device_.shaders, {vertexShader}, variant(device_, false)),
      masked_(device_.shaders, {vertexShader, fragmentShader}, variant(device_, true)),
      cameras_("light cameras"),
      casters_("depth map casters"),
      instances_("depth map instances") {}

void DepthMap::allocate(int mapSize_px, int layers) {
    if (mapSize_px > device_.maxTextureSize_px || layers > device_.maxLayers) {
        throw Error(Error::Kind::badArgument, std::to_string(layers) + " maps of " +
                                                  std::to_string(mapSize_px) +
                                                  " texels squared are more than this device allows (" +
                                                  std::to_string(device_.maxLayers) + " maps, " +
                                                  std::to_string(device_.maxTextureSize_px) + " texels)");
    }
    maps_.fit({.width_px = mapSize_px,
               .height_px = mapSize_px,
               .layers = layers,
               .format = gl::Format::depth32f,
               .label = "depth maps"});
    framebuffer_.fit({}, &maps_, "depth maps");
}

void DepthMap::render(std::span<const Caster> casters, const LightSpaceScene& scene,
                      std::span<const LightCamera> cameras, int mapSize_px, Surface surface) {
    count_ = int(cameras.size());
    allocate(mapSize_px, std::max(1, count_));

    std::pmr::memory_resource* const memory = gl::ObjectRegistryScope::frameMemory();
    std::pmr::vector<LightCameraConstants> cameraConstants(memory);
    for (const LightCamera& camera : cameras) cameraConstants.push_back(camera.constants(mapSize_px));
    cameras_.write(cameraConstants);

    // An instance for each layer that a caster is drawn into, caster after caster.
    std::pmr::vector<CasterConstants> casterConstants(memory);
    std::pmr::vector<glm::ivec2> instances(memory);
    std::pmr::vector<std::size_t> ends(memory);
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const AlphaMask& mask = casters[i].alphaMask;
        casterConstants.push_back({.lightFromMesh = scene.lightFromMesh[i],
                                   .alphaFactor = mask.factor,
                                   .alphaCutoff = mask.cutoff});
        for (int layer = 0; casters[i].casts && layer < count_; ++layer) {
            if (cameras[std::size_t(layer)].mightSee(scene.boxes[i])) instances.emplace_back(layer, int(i));
        }
        ends.push_back(instances.size());
    }
    casters_.write(casterConstants);
    instances_.write(instances);

    if (device_.layerFromVertexShader) {
        draw(casters, scene, surface, [&](std::size_t i) {
            const std::size_t first = i == 0 ? 0 : ends[i - 1];
            return Instances{first, ends[i] - first};
        });
        return;
    }
    for (int layer = 0; layer < count_; ++layer) {
        framebuffer_.attachDepthLayer(maps_, layer);
        draw(casters, scene, surface, [&](std::size_t i) {
            const auto begin = instances.begin() + std::ptrdiff_t(i == 0 ? 0 : ends[i - 1]);
            const auto end = instances.begin() + std::ptrdiff_t(ends[i]);
            const auto it = std::find(begin, end, glm::ivec2(layer, int(i)));
            return Instances{std::size_t(it - instances.begin()), it == end ? 0u : 1u};
        });
    }
}

template <typename InstancesOf>
void DepthMap::draw(std::span<const Caster> casters, const LightSpaceScene& scene, Surface surface,
                    InstancesOf instancesOf) const {
    const bool isNearest = surface == Surface::nearest;
    gl::RasterState state{.width_px = maps_.width_px(),
                          .height_px = maps_.height_px(),
                          .depthTest = isNearest ? gl::Compare::greater : gl::Compare::less,
                          .depthWrite = true,
                          .colorWrite = false};
    for (const bool hasHoles : {false, true}) {
        gl::Pass pass(hasHoles ? masked_ : opaque_);
        pass.constants(DepthMapConstants{.light = scene.light});
        pass.bind("Cameras", cameras_).bind("Casters", casters_);
        pass.vertices("layerAndCaster", instances_.buffer(), {.perInstance = true});
        pass.into(framebuffer_, state);
        if (!hasHoles) pass.clearDepth(isNearest ? 0 : 1);
        for (std::size_t i = 0; i < casters.size(); ++i) {
            const auto [first, count] = instancesOf(i);
            if (count == 0 || (casters[i].alphaMask.texture != 0) != hasHoles) continue;
            if (surface == Surface::farthestFront) {
                // Mirrored, a mesh shows its back as its front.
                const bool isMirrored = glm::determinant(scene.lightFromMesh[i]) < 0;
                state.cull = isMirrored ? gl::Cull::front : gl::Cull::back;
                pass.state(state);
            }
            const Mesh& mesh = *casters[i].mesh;
            pass.vertices("posMesh", {.buffer = mesh.positionBuffer()}).indices(mesh.indexBuffer());
            if (hasHoles) {
                pass.vertices("uvMesh", {.buffer = mesh.uvBuffer()});
                pass.bind("alphaTexture", gl::TextureRef{.name = casters[i].alphaMask.texture});
            }
            pass.drawIndexed(mesh.indices().size(), count, first);
        }
    }
}

void DepthMap::bindTo(gl::Pass& pass) const {
    pass.bind("depthMaps", maps_).bind("LightCameras", cameras_);
}

}  // namespace penumbra
