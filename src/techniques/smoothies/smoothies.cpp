// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "src/gl/raster_state.h"
#include "src/techniques/smoothies/smoothie_edges_io.h"

namespace penumbra {
namespace {

constexpr std::array<std::string_view, 3> falloffs = {"light", "linear", "sinusoidal"};

/// Receivers that cast nothing are mapped at a quarter of the map's size: only widths depend on them.
constexpr int receiverTexel_px = 4;

/// What the map of casters with holes has more along each axis: edges of holes are known by its texels alone.
constexpr int maskedMapScale = 2;
constexpr int largestMap_px = 16384;

void bindStorage(GLuint block, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, buffer.name());
}

void reserve(gl::Buffer& buffer, std::size_t size_bytes, std::string_view label) {
    if (buffer.name() == 0 || buffer.size_bytes() < size_bytes) buffer = gl::Buffer(size_bytes, label);
}

/// Blocks light with holes in it.
bool isMasked(const Caster& caster) {
    return caster.casts && caster.alphaMask.texture != 0;
}

}  // namespace

Smoothies::PicturePrograms::PicturePrograms(Device& device, const std::string& file,
                                            std::vector<std::string> defines)
    : withoutNormals(device.internals().shaders, {"src/techniques/smoothies/" + file}, defines) {
    defines.emplace_back("WITH_NORMALS");
    withNormals = gl::Program(device.internals().shaders, {"src/techniques/smoothies/" + file}, defines);
}

Smoothies::Smoothies(Device& device)
    : device_(device.internals()),
      depthMap_(device),
      maskedMap_(device),
      receiverMap_(device),
      silhouettes_(device),
      farthest_(device_.shaders, {"src/techniques/smoothies/farthest.comp.glsl"}),
      build_(device_.shaders, {"src/techniques/smoothies/smoothie_edges.comp.glsl"}),
      clearNormals_(device_.shaders, {"src/techniques/smoothies/vertex_normals.comp.glsl"}, {"CLEAR"}),
      addNormals_(device_.shaders, {"src/techniques/smoothies/vertex_normals.comp.glsl"}),
      smoothie_(device_.shaders,
                {"src/techniques/smoothies/smoothie.vert.glsl", "src/techniques/smoothies/smoothie.geom.glsl",
                 "src/techniques/smoothies/smoothie.frag.glsl"}),
      lightProfileProgram_(device_.shaders, {"src/techniques/smoothies/light_profile.comp.glsl"}),
      classify_(device, "classify.comp.glsl", {}),
      resolve_(device, "resolve.comp.glsl", {}),
      resolveColored_(device, "resolve.comp.glsl", {"COLORED"}),
      masked_(device, "masked.comp.glsl", {}),
      maskedColored_(device, "masked.comp.glsl", {"COLORED"}),
      edgesAsVertices_(gl::makeFloatVertexArray(4, 4, 4)),
      constants_(std::size_t(2) * maxSmoothieCameras * sizeof(SmoothieConstants), "smoothie constants") {}

void Smoothies::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size",
                     .unit = "texels",
                     .help = "width and height of the shadow map; smoothies are drawn at half of it"},
                    settings_.mapSize_px, {16, largestMap_px});
    visitor.boolean({.name = "inner",
                     .help = "smoothies reach into the blocker too, so that the umbra shrinks as the light "
                             "grows; off as in the paper"},
                    settings_.inner);
    visitor.real(
        {.name = "t",
         .help = "the paper's t (0.02 to 0.2): width of every smoothie in half windows of a light "
                 "frustum of 90 degrees, or as wide as all that casts for a distant light; 0 derives "
                 "it from the light's size"},
        settings_.t, {0, 1});
    visitor.boolean({.name = "remap",
                     .help = "alpha follows the distances of blocker and receiver (equation 1); off: the "
                             "same width everywhere"},
                    settings_.remap);
    visitor.choice({.name = "falloff",
                    .help = "how visibility grows across a smoothie: as the light's shape asks for, "
                            "linearly, or sinusoidally"},
                   settings_.falloff, falloffs);
}

void Smoothies::allocate(int layers) {
    const int size_px = std::max(1, settings_.mapSize_px / smoothieTexel_px);
    if (deepest_.width_px() == size_px && deepest_.layers() >= layers) return;
    const auto make = [&](gl::Format format, std::string_view label) {
        return gl::Texture(
            {.width_px = size_px, .height_px = size_px, .layers = layers, .format = format, .label = label});
    };
    deepest_ = {};  // freed first, so that the old need not fit beside the new
    order_ = {};
    deepest_ = make(gl::Format::r32ui, "smoothies/deepest edges");
    order_ = make(gl::Format::depth32f, "smoothies/order");
    framebuffer_ = gl::Framebuffer({&deepest_}, &order_, "smoothies");
}

void Smoothies::buildSmoothies(bool distant) {
    const auto cameras = std::size_t(depthMap_.count());
    reserve(farthestTiles_, cameras * tilesAcross * tilesAcross * sizeof(float), "smoothies/farthest");
    reserve(vertexNormals_, silhouettes_.vertexCount() * sizeof(glm::ivec4), "smoothies/vertex normals");
    reserve(smoothieEdges_, cameras * silhouettes_.edgeCount() * sizeof(SmoothieEdge), "smoothies/edges");
    const auto dispatchEdges = [&] {
        gl::dispatchIndirect(silhouettes_.commands(), SilhouetteExtractor::dispatchOffset);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    };

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
    bindSurfaces();
    bindStorage(2, farthestTiles_);
    farthest_.use();
    glUniform1i(0, hasReceiverMap_);
    constexpr GLuint groups = tilesAcross / 8;
    glDispatchCompute(groups, groups, GLuint(cameras));
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
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void Smoothies::bindConstants(int firstCamera) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, 1, constants_.name(),
                      GLintptr(std::size_t(firstCamera) * sizeof(SmoothieConstants)),
                      GLsizeiptr(maxSmoothieCameras * sizeof(SmoothieConstants)));
}

void Smoothies::bindSurfaces() const {
    depthMap_.texture().bind(0);
    if (hasReceiverMap_) receiverMap_.texture().bind(1);
}

void Smoothies::drawSmoothies() {
    constexpr std::array<GLuint, 4> noEdge = {0xffffffffu};
    constexpr float farthest = 1;
    gl::beginPass(framebuffer_.name(), {.width_px = deepest_.width_px(),
                                        .height_px = deepest_.height_px(),
                                        .depthTest = gl::Compare::less,
                                        .depthWrite = true});
    smoothie_.use();
    glBindVertexArray(edgesAsVertices_.name());
    bindSurfaces();
    glUniform1i(0, hasReceiverMap_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, silhouettes_.commands().name());
    glClearNamedFramebufferuiv(framebuffer_.name(), GL_COLOR, 0, noEdge.data());
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
    for (int camera = 0; camera < depthMap_.count(); ++camera) {
        const std::size_t first = std::size_t(camera) * silhouettes_.edgeCount();
        for (GLuint attribute = 0; attribute < 3; ++attribute) {
            glEnableVertexArrayAttrib(edgesAsVertices_.name(), attribute);
            glVertexArrayVertexBuffer(edgesAsVertices_.name(), attribute, smoothieEdges_.name(),
                                      GLintptr(first * sizeof(SmoothieEdge) + attribute * sizeof(glm::vec4)),
                                      sizeof(SmoothieEdge));
        }
        glUniform1i(1, camera);
        bindConstants(camera);
        glDrawArraysIndirect(GL_POINTS, nullptr);
    }
    bindConstants(0);
}

void Smoothies::drawMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                         const LightCameras& cameras) {
    const auto casting = [&](auto&& which) {
        std::pmr::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end(),
                                         gl::LedgerScope::frameMemory());
        for (Caster& caster : casters) caster.casts = which(caster);
        return casters;
    };
    hasMaskedMap_ = hasSmoothies_ && std::ranges::any_of(inputs.casters, isMasked);
    {
        const auto pass = timers_.pass("smoothies/depth map");
        depthMap_.render(casting([&](const Caster& caster) {
                             return caster.casts && !(hasMaskedMap_ && isMasked(caster));
                         }),
                         scene, cameras, settings_.mapSize_px);
    }
    if (hasMaskedMap_) {
        const auto pass = timers_.pass("smoothies/masked map");
        maskedMap_.render(casting(isMasked), scene, cameras,
                          std::min(maskedMapScale * settings_.mapSize_px, largestMap_px));
        if (!saidMasked_) {
            device_.log.write(LogLevel::info,
                              "smoothies: casters with an alpha mask have no silhouette edges; their shadows "
                              "are filtered from a map of their own");
            saidMasked_ = true;
        }
    }
    // What receives but is not in the depth map is drawn by itself: smoothies need to know how far away it
    // is.
    const std::pmr::vector<Caster> receivers =
        casting([](const Caster& caster) { return caster.receives && (!caster.casts || isMasked(caster)); });
    hasReceiverMap_ = hasSmoothies_ && std::ranges::any_of(receivers, &Caster::casts);
    if (hasReceiverMap_) {
        const auto pass = timers_.pass("smoothies/receiver map");
        receiverMap_.render(receivers, scene, cameras, std::max(1, settings_.mapSize_px / receiverTexel_px));
    }
}

void Smoothies::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    const AreaLight& light = inputs.light;
    const bool distant = light.shape == LightShape::distant;
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras = fitLightCameras(light, scene, {.mapSize_px = settings_.mapSize_px});
    hasSmoothies_ = (hasSize(light) || settings_.t > 0) && !cameras.empty();
    drawMaps(inputs, scene, cameras);

    std::array<SmoothieConstants, maxSmoothieCameras> constants{};
    for (std::size_t i = 0; i < cameras.size(); ++i)
        constants[i] = smoothieConstants(settings_, inputs, cameras[i], scene);
    constants_.write(std::as_bytes(std::span(constants)));
    bindConstants(0);
    if (hasSmoothies_) {
        allocate(layersPerCamera * int(cameras.size()));
        {
            const auto pass = timers_.pass("smoothies/silhouettes");
            std::pmr::vector<SilhouetteSource> sources{gl::LedgerScope::frameMemory()};
            for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
                const Caster& caster = inputs.casters[i];
                if (caster.casts && !isMasked(caster))
                    sources.push_back({caster.mesh, scene.lightFromMesh[i]});
            }
            silhouettes_.extract(sources, distant ? LightPoint(0, 0, 1, 0) : LightPoint(0, 0, 0, 1), {});
        }
        {
            const auto pass = timers_.pass("smoothies/construction");
            buildSmoothies(distant);
        }
        {
            const auto pass = timers_.pass("smoothies/smoothies");
            drawSmoothies();
        }
        if (light.radianceTexture != 0) profileLight(light.radianceTexture);
    }
    view_.bind(inputs.view, lightFromWorldMatrix);
    resolve(inputs, out);
    if (hasMaskedMap_) resolveMasked(inputs, scene, cameras, out);
}

void Smoothies::useForPicture(const PicturePrograms& programs, const ShadowInputs& inputs) const {
    (inputs.view.normalTexture != 0 ? programs.withNormals : programs.withoutNormals).use();
    glUniform1i(0, depthMap_.count());
    glUniform1i(1, inputs.light.shape == LightShape::distant);
    glUniform1i(2, isOneSided(inputs.light));
}

void Smoothies::resolve(const ShadowInputs& inputs, const VisibilityBuffer& out) {
    const auto tilesOf = [](int size_px) { return std::size_t((size_px + tileSize_px - 1) / tileSize_px); };
    reserve(tiles_, 4 * (4 + 2 * tilesOf(out.width_px()) * tilesOf(out.height_px())), "smoothies/tiles");
    constexpr GLuint none = 0;
    glClearNamedBufferData(tiles_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    constexpr std::array<GLuint, 4> noTiles = {0, 0, 1, 0};
    tiles_.write(std::as_bytes(std::span(noTiles)));
    bindStorage(3, tiles_);
    depthMap_.bind(3, 0);
    deepest_.bind(4);
    bindVisibility(out, 0);
    {
        const auto pass = timers_.pass("smoothies/classify");
        useForPicture(classify_, inputs);
        glUniform1i(3, hasSmoothies_);
        gl::dispatchPixels(out.width_px(), out.height_px());
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    if (!hasSmoothies_) return;
    const auto pass = timers_.pass("smoothies/resolve");
    useForPicture(out.colored() ? resolveColored_ : resolve_, inputs);
    if (out.colored()) lightProfile_.bind(5);
    glUniform1ui(3, GLuint(silhouettes_.edgeCount()));
    bindStorage(2, smoothieEdges_);
    gl::dispatchIndirect(tiles_);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Smoothies::resolveMasked(const ShadowInputs& inputs, const LightSpaceScene& scene,
                              const LightCameras& cameras, const VisibilityBuffer& out) {
    // The search for blockers is as wide as the nearest of them could make a penumbra.
    float nearestNearness = -std::numeric_limits<float>::infinity();
    for (const LightCamera& camera : cameras) {
        const float nearest = smoothieConstants(settings_, inputs, camera, scene).nearness.y;
        for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
            if (!isMasked(inputs.casters[i]) || std::isnan(scene.boxes[i][0].x)) continue;
            for (const glm::dvec3& corner : scene.boxes[i]) {
                const double z = (camera.faceFromLight * glm::dvec4(corner, 1)).z;
                const double nearness = camera.orthographic ? -z : z > 0 ? 1 / z : nearest;
                nearestNearness = std::max(nearestNearness, std::min(float(nearness), nearest));
            }
        }
    }
    const auto pass = timers_.pass("smoothies/masked");
    useForPicture(out.colored() ? maskedColored_ : masked_, inputs);
    glUniform1f(3, nearestNearness);
    maskedMap_.bind(3, 0);
    glBindImageTexture(0, out.texture(), 0, GL_FALSE, 0, GL_READ_WRITE, out.colored() ? GL_RGBA16F : GL_R32F);
    gl::dispatchPixels(out.width_px(), out.height_px());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Smoothies::profileLight(GLuint radianceTexture) {
    const auto pass = timers_.pass("smoothies/light profile");
    if (lightProfile_.name() == 0) {
        lightProfile_ = gl::Texture({.width_px = profileDirections + 1,
                                     .height_px = profileOffsets,
                                     .format = gl::Format::rgba32f,
                                     .filter = gl::Filter::linear,
                                     .label = "smoothies/light profile"});
    }
    lightProfileProgram_.use();
    glBindTextureUnit(5, radianceTexture);
    lightProfile_.bindImage(1, GL_WRITE_ONLY);
    glDispatchCompute(profileDirections + 1, 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Smoothies::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
    if (!hasSmoothies_) return;
    // a / (1 + a) of alpha: half at the penumbra's border. Outer half, then the inner one in three layers.
    visitor.texture({.name = "alpha of the deepest smoothies, outer and inner halves",
                     .texture = order_.name(),
                     .layers = layersPerCamera * depthMap_.count(),
                     .white = 0.5f});
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
