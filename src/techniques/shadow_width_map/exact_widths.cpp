// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/exact_widths.h"

#include <algorithm>

#include "src/techniques/common/overlapping_casters.h"

namespace penumbra::shadow_width_map {
namespace {

/// Texels along a block (edge_blocks.glsl), and lines of cells that a group sweeps.
constexpr int block_px = 8, linesAGroup = 16;

constexpr int groupsFor(int invocations, int groupSize) {
    return (invocations + groupSize - 1) / groupSize;
}

std::vector<std::string> shader(const char* name) {
    return {std::string("src/techniques/shadow_width_map/") + name};
}

std::array<gl::Program, 4> variantsByKinds(Device& device, const char* name) {
    gl::ShaderLibrary& library = internalsOf(device).shaders;
    return {gl::Program(library, shader(name)),
            gl::Program(library, shader(name), {"ONE_MAP", "WITH_NORMALS", "KINDS 1"}),
            gl::Program(library, shader(name), {"ONE_MAP", "WITH_NORMALS", "KINDS 2"}),
            gl::Program(library, shader(name), {"ONE_MAP", "WITH_NORMALS", "KINDS 3"})};
}

/// Arguments of an indirect dispatch of as many groups as have been listed, before any has; and how many
/// entries the list that follows has.
constexpr std::array<GLuint, 4> nothingListed = {0, 1, 1, 0};

void beginList(gl::Buffer& list, std::size_t most, std::string_view label) {
    list.reserve((nothingListed.size() + most) * sizeof(GLuint), label);
    list.write(std::as_bytes(std::span(nothingListed)));
}

}  // namespace

ExactWidths::ExactWidths(Device& device)
    : farthest_(device),
      edgeBlocks_(internalsOf(device).shaders, shader("edge_blocks.comp.glsl")),
      cellEdges_(internalsOf(device).shaders, shader("cell_edges.comp.glsl")),
      edgeColumns_(internalsOf(device).shaders, shader("edge_columns.comp.glsl")),
      edgeRows_(internalsOf(device).shaders, shader("edge_rows.comp.glsl")),
      resolve_(internalsOf(device).shaders, shader("resolve.comp.glsl")),
      resolveOneMap_(internalsOf(device).shaders, shader("resolve.comp.glsl"), {"ONE_MAP", "WITH_NORMALS"}),
      penumbra_(variantsByKinds(device, "penumbra.comp.glsl")),
      crowded_(variantsByKinds(device, "crowded.comp.glsl")) {}

void ExactWidths::describe(ParameterVisitor& visitor) {
    visitor.boolean(
        {.name = "inner_edges",
         .help = "exact mode: penumbrae on casters too, from edges where casters overlap in the map"},
        innerEdges_);
    visitor.boolean(
        {.name = "hidden_edges",
         .help =
             "with inner edges: penumbrae of what ends beneath another caster, too, from a second depth map"},
        hiddenEdges_);
}

void ExactWidths::appendKey(std::pmr::vector<double>& key) const {
    key.insert(key.end(), {double(innerEdges_), double(hiddenEdges_)});
}

/// Small enough to keep apart what lies side by side, large enough that the nearest edge of every cell costs
/// little beside drawing the map.
int ExactWidths::cell_px(int mapSize_px) {
    return mapSize_px <= 128 ? 1 : mapSize_px <= 256 ? 2 : mapSize_px <= 1024 ? 4 : 8;
}

int ExactWidths::cellsAcross(int mapSize_px) {
    return groupsFor(mapSize_px, cell_px(mapSize_px));
}

gl::TextureRef ExactWidths::farthestMap() const {
    return kinds_ == 3 ? farthest_.texture().ref() : gl::TextureRef{};
}

void ExactWidths::make(const ShadowInputs& inputs, const LightSpaceScene& scene,
                       std::span<const LightCamera> cameras, const DepthMap& depthMap, float halfExtent,
                       gl::PassTimers& timers) {
    const bool isAnyBoth = std::ranges::any_of(
        inputs.casters, [](const Caster& caster) { return caster.casts && caster.receives; });
    kinds_ = innerEdges_ && isAnyBoth ? 2 : 1;
    mapCount_ = depthMap.count();
    if (innerEdges_ && hiddenEdges_) {
        const std::pmr::vector<Caster> hiding = overlappingCasters(inputs, scene, cameras);
        if (!hiding.empty()) {
            const auto pass = timers.pass("shadow-width/farthest map");
            kinds_ = 3;
            farthest_.render(hiding, scene, cameras, depthMap.texture().width_px(),
                             DepthMap::Surface::farthestFront);
        }
    }
    if (mapCount_ > 0) findNearest(depthMap, halfExtent, timers);
}

void ExactWidths::findNearest(const DepthMap& depthMap, float halfExtent, gl::PassTimers& timers) {
    const int mapSize_px = depthMap.texture().width_px(), across = cellsAcross(mapSize_px);
    const int layers = mapCount_ * kinds_;
    const auto fit = [&](gl::Texture& texture, gl::Format format, std::string_view label) {
        texture.fit(
            {.width_px = across, .height_px = across, .layers = layers, .format = format, .label = label});
    };
    fit(cells_, gl::Format::rgba32ui, "edges in cells");
    fit(columns_, gl::Format::rg32f, "nearest edges in columns");
    fit(nearest_, gl::Format::rgba32ui, "nearest edges");
    fit(cellWidths_, gl::Format::rg32f, "shadow widths of cells");
    const int blocks = groupsFor(mapSize_px, block_px);
    beginList(listedBlocks_, std::size_t(blocks) * std::size_t(blocks) * std::size_t(mapCount_),
              "edge blocks");
    cells_.clear();

    const EdgeConstants constants{
        .kinds = kinds_, .cell_px = cell_px(mapSize_px), .mapCount = mapCount_, .halfExtent = halfExtent};
    const auto maps = std::size_t(mapCount_);
    {
        const auto pass = timers.pass("shadow-width/blocks");
        const auto groups = std::size_t(groupsFor(blocks, 8));
        gl::Pass(edgeBlocks_)
            .constants(constants)
            .bind(depthMap)
            .bind("farthestMaps", farthestMap())
            .bind("EdgeBlocks", listedBlocks_)
            .dispatch(groups, groups, maps);
    }
    {
        const auto pass = timers.pass("shadow-width/cells");
        gl::Pass(cellEdges_)
            .constants(constants)
            .bind(depthMap)
            .bind("farthestMaps", farthestMap())
            .bind("EdgeBlocks", listedBlocks_)
            .bind("cellEdges", cells_)
            .dispatchIndirect(listedBlocks_);
    }
    const auto lines = std::size_t(groupsFor(across, linesAGroup));
    {
        const auto pass = timers.pass("shadow-width/columns");
        gl::Pass(edgeColumns_)
            .constants(constants)
            .bind("cellEdges", cells_)
            .bind("columns_px", columns_)
            .dispatch(lines, std::size_t(layers));
    }
    {
        const auto pass = timers.pass("shadow-width/rows");
        gl::Pass(edgeRows_)
            .constants(constants)
            .bind(depthMap)
            .bind("cellEdges", cells_)
            .bind("columns_px", columns_)
            .bind("nearestEdges", nearest_)
            .bind("widths", cellWidths_)
            .dispatch(lines, maps);
    }
}

void ExactWidths::resolve(const ReceiverBinding& receivers, gl::PassTimers& timers) {
    const int width_px = receivers.out.width_px(), height_px = receivers.out.height_px();
    const std::size_t pixels = std::size_t(width_px) * std::size_t(height_px);
    beginList(penumbraPixels_, pixels, "pixels in penumbrae");
    beginList(crowdedPixels_, pixels, "pixels among several edges");
    const bool isOneMap = mapCount_ == 1 && receivers.hasNormals;
    const std::size_t variant = isOneMap ? std::size_t(kinds_) : 0;
    {
        const auto pass = timers.pass("shadow-width/resolve");
        gl::Pass(isOneMap ? resolveOneMap_ : resolve_)
            .bind(receivers)
            .bind("widths", cellWidths_)
            .bind("PenumbraPixels", penumbraPixels_)
            .bind("CrowdedPixels", crowdedPixels_)
            .dispatchPixels(width_px, height_px);
    }
    {
        const auto pass = timers.pass("shadow-width/penumbra");
        gl::Pass(penumbra_[variant])
            .bind(receivers)
            .bind("nearestEdges", nearest_)
            .bind("farthestMaps", farthestMap())
            .bind("widths", cellWidths_)
            .bind("PenumbraPixels", penumbraPixels_)
            .bind("CrowdedPixels", crowdedPixels_)
            .dispatchIndirect(penumbraPixels_);
    }
    {
        const auto pass = timers.pass("shadow-width/crowded");
        gl::Pass(crowded_[variant])
            .bind(receivers)
            .bind("nearestEdges", nearest_)
            .bind("farthestMaps", farthestMap())
            .bind("PenumbraPixels", penumbraPixels_)
            .bind("CrowdedPixels", crowdedPixels_)
            .dispatchIndirect(crowdedPixels_);
    }
}

void ExactWidths::inspect(InspectionVisitor& visitor) const {
    if (cellWidths_.name() == 0) return;
    visitor.texture({.name = "distance to the nearest edge",
                     .texture = cellWidths_.name(),
                     .layers = mapCount_ * kinds_,
                     .white = 64});
}

}  // namespace penumbra::shadow_width_map
