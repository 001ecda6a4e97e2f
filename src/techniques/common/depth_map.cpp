// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/depth_map.h"

#include <algorithm>
#include <string>
#include <vector>

#include "src/gl/raster_state.h"

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
    : device_(device.internals()),
      opaque_(device_.shaders, {vertexShader}, variant(device_, false)),
      masked_(device_.shaders, {vertexShader, fragmentShader}, variant(device_, true)),
      vertices_(gl::makeFloatVertexArray(3, 2)),
      cameras_("light cameras"),
      casters_("depth map casters"),
      layerLists_("depth map layers") {}

void DepthMap::allocate(int mapSize_px, int layers) {
    if (maps_.width_px() == mapSize_px && maps_.layers() >= layers) return;
    if (mapSize_px > device_.maxTextureSize_px || layers > device_.maxLayers) {
        throw Error(Error::Kind::badArgument, std::to_string(layers) + " maps of " +
                                                  std::to_string(mapSize_px) +
                                                  " texels squared are more than this device allows (" +
                                                  std::to_string(device_.maxLayers) + " maps, " +
                                                  std::to_string(device_.maxTextureSize_px) + " texels)");
    }
    maps_ = {};  // freed first, so that the two need not fit together
    maps_ = gl::Texture({.width_px = mapSize_px,
                         .height_px = mapSize_px,
                         .layers = layers,
                         .format = GL_DEPTH_COMPONENT32F,
                         .label = "depth maps"});
    framebuffer_ = gl::Framebuffer({}, &maps_, "depth maps");
}

void DepthMap::render(std::span<const Caster> casters, const LightSpaceScene& scene,
                      std::span<const LightCamera> cameras, int mapSize_px, Surface surface) {
    count_ = int(cameras.size());
    allocate(mapSize_px, std::max(1, count_));

    std::pmr::memory_resource* const memory = gl::LedgerScope::frameMemory();
    std::pmr::vector<LightCameraConstants> cameraConstants(memory);
    for (const LightCamera& camera : cameras) cameraConstants.push_back(camera.constants(mapSize_px));
    cameras_.write(cameraConstants);

    // Which layers each caster is drawn into, list after list.
    std::pmr::vector<CasterConstants> casterConstants(memory);
    std::pmr::vector<int> layers(memory);
    std::pmr::vector<int> listEnds(memory);
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const AlphaMask& mask = casters[i].alphaMask;
        casterConstants.push_back({scene.lightFromMesh[i], {mask.factor, mask.cutoff, 0, 0}});
        for (int layer = 0; casters[i].casts && layer < count_; ++layer) {
            if (cameras[std::size_t(layer)].mightSee(scene.boxes[i])) layers.push_back(layer);
        }
        listEnds.push_back(int(layers.size()));
    }
    casters_.write(casterConstants);
    layerLists_.write(layers);

    const bool isNearest = surface == Surface::nearest;
    const GLenum culled = surface == Surface::farthestBack ? GL_FRONT : GL_BACK;
    gl::beginPass(framebuffer_.name(), {.width_px = mapSize_px,
                                        .height_px = mapSize_px,
                                        .depthTest = GLenum(isNearest ? GL_GREATER : GL_LESS),
                                        .depthWrite = true,
                                        .cull = isNearest ? GLenum(GL_NONE) : culled,
                                        .colorWrite = false});
    glBindVertexArray(vertices_.name());
    cameras_.bind(0);
    casters_.bind(1);
    layerLists_.bind(2);
    const auto drawAll = [&](int onlyLayer) {
        int first = 0;
        for (std::size_t i = 0; i < casters.size(); first = listEnds[i++]) {
            const auto begin = layers.begin() + first, end = layers.begin() + listEnds[i];
            const auto it = onlyLayer < 0 ? begin : std::find(begin, end, onlyLayer);
            if (it == end) continue;
            const gl::Program& program = casters[i].alphaMask.texture != 0 ? masked_ : opaque_;
            program.use();
            // Mirrored, a mesh shows its back as its front.
            const bool isMirrored = glm::determinant(scene.lightFromMesh[i]) < 0;
            if (!isNearest) glCullFace(isMirrored ? GL_FRONT + GL_BACK - culled : culled);
            glUniform1i(0, int(i));
            glUniform1i(1, int(it - layers.begin()));
            draw(casters[i], onlyLayer < 0 ? int(end - begin) : 1);
        }
    };
    const float background = isNearest ? 0 : 1;
    if (device_.layerFromVertexShader) {
        glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &background);
        drawAll(-1);
    } else {
        for (int layer = 0; layer < count_; ++layer) {
            framebuffer_.attachDepthLayer(maps_, layer);
            glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &background);
            drawAll(layer);
        }
    }
}

void DepthMap::draw(const Caster& caster, int instances) const {
    const Mesh& mesh = *caster.mesh;
    gl::attachFloats(vertices_.name(), 0, mesh.positionBuffer(), 3);
    gl::attachFloats(vertices_.name(), 1, mesh.uvBuffer(), 2);
    glVertexArrayElementBuffer(vertices_.name(), mesh.indexBuffer());
    if (caster.alphaMask.texture != 0) glBindTextureUnit(0, caster.alphaMask.texture);
    glDrawElementsInstanced(GL_TRIANGLES, GLsizei(mesh.indices().size()), GL_UNSIGNED_INT, nullptr,
                            instances);
}

void DepthMap::bind(unsigned unit, unsigned block) const {
    maps_.bind(unit);
    cameras_.bind(block);
}

}  // namespace penumbra
