// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "src/gl/raster_state.h"
#include "src/techniques/smoothies/smoothie_edges_io.h"

namespace penumbra {
namespace {

constexpr std::array<std::string_view, 3> falloffs = {"light", "linear", "sinusoidal"};

std::vector<std::string> variant(const Device::Internals& device, bool inner) {
    std::vector<std::string> defines;
    if (!device.layerFromVertexShader) defines.push_back("LAYER_BY_LAYER");
    if (inner) defines.push_back("INNER");
    return defines;
}

bool hasSize(const AreaLight& light) {
    switch (light.shape) {
        case LightShape::rect:
            return light.width_m > 0 || light.height_m > 0;
        case LightShape::distant:
            return light.angle_rad > 0;
        default:
            return light.radius_m > 0;
    }
}

/// How far away, along the camera's axis, the receivers reach.
double farthestReceiver_m(const LightCamera& camera, const LightSpaceScene& scene) {
    double farthest_m = 0;
    for (const ReceiverRegion::Polygon& polygon : scene.receivers.polygons) {
        for (const glm::dvec3& posLight : polygon) {
            farthest_m = std::max(farthest_m, (camera.faceFromLight * glm::dvec4(posLight, 1)).z);
        }
    }
    return farthest_m;
}

}  // namespace

Smoothies::Smoothies(Device& device)
    : device_(device.internals()),
      depthMap_(device),
      receiverMap_(device),
      silhouettes_(device),
      farthest_(device_.shaders, {"src/techniques/smoothies/farthest.comp.glsl"}),
      build_(device_.shaders, {"src/techniques/smoothies/smoothie_edges.comp.glsl"}),
      clearNormals_(device_.shaders, {"src/techniques/smoothies/vertex_normals.comp.glsl"}, {"CLEAR"}),
      addNormals_(device_.shaders, {"src/techniques/smoothies/vertex_normals.comp.glsl"}),
      outerProgram_(
          device_.shaders,
          {"src/techniques/smoothies/smoothie.vert.glsl", "src/techniques/smoothies/outer.frag.glsl"},
          variant(device_, false)),
      innerProgram_(
          device_.shaders,
          {"src/techniques/smoothies/smoothie.vert.glsl", "src/techniques/smoothies/inner.frag.glsl"},
          variant(device_, true)),
      resolve_(device_.shaders, {"src/techniques/smoothies/resolve.comp.glsl"}),
      noVertices_(gl::makeFloatVertexArray(3)),
      constants_("smoothie constants") {}

void Smoothies::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size",
                     .unit = "texels",
                     .help = "width and height of the shadow map and the smoothie buffers"},
                    mapSize_px_, {16, 16384});
    visitor.boolean({.name = "inner",
                     .help = "smoothies reach into the blocker too, so that the umbra shrinks as the light "
                             "grows; off as in the paper"},
                    inner_);
    visitor.real({.name = "t",
                  .help = "width of every smoothie as a share of half the light camera's window (the paper's "
                          "t, 0.02 to 0.2); 0 derives it from the light's size"},
                 t_, {0, 1});
    visitor.boolean({.name = "remap",
                     .help = "alpha follows the distances of blocker and receiver (equation 1); off: the "
                             "same width everywhere"},
                    remap_);
    visitor.choice({.name = "falloff",
                    .help = "how visibility grows across a smoothie: as the light's shape asks for, "
                            "linearly, or sinusoidally"},
                   falloff_, falloffs);
}

SmoothieConstants Smoothies::constantsOf(const AreaLight& light, const LightCamera& camera,
                                         const LightSpaceScene& scene) const {
    const glm::dmat3 faceFromLight(camera.faceFromLight);
    const bool rect = light.shape == LightShape::rect;
    const bool distant = light.shape == LightShape::distant;
    const glm::dvec2 extent = camera.windowMax - camera.windowMin;
    const double window = std::max(extent.x, extent.y);
    const double farthest_m = farthestReceiver_m(camera, scene);
    // Edges much nearer to the light than to anything they shade: all of the window is in their penumbra
    // anyway.
    const double nearest_m = camera.orthographic ? camera.near_m : 1e-4 * farthest_m;
    return {
        .halfX = glm::dvec4(faceFromLight[0] * double(rect ? 0.5f * light.width_m : light.radius_m), 0),
        .halfY = glm::dvec4(faceFromLight[1] * double(rect ? 0.5f * light.height_m : light.radius_m), 0),
        .widths = {distant ? std::tan(0.5 * light.angle_rad) : light.radius_m, 0.5 * t_ * window,
                   window / mapSize_px_, window},
        .nearness = {camera.orthographic ? -farthest_m : 1 / farthest_m,
                     camera.orthographic ? -nearest_m : 1 / nearest_m, 0, 0},
        .settings = {int(light.shape), falloff_, remap_, inner_},
    };
}

void Smoothies::allocate(int layers) {
    if (outer_.width_px() == mapSize_px_ && outer_.layers() >= layers && (!inner_ || innerEdges_.name() != 0))
        return;
    const auto make = [&](GLenum format, std::string_view label) {
        return gl::Texture({.width_px = mapSize_px_,
                            .height_px = mapSize_px_,
                            .layers = layers,
                            .format = format,
                            .label = label});
    };
    for (gl::Texture* texture : {&outer_, &innerEdges_, &innerOrder_}) *texture = {};  // freed first, to fit
    outer_ = make(GL_RG32F, "smoothies/outer");
    outerFramebuffer_ = gl::Framebuffer({&outer_}, nullptr, "smoothies/outer");
    if (!inner_) return;
    innerEdges_ = make(GL_RGBA32F, "smoothies/inner");
    innerOrder_ = make(GL_DEPTH_COMPONENT32F, "smoothies/inner order");
    innerFramebuffer_ = gl::Framebuffer({&innerEdges_}, &innerOrder_, "smoothies/inner");
}

void Smoothies::buildSmoothies(bool distant) {
    const auto reserve = [](gl::Buffer& buffer, std::size_t size_bytes, std::string_view label) {
        if (buffer.name() == 0 || buffer.size_bytes() < size_bytes) buffer = gl::Buffer(size_bytes, label);
    };
    const auto cameras = std::size_t(depthMap_.count());
    reserve(tiles_, cameras * tilesAcross * tilesAcross * sizeof(float), "smoothies/tiles");
    reserve(vertexNormals_, silhouettes_.vertexCount() * sizeof(glm::ivec4), "smoothies/vertex normals");
    reserve(smoothieEdges_, cameras * silhouettes_.edgeCount() * sizeof(SmoothieEdge), "smoothies/edges");
    const auto bindStorage = [](GLuint block, const gl::Buffer& buffer) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, buffer.name());
    };
    const auto dispatchEdges = [&] {
        glDispatchComputeIndirect(GLintptr(SilhouetteExtractor::dispatchOffset));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    };
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, silhouettes_.commands().name());

    // The normals of the silhouette's vertices.
    silhouettes_.bindEdges(0);
    bindStorage(1, silhouettes_.commands());
    bindStorage(2, vertexNormals_);
    clearNormals_.use();
    dispatchEdges();
    addNormals_.use();
    glUniform1i(0, distant);
    dispatchEdges();

    // How far away receivers are.
    if (hasReceiverMap_) receiverMap_.bind(1, 0);
    depthMap_.bind(0, 0);
    constants_.bind(1);
    bindStorage(2, tiles_);
    farthest_.use();
    glUniform1i(0, hasReceiverMap_);
    glDispatchCompute(tilesAcross, tilesAcross, GLuint(cameras));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    // The smoothies.
    silhouettes_.bindEdges(3);
    bindStorage(4, silhouettes_.commands());
    bindStorage(5, vertexNormals_);
    bindStorage(6, smoothieEdges_);
    build_.use();
    glUniform1i(0, GLint(cameras));
    glUniform1ui(1, GLuint(silhouettes_.edgeCount()));
    dispatchEdges();
}

void Smoothies::drawSmoothies(const gl::Program& program, const gl::Framebuffer& framebuffer,
                              const gl::Texture& color, const gl::Texture* depth) const {
    constexpr std::array<float, 4> nothing = {3.0e38f, 1, 0, 0};  // outer: no smoothie, lit
    constexpr std::array<float, 4> noEdge = {0, 0, 0, 0};
    constexpr float farthest = 1;
    const auto clearAndDraw = [&] {
        glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0,
                                  depth != nullptr ? noEdge.data() : nothing.data());
        if (depth != nullptr) glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &farthest);
        glDrawArraysIndirect(GL_TRIANGLES, nullptr);
    };
    program.use();
    glBindVertexArray(noVertices_.name());
    if (hasReceiverMap_) receiverMap_.bind(1, 0);
    depthMap_.bind(0, 0);
    constants_.bind(1);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, smoothieEdges_.name());
    glUniform1i(0, hasReceiverMap_);
    glUniform1ui(1, GLuint(silhouettes_.edgeCount()));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, silhouettes_.commands().name());
    if (device_.layerFromVertexShader) {
        clearAndDraw();
        return;
    }
    for (int layer = 0; layer < depthMap_.count(); ++layer) {
        glNamedFramebufferTextureLayer(framebuffer.name(), GL_COLOR_ATTACHMENT0, color.name(), 0, layer);
        if (depth != nullptr)
            glNamedFramebufferTextureLayer(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth->name(), 0, layer);
        glUniform1i(2, layer);
        clearAndDraw();
    }
}

void Smoothies::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    const AreaLight& light = inputs.light;
    const bool distant = light.shape == LightShape::distant;
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras = fitLightCameras(light, scene, {.mapSize_px = mapSize_px_});
    {
        const auto pass = timers_.pass("smoothies/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_);
    }

    hasSmoothies_ = hasSize(light) && !cameras.empty();
    if (hasSmoothies_) {
        std::vector<SmoothieConstants> constants;
        for (const LightCamera& camera : cameras) constants.push_back(constantsOf(light, camera, scene));
        constants_.write(constants);
        allocate(int(cameras.size()));

        std::vector<SilhouetteSource> sources;
        bool anyMasked = false;
        for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
            const Caster& caster = inputs.casters[i];
            if (!caster.casts) continue;
            const bool masked = caster.alphaMask.texture != 0;
            anyMasked = anyMasked || masked;
            if (!masked) sources.push_back({caster.mesh, scene.lightFromMesh[i]});
        }
        if (anyMasked && !saidMasked_) {
            device_.log.write(
                LogLevel::info,
                "smoothies: casters with an alpha mask have no silhouette edges; their shadows get the "
                "map's 2x2 filter and no penumbra");
            saidMasked_ = true;
        }
        // What receives but does not cast is drawn by itself: smoothies need to know how far away it is.
        std::vector<Caster> receivers(inputs.casters.begin(), inputs.casters.end());
        for (Caster& caster : receivers) caster.casts = !caster.casts && caster.receives;
        hasReceiverMap_ = std::ranges::any_of(receivers, &Caster::casts);
        if (hasReceiverMap_) {
            const auto pass = timers_.pass("smoothies/receiver map");
            receiverMap_.render(receivers, scene, cameras, mapSize_px_);
        }
        {
            const auto pass = timers_.pass("smoothies/silhouettes");
            const unsigned instances = device_.layerFromVertexShader ? unsigned(cameras.size()) : 1;
            silhouettes_.extract(sources, distant ? LightPoint(0, 0, 1, 0) : LightPoint(0, 0, 0, 1),
                                 {.verticesPerEdge = unsigned(verticesPerSmoothie), .instances = instances});
            buildSmoothies(distant);
        }
        if (inner_) {
            const auto pass = timers_.pass("smoothies/inner half");
            gl::beginPass(innerFramebuffer_.name(), {.width_px = mapSize_px_,
                                                     .height_px = mapSize_px_,
                                                     .depthTest = GL_LESS,
                                                     .depthWrite = true});
            drawSmoothies(innerProgram_, innerFramebuffer_, innerEdges_, &innerOrder_);
        }
        {
            const auto pass = timers_.pass("smoothies/outer half");
            gl::beginPass(outerFramebuffer_.name(),
                          {.width_px = mapSize_px_, .height_px = mapSize_px_, .blendEquation = GL_MIN});
            if (inner_) innerEdges_.bind(2);
            drawSmoothies(outerProgram_, outerFramebuffer_, outer_, nullptr);
        }
    }

    const auto pass = timers_.pass("smoothies/resolve");
    resolve_.use();
    view_.bind(inputs.view, lightFromWorldMatrix);
    depthMap_.bind(3, 0);
    if (hasSmoothies_) constants_.bind(1);
    outer_.bind(4);
    innerEdges_.bind(5);
    bindVisibility(out, 0);
    glUniform1i(0, depthMap_.count());
    glUniform1i(1, distant);
    glUniform1i(2, isOneSided(light));
    glUniform1i(3, hasSmoothies_);
    gl::dispatchPixels(out.width_px(), out.height_px());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Smoothies::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
    if (!hasSmoothies_) return;
    visitor.texture({.name = "smoothie depth (red) and visibility (green)",
                     .texture = outer_.name(),
                     .layers = depthMap_.count()});
    if (inner_) {
        visitor.texture({.name = "way to the closest edge (red, green) and its nearness (blue)",
                         .texture = innerEdges_.name(),
                         .layers = depthMap_.count(),
                         .black = -0.1f,
                         .white = 0.1f});
    }
}

Statistics Smoothies::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    if (hasSmoothies_) {
        statistics.counts.push_back({"edges", double(silhouettes_.edgeCount())});
        statistics.counts.push_back({"silhouette edges", double(silhouettes_.countFound())});
    }
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra
