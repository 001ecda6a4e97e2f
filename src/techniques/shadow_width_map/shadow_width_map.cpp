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

constexpr int groupsFor(int invocations, int groupSize) {
    return (invocations + groupSize - 1) / groupSize;
}

/// One invocation a line of cells.
void dispatchLines(int lines, int layers) {
    glDispatchCompute(GLuint(groupsFor(lines, 16)), GLuint(layers), 1);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

std::vector<std::string> shader(const char* name) {
    return {std::string("src/techniques/shadow_width_map/") + name};
}

std::array<gl::Program, 4> variantsByKinds(Device& device, const char* name) {
    gl::ShaderLibrary& library = device.internals().shaders;
    return {gl::Program(library, shader(name)),
            gl::Program(library, shader(name), {"ONE_MAP", "WITH_NORMALS", "KINDS 1"}),
            gl::Program(library, shader(name), {"ONE_MAP", "WITH_NORMALS", "KINDS 2"}),
            gl::Program(library, shader(name), {"ONE_MAP", "WITH_NORMALS", "KINDS 3"})};
}

/// Arguments of an indirect dispatch of as many groups as have been listed, before any has.
constexpr std::array<GLuint, 4> nothingListed = {0, 1, 1, 0};

/// Half the light's largest extent; of a distant light, as a tangent.
float largestHalfExtent(const AreaLight& light) {
    if (light.shape == LightShape::rect) return 0.5f * std::hypot(light.width_m, light.height_m);
    // Near 180 degrees a tangent says nothing any more.
    return light.shape == LightShape::distant ? std::tan(0.5f * std::min(light.angle_rad, 3.0f))
                                              : light.radius_m;
}

}  // namespace

ShadowWidthMap::ShadowWidthMap(Device& device)
    : depthMap_(device),
      farthestMap_(device),
      edgeBlocks_(device.internals().shaders, shader("edge_blocks.comp.glsl")),
      cellEdges_(device.internals().shaders, shader("cell_edges.comp.glsl")),
      edgeColumns_(device.internals().shaders, shader("edge_columns.comp.glsl")),
      edgeRows_(device.internals().shaders, shader("edge_rows.comp.glsl")),
      resolve_(device.internals().shaders, shader("resolve.comp.glsl")),
      resolveOneMap_(device.internals().shaders, shader("resolve.comp.glsl"), {"ONE_MAP", "WITH_NORMALS"}),
      penumbra_(variantsByKinds(device, "penumbra.comp.glsl")),
      crowded_(variantsByKinds(device, "crowded.comp.glsl")),
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
    visitor.boolean(
        {.name = "hidden_edges",
         .help =
             "with inner edges: penumbrae of what ends beneath another caster, too, from a second depth map"},
        hiddenEdges_);
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
    curveTable_ = gl::Texture({.width_px = entries,
                               .format = gl::Format::r32f,
                               .filter = gl::Filter::linear,
                               .label = "attenuation"});
    glTextureSubImage2D(curveTable_.name(), 0, 0, 0, entries, 1, GL_RED, GL_FLOAT, table.data());
    tabulatedCurve_ = curve_;
}

void ShadowWidthMap::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras = fitMapCameras(inputs.light, scene, mapSize_px_);

    std::pmr::vector<double> key{
        {double(mode_), double(mapSize_px_), double(innerEdges_), double(hiddenEdges_), double(neighbours_),
         double(startDifference_), double(largestHalfExtent(inputs.light))},
        gl::LedgerScope::frameMemory()};
    appendMapKey(key, inputs, scene, cameras);
    // Without a revision nobody can tell whether a mask's texels have changed.
    const bool mayChangeUnseen = std::ranges::any_of(inputs.casters, [](const Caster& caster) {
        return caster.alphaMask.texture != 0 && caster.alphaMask.revision == 0;
    });
    if (!reuseMaps_ || mayChangeUnseen || !std::ranges::equal(key, mapsMadeFrom_)) {
        mapsMadeFrom_.clear();
        makeMaps(inputs, scene, cameras);
        mapsMadeFrom_.assign(key.begin(), key.end());
        ++timesMade_;
    }
    resolve(inputs, lightFromWorldMatrix, out);
}

void ShadowWidthMap::makeMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                              std::span<const LightCamera> cameras) {
    const bool isAnyBoth = std::ranges::any_of(
        inputs.casters, [](const Caster& caster) { return caster.casts && caster.receives; });
    backFaces_ = mode_ != exact && !isAnyBoth;
    {
        const auto pass = timers_.pass("shadow-width/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_,
                         backFaces_ ? DepthMap::Surface::farthestBack : DepthMap::Surface::nearest);
        kinds_ = mode_ == exact && innerEdges_ && isAnyBoth ? 2 : 1;
        if (mode_ == exact && innerEdges_ && hiddenEdges_) {
            const std::pmr::vector<Caster> hiding = castersThatHideEdges(inputs, scene, cameras);
            if (!hiding.empty()) {
                kinds_ = 3;
                farthestMap_.render(hiding, scene, cameras, mapSize_px_, DepthMap::Surface::farthestFront);
            }
        }
    }
    if (cameras.empty()) return;
    faceFromLight_ = cameras.front().faceFromLight;
    firstCamera_ = cameras.front().constants(mapSize_px_);
    firstCamera_.faceFromLight = glm::mat4(1);
    if (mode_ == exact) {
        findNearestEdges(inputs.light);
    } else if (mode_ == compositing) {
        composite();
    } else {
        sweepOnCpu();
    }
}

/// Small enough to keep apart what lies side by side, large enough that the nearest edge of every cell costs
/// little beside drawing the map.
int ShadowWidthMap::cell_px() const {
    return mapSize_px_ <= 128 ? 1 : mapSize_px_ <= 256 ? 2 : mapSize_px_ <= 1024 ? 4 : 8;
}

void ShadowWidthMap::allocate(gl::Texture& texture, int size_px, int layers, gl::Format format,
                              std::string_view label) const {
    if (texture.width_px() == size_px && texture.layers() >= layers) return;
    texture = {};  // freed first, so that the two need not fit together
    texture = gl::Texture(
        {.width_px = size_px, .height_px = size_px, .layers = layers, .format = format, .label = label});
}

void ShadowWidthMap::allocateWidths(bool scratch) {
    allocate(widths_, mapSize_px_, depthMap_.count(), gl::Format::r32f, "shadow widths");
    if (scratch)
        allocate(scratch_, mapSize_px_, depthMap_.count(), gl::Format::r32f, "shadow widths, before a step");
}

void ShadowWidthMap::findNearestEdges(const AreaLight& light) {
    const int layers = depthMap_.count() * kinds_;
    allocate(cells_, cellsAcross(), layers, gl::Format::rgba32ui, "edges in cells");
    allocate(columns_, cellsAcross(), layers, gl::Format::rg32f, "nearest edges in columns");
    allocate(nearest_, cellsAcross(), layers, gl::Format::rgba32ui, "nearest edges");
    allocate(cellWidths_, cellsAcross(), layers, gl::Format::rg32f, "shadow widths of cells");
    const int blocks = groupsFor(mapSize_px_, 8);
    const auto listSize_bytes = std::size_t(4 + blocks * blocks * depthMap_.count()) * sizeof(GLuint);
    if (listedBlocks_.size_bytes() < listSize_bytes)
        listedBlocks_ = gl::Buffer(listSize_bytes, "edge blocks");
    listedBlocks_.write(std::as_bytes(std::span(nothingListed)));
    glClearTexImage(cells_.name(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);

    depthMap_.bind(3, 0);
    if (kinds_ == 3) farthestMap_.texture().bind(2);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, listedBlocks_.name());
    {
        const auto pass = timers_.pass("shadow-width/blocks");
        edgeBlocks_.use();
        glUniform1i(0, kinds_);
        glDispatchCompute(GLuint(groupsFor(blocks, 8)), GLuint(groupsFor(blocks, 8)),
                          GLuint(depthMap_.count()));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    }
    {
        const auto pass = timers_.pass("shadow-width/cells");
        cellEdges_.use();
        cells_.bindImage(0, GL_WRITE_ONLY);
        glUniform1i(0, kinds_);
        glUniform1i(1, cell_px());
        glUniform1i(2, depthMap_.count());
        gl::dispatchIndirect(listedBlocks_);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    {
        const auto pass = timers_.pass("shadow-width/columns");
        edgeColumns_.use();
        cells_.bind(0);
        columns_.bindImage(0, GL_READ_WRITE);
        glUniform1i(1, cell_px());
        dispatchLines(cellsAcross(), layers);
    }
    {
        const auto pass = timers_.pass("shadow-width/rows");
        edgeRows_.use();
        columns_.bind(1);
        nearest_.bindImage(0, GL_READ_WRITE);
        cellWidths_.bindImage(1, GL_READ_WRITE);
        glUniform1i(0, kinds_);
        glUniform1i(1, cell_px());
        glUniform1i(2, depthMap_.count());
        glUniform1f(3, largestHalfExtent(light));
        dispatchLines(cellsAcross(), depthMap_.count());
    }
}

void ShadowWidthMap::composite() {
    allocateWidths(true);
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
    allocateWidths(false);
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

ShadowWidthConstants ShadowWidthMap::constants(const AreaLight& light,
                                               const glm::dmat3& spaceFromLight) const {
    ShadowWidthConstants result{};
    float halfExtent = light.radius_m;
    if (light.shape == LightShape::rect) {
        result.halfAxisX.x = 0.5f * light.width_m;
        result.halfAxisY.y = 0.5f * light.height_m;
        halfExtent = 0.25f * (light.width_m + light.height_m);
    } else if (light.shape == LightShape::disk) {
        result.halfAxisX.x = result.halfAxisY.y = light.radius_m;
    } else {
        halfExtent = largestHalfExtent(light);
        result.halfAxisX.w = halfExtent;
    }
    result.halfAxisY.w = halfExtent;
    result.halfAxisX = glm::vec4(spaceFromLight * glm::dvec3(result.halfAxisX), result.halfAxisX.w);
    result.halfAxisY = glm::vec4(spaceFromLight * glm::dvec3(result.halfAxisY), result.halfAxisY.w);
    result.emission = glm::dvec4(spaceFromLight * glm::dvec3(0, 0, -1), 0);
    result.attenuation = {physical_ ? -1 : cScale_, cBias_, 1 / startDifference(startDifference_), 0};
    result.extent.x = largestHalfExtent(light);
    result.light = {int(light.shape), depthMap_.count(), isOneSided(light), kinds_};
    result.firstCamera = firstCamera_;
    result.cells = {cell_px(), cellsAcross(), 0, 0};
    return result;
}

void ShadowWidthMap::resolve(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld,
                             VisibilityBuffer& out) {
    // With one map, shaders work in that map's space, which spares them a transform.
    const bool isOneMap = depthMap_.count() == 1;
    const glm::dmat4 faceFromLight = isOneMap ? faceFromLight_ : glm::dmat4(1);
    view_.bind(inputs.view, faceFromLight * lightFromWorld);
    constants_.write(constants(inputs.light, glm::dmat3(faceFromLight)));
    constants_.bindUniform(1);
    depthMap_.bind(3, 0);
    bindVisibility(out, 0);
    if (mode_ == exact) {
        resolveExact(inputs.view, out);
    } else {
        resolvePublished(out);
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ShadowWidthMap::resolveExact(const View& view, const VisibilityBuffer& out) {
    const std::size_t pixels = std::size_t(out.width_px()) * std::size_t(out.height_px());
    for (gl::Buffer* list : {&penumbraPixels_, &crowdedPixels_}) {
        if (list->size_bytes() < (4 + pixels) * sizeof(GLuint))
            *list = gl::Buffer((4 + pixels) * sizeof(GLuint), "pixels in penumbrae");
        list->write(std::as_bytes(std::span(nothingListed)));
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, penumbraPixels_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, crowdedPixels_.name());
    const bool isOneMap = depthMap_.count() == 1 && view.normalTexture != 0;
    const std::size_t variant = isOneMap ? std::size_t(kinds_) : 0;
    {
        const auto pass = timers_.pass("shadow-width/resolve");
        (isOneMap ? resolveOneMap_ : resolve_).use();
        cellWidths_.bind(4);
        gl::dispatchPixels(out.width_px(), out.height_px());
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    }
    nearest_.bind(4);
    if (kinds_ == 3) farthestMap_.texture().bind(5);
    cellWidths_.bind(6);
    {
        const auto pass = timers_.pass("shadow-width/penumbra");
        penumbra_[variant].use();
        gl::dispatchIndirect(penumbraPixels_);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    {
        const auto pass = timers_.pass("shadow-width/crowded");
        crowded_[variant].use();
        gl::dispatchIndirect(crowdedPixels_);
    }
}

void ShadowWidthMap::resolvePublished(const VisibilityBuffer& out) {
    const auto pass = timers_.pass("shadow-width/resolve");
    if (tabulatedCurve_ != curve_) setAttenuation(curve_ == 0 ? linearAttenuation : smoothAttenuation);
    published_.use();
    widths_.bind(4);
    curveTable_.bind(5);
    glUniform1f(0, background());
    glUniform1f(1, attenuationTableEnd);
    gl::dispatchPixels(out.width_px(), out.height_px());
}

void ShadowWidthMap::inspect(InspectionVisitor& visitor) const {
    const int count = depthMap_.count();
    visitor.texture({.name = "depth map", .texture = depthMap_.texture().name(), .layers = count});
    if (mode_ == exact && cellWidths_.name() != 0) {
        visitor.texture({.name = "distance to the nearest edge",
                         .texture = cellWidths_.name(),
                         .layers = count * kinds_,
                         .white = 64});
    } else if (mode_ != exact && widths_.name() != 0) {
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
