// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/tile_layers.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "src/geometry/edge_mesh.h"

namespace penumbra {
namespace {

std::string shader(std::string_view name) {
    return "src/techniques/soft_shadow_volumes/" + std::string(name) + ".comp.glsl";
}

void reserve(gl::Buffer& buffer, std::size_t size_bytes, std::string_view label) {
    if (buffer.name() != 0 && buffer.size_bytes() >= size_bytes) return;
    buffer = {};
    buffer = gl::Buffer(size_bytes, label);
}

void bindStorage(GLuint block, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, buffer.name());
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
/// were every point of the light looked at for each. A power of two from 64 to 1,024.
unsigned edgesAtOnce(int samples) {
    return std::bit_floor(unsigned(16384 / samples));
}

}  // namespace

TileLayers::TileLayers(Device& device)
    : device_(device.internals()),
      gather_(device_.shaders, {shader("soft_gather")}),
      cuts_(device_.shaders, {shader("soft_cuts")}),
      bounds_(device_.shaders, {shader("soft_bounds")}),
      lists_(device_.shaders, {shader("soft_lists")}),
      clusters_(device),
      centerCounts_(device),
      maskedPoints_(device),
      points_(device) {
    GLint64 largest_bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest_bytes);
    largestBlock_bytes_ = std::size_t(largest_bytes);
}

void TileLayers::prepare(VolumeFrame& frame, Effort effort) {
    effort_ = effort;
    std::size_t records = 0;
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const Mesh& mesh = *frame.sources[i].mesh;
        const std::size_t pairs = edgesOf(mesh).pairCount();
        const std::size_t triangles = mesh.indices().size() / 3;
        // Where a flat light may be cut through, an edge has a part on both of its sides, and a triangle its
        // cut; where a sphere may, each triangle may reach into it.
        const bool isSphere = frame.constants.lightKind.x == int(LightShape::sphere);
        records += !frame.cutsLight[i] ? pairs : isSphere ? pairs + triangles : 2 * (pairs + triangles);
    }
    // Few edges of so many matter to a light that is not as large as they are.
    const std::size_t room_bytes = std::min(largestBlock_bytes_, std::size_t(effort.edgeMemory_MiB) << 20);
    recordCount_ = std::min(records, room_bytes / sizeof(LightEdge) / 32 * 32);
    isLimited_ = recordCount_ < records;
    const std::size_t words = (recordCount_ + 31) / 32;
    reserve(lightEdges_, words * 32 * sizeof(LightEdge), "soft-volumes/edges");

    const glm::ivec2 size_px(frame.constants.buffer_px);
    const auto tilesOf = [&](int tile_px) { return (size_px + tile_px - 1) / tile_px; };
    const glm::ivec2 smallTiles = tilesOf(smallTile_px);
    reserve(tileBounds_, std::size_t(smallTiles.x) * std::size_t(smallTiles.y) * 2 * sizeof(glm::vec4),
            "soft-volumes/tile bounds");
    int large_px = largeTile_px;
    const auto listBytes = [&] {
        const glm::ivec2 tiles = tilesOf(large_px);
        return std::size_t(tiles.x) * std::size_t(tiles.y) * words * sizeof(uint);
    };
    while (listBytes() > largestLists_bytes && large_px < std::max(size_px.x, size_px.y)) large_px *= 2;
    reserve(tileLists_, listBytes(), "soft-volumes/tile lists");
    frame.constants.tiles = {smallTiles.x, tilesOf(large_px).x, large_px / smallTile_px, int(words)};

    if (edgeCounts_.name() == 0 || edgeCounts_.width_px() != size_px.x ||
        edgeCounts_.height_px() != size_px.y) {
        edgeCounts_ = {};
        edgeCounts_ = gl::Texture({.width_px = size_px.x,
                                   .height_px = size_px.y,
                                   .format = gl::Format::r32f,
                                   .label = "soft-volumes/edges a pixel"});
    }
}

void TileLayers::makeResolve() {
    if (resolveSamples_ == points_.count()) return;
    resolve_ = gl::Program(device_.shaders, {shader("soft_resolve")},
                           {"SAMPLES " + std::to_string(points_.count()),
                            "EDGES_AT_ONCE " + std::to_string(edgesAtOnce(points_.count()))});
    resolveSamples_ = points_.count();
}

void TileLayers::gatherEdges(const VolumeFrame& frame, const VolumeCounter& counter) {
    gather_.use();
    bindStorage(2, counter.eye());
    bindStorage(5, lightEdges_);
    const auto bindMesh = [](const SilhouetteSource& source) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, source.mesh->positionBuffer());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, source.mesh->indexBuffer());
        glUniformMatrix4dv(0, 1, GL_FALSE, glm::value_ptr(source.lightFromMesh));
    };
    const auto dispatchEach = [](std::size_t count) {
        glUniform1ui(4, GLuint(count));
        if (count > 0) glDispatchCompute(GLuint(count + 255) / 256, 1, 1);
    };
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const EdgeMesh& edges = edgesOf(*frame.sources[i].mesh);
        bindMesh(frame.sources[i]);
        bindStorage(3, edges.edges());
        bindStorage(4, edges.faces());
        glUniform1i(5, frame.cutsLight[i]);
        dispatchEach(edges.edgeCount());
    }
    cuts_.use();
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        if (!frame.cutsLight[i]) continue;
        bindMesh(frame.sources[i]);
        dispatchEach(frame.sources[i].mesh->indices().size() / 3);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void TileLayers::boundTiles(const VolumeFrame& frame, const VolumeCounter& counter) {
    bounds_.use();
    counter.depth().bind(4);
    bindStorage(0, tileBounds_);
    gl::dispatchPixels(frame.constants.buffer_px.x, frame.constants.buffer_px.y);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void TileLayers::listEdges(const VolumeFrame& frame, const VolumeCounter& counter) {
    const glm::ivec2 size_px(frame.constants.buffer_px);
    const glm::ivec4 tiles = frame.constants.tiles;
    lists_.use();
    bindStorage(0, tileBounds_);
    bindStorage(1, lightEdges_);
    bindStorage(2, counter.eye());
    bindStorage(3, tileLists_);
    const int large_px = tiles.z * smallTile_px;
    glDispatchCompute(GLuint(tiles.y), GLuint((size_px.y + large_px - 1) / large_px),
                      GLuint(tiles.w / 512 + 1));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void TileLayers::resolve(const VolumeFrame& frame, const VolumeCounter& counter) {
    const glm::ivec4 tiles = frame.constants.tiles;
    const int rows = (frame.constants.buffer_px.y + smallTile_px - 1) / smallTile_px;
    // A round does `roundWork`, unless nothing is left; all there may be is every edge, for every point. The
    // shader counts 16 besides for an edge, and 32 for looking through 64 words of a list, which it does once
    // more in each round.
    const int looks = tiles.w / 64 + 1;
    const double work = double(recordCount_) * (points_.count() + 16) + 32.0 * looks;
    const int rounds = 1 + int(work / (effort_.roundWork - 32));
    const int fitting =
        std::max(int(largestStates_bytes / (stateBytes(points_.count()) * std::size_t(tiles.x))), 1);
    const int bandRows = rounds > 1 ? std::min(fitting, rows) : rows;
    const std::size_t bandTiles = std::size_t(bandRows) * std::size_t(tiles.x);
    reserve(states_, rounds > 1 ? bandTiles * stateBytes(points_.count()) : 0, "soft-volumes/states");
    // One round more than there are: none is asked for, but its arguments are within reach of the shader.
    const GLuint lists = 3 * GLuint(rounds + 1);
    reserve(rounds_, (lists + 2 * bandTiles) * sizeof(GLuint), "soft-volumes/rounds");

    resolve_.use();
    points_.bind();
    points_.bindTable(5);
    bindStorage(0, tileBounds_);
    bindStorage(1, lightEdges_);
    bindStorage(2, counter.eye());
    bindStorage(3, tileLists_);
    centerCounts_.counts().bind(3);
    counter.depth().bind(4);
    edgeCounts_.bindImage(1, GL_WRITE_ONLY);
    counter.counts().bindImage(2, GL_WRITE_ONLY);
    bindStorage(6, states_);
    bindStorage(7, rounds_);
    glUniform1ui(2, GLuint(effort_.roundWork));
    glUniform1i(4, !frame.masked.empty());
    if (!frame.masked.empty()) maskedPoints_.hidden().bind(6);
    for (int row = 0; row < rows; row += bandRows) {
        glClearNamedBufferSubData(rounds_.name(), GL_R32UI, 0, GLsizeiptr(lists * sizeof(GLuint)),
                                  GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        glUniform1ui(0, GLuint(row * tiles.x));
        for (int round = 0; round < rounds; ++round) {
            const GLuint other = lists + GLuint(bandTiles);
            const bool isEven = round % 2 == 0;
            glUniform1ui(1, GLuint(round));
            glUniform2ui(3, isEven ? lists : other, isEven ? other : lists);
            if (round == 0) {
                glDispatchCompute(GLuint(tiles.x), GLuint(std::min(bandRows, rows - row)), 1);
            } else {
                // Without groups where nobody asked for the round.
                gl::dispatchIndirect(rounds_, 3 * sizeof(GLuint) * std::size_t(round));
            }
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
        }
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

void TileLayers::render(const VolumeFrame& frame, const AreaLight& light, const VolumeCounter& counter,
                        GLuint target, gl::Format format, gl::PassTimers& timers) {
    {
        const auto pass = timers.pass("soft-volumes/count");
        boundTiles(frame, counter);
        clusters_.allocate(frame);
        centerCounts_.count(frame, clusters_, tileBounds_, counter.depth());
    }
    {
        const auto pass = timers.pass("soft-volumes/edges");
        gatherEdges(frame, counter);
        points_.place(light, effort_.samples);
        makeResolve();
        maskedPoints_.mark(frame, clusters_, points_, tileBounds_, counter.depth());
    }
    {
        const auto pass = timers.pass("soft-volumes/tile lists");
        listEdges(frame, counter);
    }
    const auto pass = timers.pass("soft-volumes/visibility");
    glBindImageTexture(0, target, 0, GL_FALSE, 0, GL_WRITE_ONLY, GLenum(format));
    resolve(frame, counter);
}

std::size_t TileLayers::edgesWithoutRoom(const VolumeCounter& counter) const {
    if (!isLimited_) return 0;
    EyeState eye;
    counter.eye().read(std::as_writable_bytes(std::span(&eye, 1)));
    return eye.edgeCount > recordCount_ ? eye.edgeCount - recordCount_ : 0;
}

std::size_t TileLayers::size_bytes() const {
    return lightEdges_.size_bytes() + tileBounds_.size_bytes() + tileLists_.size_bytes() +
           states_.size_bytes() + rounds_.size_bytes() + clusters_.size_bytes();
}

}  // namespace penumbra
