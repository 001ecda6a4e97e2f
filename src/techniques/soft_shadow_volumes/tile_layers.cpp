// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/tile_layers.h"

#include <algorithm>
#include <bit>
#include <string>

#include "src/geometry/edge_mesh.h"

namespace penumbra::soft_shadow_volumes {
namespace {

std::string shader(std::string_view name) {
    return "src/techniques/soft_shadow_volumes/" + std::string(name) + ".comp.glsl";
}

constexpr int smallTile_px = 8;
constexpr int largeTile_px = 32;
/// The lists of large tiles, which are made larger rather than exceed this.
constexpr std::size_t largestLists_bytes = std::size_t(64) << 20;
/// What paused tiles keep: the picture is worked on in bands of tiles, so many as fit in here.
constexpr std::size_t largestStates_bytes = std::size_t(64) << 20;

/// What soft_resolve.comp.glsl keeps of a tile between rounds.
std::size_t stateBytes(int samples) {
    return std::size_t(samples + 6) * smallTile_px * smallTile_px * sizeof(int);
}

/// How many edges soft_resolve.comp.glsl takes at once: so few that they take no longer than a round does,
/// were every point of the light looked at for each. A power of two from 32 to 1,024.
unsigned edgesAtOnce(int samples) {
    return std::max(std::bit_floor(unsigned(16384 / samples)), 32u);
}

}  // namespace

TileLayers::TileLayers(Device& device)
    : device_(internalsOf(device)),
      gather_(device_.shaders, {shader("soft_gather")}),
      cuts_(device_.shaders, {shader("soft_cuts")}),
      boxes_(device_.shaders, {shader("soft_boxes")}),
      bounds_(device_.shaders, {shader("soft_bounds")}),
      lists_(device_.shaders, {shader("soft_lists")}),
      clusters_(device),
      centerCounts_(device),
      maskedPoints_(device),
      points_(device),
      largestBlock_bytes_(device_.largestStorageBlock_bytes) {}

void TileLayers::prepare(VolumeFrame& frame, Effort effort) {
    effort_ = effort;
    std::size_t records = 0;
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const Mesh& mesh = *frame.sources[i].mesh;
        const std::size_t pairs = edgesOf(mesh).pairCount();
        const std::size_t triangles = mesh.indices().size() / 3;
        // Where a flat light may be cut through, an edge has a part on both of its sides, and a triangle its
        // cut; where a sphere may, each triangle may reach into it.
        const bool isSphere = frame.constants.light.shape == shapeSphere;
        records += !frame.cutsLight[i] ? pairs : isSphere ? pairs + triangles : 2 * (pairs + triangles);
    }
    // Few edges of so many matter to a light that is not as large as they are.
    const std::size_t room_bytes = std::min(largestBlock_bytes_, std::size_t(effort.edgeMemory_MiB) << 20);
    recordCount_ = std::min(records, room_bytes / sizeof(LightEdge) / 32 * 32);
    isLimited_ = recordCount_ < records;
    const std::size_t words = (recordCount_ + 31) / 32;
    lightEdges_.reserve(words * 32 * sizeof(LightEdge), "soft-volumes/edges");
    wordBoxes_.reserve(words * sizeof(TriangleCluster), "soft-volumes/boxes of edges");

    const glm::ivec2 size_px = frame.constants.buffer_px;
    const auto tilesOf = [&](int tile_px) { return (size_px + tile_px - 1) / tile_px; };
    const glm::ivec2 smallTiles = tilesOf(smallTile_px);
    tileBounds_.reserve(std::size_t(smallTiles.x) * std::size_t(smallTiles.y) * 2 * sizeof(glm::vec4),
                        "soft-volumes/tile bounds");
    int large_px = largeTile_px;
    const auto listBytes = [&] {
        const glm::ivec2 tiles = tilesOf(large_px);
        return std::size_t(tiles.x) * std::size_t(tiles.y) * words * sizeof(uint);
    };
    while (listBytes() > largestLists_bytes && large_px < std::max(size_px.x, size_px.y)) large_px *= 2;
    tileLists_.reserve(listBytes(), "soft-volumes/tile lists");
    frame.constants.smallTilesAcross = uint(smallTiles.x);
    frame.constants.largeTilesAcross = uint(tilesOf(large_px).x);
    frame.constants.smallTilesALargeOne = uint(large_px / smallTile_px);
    frame.constants.listWords = uint(words);

    edgeCounts_.fit({.width_px = size_px.x,
                     .height_px = size_px.y,
                     .format = gl::Format::r32f,
                     .label = "soft-volumes/edges a pixel"});
}

void TileLayers::makeResolve() {
    if (resolveSamples_ == points_.count()) return;
    resolve_ = gl::Program(device_.shaders, {shader("soft_resolve")},
                           {"SAMPLES " + std::to_string(points_.count()),
                            "EDGES_AT_ONCE " + std::to_string(edgesAtOnce(points_.count()))});
    resolveSamples_ = points_.count();
}

void TileLayers::gatherEdges(const VolumeFrame& frame, const FrameBinding& binding,
                             const VolumeCounter& counter) {
    const auto forEach = [&](gl::Program& program, auto&& countOf) {
        gl::Pass pass(program);
        pass.bind(binding).bind("Eye", counter.eye()).bind("LightEdges", lightEdges_);
        for (std::size_t i = 0; i < frame.sources.size(); ++i) {
            const std::size_t count = countOf(pass, i);
            if (count == 0) continue;
            bindMesh(pass, *frame.sources[i].mesh);
            pass.constants(meshConstants(frame, i, count)).dispatch((count + 255) / 256);
        }
    };
    forEach(gather_, [&](gl::Pass& pass, std::size_t i) {
        const EdgeMesh& edges = edgesOf(*frame.sources[i].mesh);
        pass.bind("Edges", edges.edges()).bind("EdgeFaces", edges.faces());
        return edges.edgeCount();
    });
    forEach(cuts_, [&](gl::Pass&, std::size_t i) {
        return frame.cutsLight[i] ? frame.sources[i].mesh->indices().size() / 3 : 0;
    });
    gl::Pass(boxes_)
        .bind(binding)
        .bind("LightEdges", lightEdges_)
        .bind("Eye", counter.eye())
        .bind("WordBoxes", wordBoxes_)
        .dispatch((frame.constants.listWords + 63) / 64);
}

void TileLayers::boundTiles(const VolumeFrame& frame, const FrameBinding& binding,
                            const VolumeCounter& counter) {
    gl::Pass(bounds_)
        .bind(binding)
        .bind("liftedDepths", counter.depth())
        .bind("Bounds", tileBounds_)
        .dispatchPixels(frame.constants.buffer_px.x, frame.constants.buffer_px.y);
}

void TileLayers::listEdges(const VolumeFrame& frame, const FrameBinding& binding,
                           const VolumeCounter& counter) {
    const VolumeConstants& constants = frame.constants;
    const int large_px = int(constants.smallTilesALargeOne) * smallTile_px;
    gl::Pass(lists_)
        .bind(binding)
        .bind("Bounds", tileBounds_)
        .bind("LightEdges", lightEdges_)
        .bind("Eye", counter.eye())
        .bind("WordBoxes", wordBoxes_)
        .bind("Lists", tileLists_)
        .dispatch(constants.largeTilesAcross, std::size_t((constants.buffer_px.y + large_px - 1) / large_px),
                  constants.listWords / 512 + 1);
}

void TileLayers::resolve(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter,
                         const gl::TextureRef& target) {
    const VolumeConstants& constants = frame.constants;
    const std::size_t across = constants.smallTilesAcross;
    const int rows = (constants.buffer_px.y + smallTile_px - 1) / smallTile_px;
    // A round does `roundWork`, unless nothing is left; all there may be is every edge, for every point. The
    // shader counts 16 besides for an edge, and 32 for looking through 64 words of a list, which it does once
    // more in each round.
    const unsigned looks = constants.listWords / 64 + 1;
    const double work = double(recordCount_) * (points_.count() + 16) + 32.0 * looks;
    const int rounds = 1 + int(work / (effort_.roundWork - 32));
    const int fitting = std::max(int(largestStates_bytes / (stateBytes(points_.count()) * across)), 1);
    const int bandRows = rounds > 1 ? std::min(fitting, rows) : rows;
    const std::size_t bandTiles = std::size_t(bandRows) * across;
    states_.reserve(rounds > 1 ? bandTiles * stateBytes(points_.count()) : 0, "soft-volumes/states");
    // One round more than there are: none is asked for, but its arguments are within reach of the shader.
    const std::size_t lists = 3 * std::size_t(rounds + 1);
    rounds_.reserve((lists + 2 * bandTiles) * sizeof(GLuint), "soft-volumes/rounds");

    for (int row = 0; row < rows; row += bandRows) {
        rounds_.clear(0, lists * sizeof(GLuint));
        gl::Pass pass(resolve_);
        pass.bind(binding)
            .bind(Receivers{tileBounds_, counter.depth()})
            .bind(points_)
            .bind("LightEdges", lightEdges_)
            .bind("Eye", counter.eye())
            .bind("Lists", tileLists_)
            .bind("States", states_)
            .bind("Rounds", rounds_)
            .bind("centerCounts", centerCounts_.counts())
            .bind("hiddenPoints", maskedPoints_.hidden())
            .bind("visibility", target)
            .bind("edgeCounts", edgeCounts_)
            .bind("shownCounts", counter.counts())
            .inOrder();
        for (int round = 0; round < rounds; ++round) {
            const std::size_t other = lists + bandTiles;
            const bool isEven = round % 2 == 0;
            pass.constants(ResolveConstants{.firstTile = uint(std::size_t(row) * across),
                                            .round = uint(round),
                                            .roundWork = uint(effort_.roundWork),
                                            .thisList = uint(isEven ? lists : other),
                                            .nextList = uint(isEven ? other : lists),
                                            .hasMasks = !frame.masked.empty()});
            if (round == 0) {
                pass.dispatch(across, std::size_t(std::min(bandRows, rows - row)));
            } else {
                // Without groups where nobody asked for the round.
                pass.dispatchIndirect(rounds_, 3 * sizeof(GLuint) * std::size_t(round));
            }
        }
    }
}

void TileLayers::render(const VolumeFrame& frame, const FrameBinding& binding, const AreaLight& light,
                        const VolumeCounter& counter, const gl::TextureRef& target, gl::PassTimers& timers) {
    const Receivers receivers{tileBounds_, counter.depth()};
    {
        const auto pass = timers.pass("soft-volumes/count");
        boundTiles(frame, binding, counter);
        clusters_.allocate(frame);
        centerCounts_.count(frame, binding, clusters_, receivers);
    }
    {
        const auto pass = timers.pass("soft-volumes/edges");
        gatherEdges(frame, binding, counter);
        points_.place(light, binding, effort_.samples);
        makeResolve();
    }
    {
        const auto pass = timers.pass("soft-volumes/masks");
        maskedPoints_.mark(frame, binding, clusters_, points_, receivers);
    }
    {
        const auto pass = timers.pass("soft-volumes/tile lists");
        listEdges(frame, binding, counter);
    }
    const auto pass = timers.pass("soft-volumes/visibility");
    resolve(frame, binding, counter, target);
}

std::size_t TileLayers::edgesWithoutRoom(const VolumeCounter& counter) const {
    if (!isLimited_) return 0;
    EyeState eye;
    counter.eye().read(std::as_writable_bytes(std::span(&eye, 1)));
    return eye.edgeCount > recordCount_ ? eye.edgeCount - recordCount_ : 0;
}

std::size_t TileLayers::size_bytes() const {
    return lightEdges_.size_bytes() + wordBoxes_.size_bytes() + tileBounds_.size_bytes() +
           tileLists_.size_bytes() + states_.size_bytes() + rounds_.size_bytes() + clusters_.size_bytes();
}

}  // namespace penumbra::soft_shadow_volumes
