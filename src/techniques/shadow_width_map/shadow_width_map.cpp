// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/shadow_width_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/techniques/shadow_width_map/map_cameras.h"
#include "src/techniques/shadow_width_map/widths_cpu.h"

namespace penumbra {
namespace {

constexpr std::array<std::string_view, 3> modeNames = {"exact", "compositing", "cpu-sweep"};
constexpr std::array<std::string_view, 2> curveNames = {"linear", "smooth"};
constexpr std::array<std::string_view, 2> neighbourNames = {"3", "6"};
constexpr std::array<std::string_view, 4> startNames = {"1/4", "1/16", "1/64", "1/256"};

constexpr int neighbourCount(int choice) {
    return choice == 0 ? 3 : 6;
}
constexpr float startDifference(int choice) {
    return 1.0f / float(4 << (2 * choice));
}

/// One invocation a line of the map.
void dispatchLines(int lines, int layers) {
    constexpr int groupSize = 16;
    glDispatchCompute(GLuint((lines + groupSize - 1) / groupSize), GLuint(layers), 1);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

std::vector<std::string> shader(const char* name) {
    return {std::string("src/techniques/shadow_width_map/") + name};
}

}  // namespace

ShadowWidthMap::ShadowWidthMap(Device& device)
    : depthMap_(device),
      edgeColumns_(device.internals().shaders, shader("edge_columns.comp.glsl")),
      edgeRows_(device.internals().shaders, shader("edge_rows.comp.glsl")),
      resolve_(device.internals().shaders, shader("resolve.comp.glsl")),
      penumbra_(device.internals().shaders, shader("penumbra.comp.glsl")),
      composite_(device.internals().shaders, shader("composite.comp.glsl")),
      published_(device.internals().shaders, shader("resolve_published.comp.glsl")),
      constants_("shadow-width constants") {}

void ShadowWidthMap::describe(ParameterVisitor& visitor) {
    visitor.choice(
        {.name = "mode",
         .help = "how widths are found: exactly, or as published by compositing or by sweeps on the CPU"},
        mode_, modeNames);
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each map"},
                    mapSize_px_, {16, 4096});
    visitor.boolean(
        {.name = "inner_edges",
         .help = "exact mode: penumbrae on casters too, from edges where casters overlap in the map"},
        innerEdges_);
    visitor.boolean({.name = "reuse_maps", .help = "keep the maps while nothing that they show has changed"},
                    reuseMaps_);
    visitor.boolean(
        {.name = "physical",
         .help = "published modes: choose c_scale so that the umbra is as large as the light makes it"},
        physical_);
    visitor.real(
        {.name = "c_scale", .help = "published modes, unless physical: c_scale of equation I(sd, sw)"},
        cScale_, {0, std::numeric_limits<float>::max()});
    visitor.real({.name = "c_bias", .help = "published modes: c_bias of equation I(sd, sw)"}, cBias_, {0, 1});
    visitor.choice({.name = "curve", .help = "published modes: how I falls from 1 to 0"}, curve_, curveNames);
    visitor.choice({.name = "neighbours", .help = "compositing: how many neighbours each step looks at"},
                   neighbours_, neighbourNames);
    visitor.choice({.name = "start_difference",
                    .help = "compositing: the first difference; its inverse is the widest width in texels"},
                   startDifference_, startNames);
}

void ShadowWidthMap::setAttenuation(const AttenuationFunction& attenuation) {
    const std::vector<float> table = tabulateAttenuation(attenuation);
    const int entries = int(table.size());
    curveTable_ =
        gl::Texture({.width_px = entries, .format = GL_R32F, .filter = GL_LINEAR, .label = "attenuation"});
    glTextureSubImage2D(curveTable_.name(), 0, 0, 0, entries, 1, GL_RED, GL_FLOAT, table.data());
    tabulatedCurve_ = curve_;
}

void ShadowWidthMap::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras = fitMapCameras(inputs.light, scene, mapSize_px_);

    std::vector<double> key = {double(mode_), double(mapSize_px_), double(innerEdges_), double(neighbours_),
                               double(startDifference_)};
    appendMapKey(key, inputs, scene, cameras);
    // Nobody can tell whether a mask's texels have changed.
    const bool hasMask =
        std::ranges::any_of(inputs.casters, [](const Caster& c) { return c.alphaMask.texture != 0; });
    if (!reuseMaps_ || hasMask || key != mapsMadeFrom_) {
        mapsMadeFrom_.clear();
        makeMaps(inputs, scene, cameras);
        mapsMadeFrom_ = std::move(key);
        ++timesMade_;
    }
    resolve(inputs, lightFromWorldMatrix, out);
}

void ShadowWidthMap::makeMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                              std::span<const LightCamera> cameras) {
    const bool isAnyBoth = std::ranges::any_of(
        inputs.casters, [](const Caster& caster) { return caster.casts && caster.receives; });
    hasInnerEdges_ = mode_ == exact && innerEdges_ && isAnyBoth;
    backFaces_ = mode_ != exact && !isAnyBoth;
    {
        const auto pass = timers_.pass("shadow-width/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_,
                         backFaces_ ? DepthMap::Surface::farthestBack : DepthMap::Surface::nearest);
    }
    if (cameras.empty()) return;
    if (mode_ == exact) {
        findNearestEdges();
    } else if (mode_ == compositing) {
        composite();
    } else {
        sweepOnCpu();
    }
}

void ShadowWidthMap::allocateWidths(int layers, bool scratch) {
    const auto ensure = [&](gl::Texture& texture, int count, GLenum format, std::string_view label) {
        if (texture.name() != 0 && texture.width_px() == mapSize_px_ && texture.layers() >= count) return;
        texture = {};
        texture = gl::Texture({.width_px = mapSize_px_,
                               .height_px = mapSize_px_,
                               .layers = count,
                               .format = format,
                               .label = label});
    };
    ensure(widths_, layers, GL_R32F, "shadow widths");
    if (scratch) ensure(scratch_, layers, GL_R32F, "shadow widths, before a step");
    if (mode_ == exact) {
        ensure(columns_, depthMap_.count(), GL_RG16UI, "nearest edges in columns");
        ensure(edges_, layers, GL_R32UI, "nearest edges");
    }
}

void ShadowWidthMap::findNearestEdges() {
    const int layers = depthMap_.count() * (hasInnerEdges_ ? 2 : 1);
    allocateWidths(layers, false);
    {
        const auto pass = timers_.pass("shadow-width/columns");
        edgeColumns_.use();
        depthMap_.bind(3, 0);
        columns_.bindImage(0, GL_READ_WRITE);
        glUniform1i(0, hasInnerEdges_);
        dispatchLines(mapSize_px_, depthMap_.count());
    }
    {
        const auto pass = timers_.pass("shadow-width/rows");
        edgeRows_.use();
        columns_.bind(0);
        edges_.bindImage(0, GL_READ_WRITE);
        widths_.bindImage(1, GL_WRITE_ONLY);
        glUniform1i(0, depthMap_.count());
        dispatchLines(mapSize_px_, layers);
    }
}

void ShadowWidthMap::composite() {
    allocateWidths(depthMap_.count(), true);
    const auto pass = timers_.pass("shadow-width/compositing");
    composite_.use();
    depthMap_.texture().bind(0);
    const auto step = [&](int neighbours, float distance_px, float difference) {
        scratch_.bind(1);
        widths_.bindImage(0, GL_WRITE_ONLY);
        glUniform1i(0, neighbours);
        glUniform1f(1, distance_px);
        glUniform1f(2, difference);
        glUniform1f(3, background());
        const auto groups = GLuint((mapSize_px_ + 7) / 8);
        glDispatchCompute(groups, groups, GLuint(depthMap_.count()));
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    };
    step(0, 0, 0);
    float distance_px = 1;
    for (float difference = startDifference(startDifference_); difference <= 1;
         difference *= 2, distance_px *= 2) {
        std::swap(widths_, scratch_);
        step(neighbourCount(neighbours_), distance_px, difference);
    }
}

void ShadowWidthMap::sweepOnCpu() {
    allocateWidths(depthMap_.count(), false);
    const auto pass = timers_.pass("shadow-width/sweeps on the CPU");
    const auto texels = std::size_t(mapSize_px_) * std::size_t(mapSize_px_);
    std::vector<float> depths(texels);
    const auto blocked = std::make_unique<bool[]>(texels);
    for (int layer = 0; layer < depthMap_.count(); ++layer) {
        glGetTextureSubImage(depthMap_.texture().name(), 0, 0, 0, layer, mapSize_px_, mapSize_px_, 1,
                             GL_DEPTH_COMPONENT, GL_FLOAT, GLsizei(texels * sizeof(float)), depths.data());
        std::ranges::transform(depths, blocked.get(), [&](float depth) { return depth != background(); });
        const std::vector<float> widths =
            sweepShadowWidths({blocked.get(), texels}, mapSize_px_, startDifference(startDifference_));
        glTextureSubImage3D(widths_.name(), 0, 0, 0, layer, mapSize_px_, mapSize_px_, 1, GL_RED, GL_FLOAT,
                            widths.data());
    }
}

ShadowWidthConstants ShadowWidthMap::constants(const AreaLight& light) const {
    ShadowWidthConstants result{};
    float halfExtent = light.radius_m;
    if (light.shape == LightShape::rect) {
        result.halfAxisX.x = 0.5f * light.width_m;
        result.halfAxisY.y = 0.5f * light.height_m;
        halfExtent = 0.25f * (light.width_m + light.height_m);
    } else if (light.shape == LightShape::disk) {
        result.halfAxisX.x = result.halfAxisY.y = light.radius_m;
    } else {
        // Near 180 degrees a tangent says nothing any more.
        if (light.shape == LightShape::distant) halfExtent = std::tan(0.5f * std::min(light.angle_rad, 3.0f));
        result.halfAxisX.w = halfExtent;
    }
    result.halfAxisY.w = halfExtent;
    const float largest =
        light.shape == LightShape::rect ? 0.5f * std::hypot(light.width_m, light.height_m) : halfExtent;
    result.attenuation = {physical_ ? -1 : cScale_, cBias_, 1 / startDifference(startDifference_), 0};
    result.extent.x = largest;
    result.light = {int(light.shape), depthMap_.count(), isOneSided(light), hasInnerEdges_};
    return result;
}

void ShadowWidthMap::resolve(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld,
                             VisibilityBuffer& out) {
    view_.bind(inputs.view, lightFromWorld);
    constants_.write(constants(inputs.light));
    constants_.bindUniform(1);
    depthMap_.bind(3, 0);
    widths_.bind(4);
    bindVisibility(out, 0);
    if (mode_ == exact) {
        resolveExact(out);
    } else {
        resolvePublished(out);
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ShadowWidthMap::resolveExact(const VisibilityBuffer& out) {
    const std::size_t tiles = std::size_t((out.width_px() + 7) / 8) * std::size_t((out.height_px() + 7) / 8);
    if (listedTiles_.size_bytes() < tiles * sizeof(GLuint)) {
        listedTiles_ = gl::Buffer(tiles * sizeof(GLuint), "listed tiles");
        penumbraTiles_ = gl::Buffer((4 + tiles) * sizeof(GLuint), "penumbra tiles");
    }
    const std::array<GLuint, 4> noTiles = {0, 1, 1, 0};
    penumbraTiles_.write(std::as_bytes(std::span(noTiles)));
    glClearNamedBufferData(listedTiles_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, penumbraTiles_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, listedTiles_.name());
    edges_.bind(5);
    {
        const auto pass = timers_.pass("shadow-width/resolve");
        resolve_.use();
        gl::dispatchPixels(out.width_px(), out.height_px());
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    }
    {
        const auto pass = timers_.pass("shadow-width/penumbra");
        penumbra_.use();
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, penumbraTiles_.name());
        glDispatchComputeIndirect(0);
    }
}

void ShadowWidthMap::resolvePublished(const VisibilityBuffer& out) {
    const auto pass = timers_.pass("shadow-width/resolve");
    if (tabulatedCurve_ != curve_) setAttenuation(curve_ == 0 ? linearAttenuation : smoothAttenuation);
    published_.use();
    curveTable_.bind(5);
    glUniform1f(0, background());
    glUniform1f(1, attenuationTableEnd);
    gl::dispatchPixels(out.width_px(), out.height_px());
}

void ShadowWidthMap::inspect(InspectionVisitor& visitor) const {
    const int count = depthMap_.count();
    visitor.texture({.name = "depth map", .texture = depthMap_.texture().name(), .layers = count});
    if (widths_.name() == 0) return;
    if (mode_ == exact) {
        visitor.texture({.name = "distance to the nearest edge",
                         .texture = widths_.name(),
                         .layers = count * (hasInnerEdges_ ? 2 : 1),
                         .white = 64});
    } else {
        visitor.texture({.name = "shadow-width map", .texture = widths_.name(), .layers = count});
    }
}

Statistics ShadowWidthMap::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    statistics.counts.push_back({"times the maps were made", double(timesMade_)});
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra
