// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/soft_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "src/geometry/edge_mesh.h"
#include "src/gl/raster_state.h"

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

/// Points that fill the unit square or disk evenly, none on a line with many others: whatever edge crosses
/// the light meets them one after the other.
std::vector<glm::vec4> spreadSamples(int count, bool onSquare) {
    const double golden = glm::golden_ratio<double>() - 1;
    std::vector<glm::vec4> samples;
    for (int i = 0; i < count; ++i) {
        const double along = (i + 0.5) / count;
        const double turn = (i + 0.5) * golden - std::floor((i + 0.5) * golden);
        glm::dvec2 place(2 * along - 1, 2 * turn - 1);
        if (!onSquare) {
            place = std::sqrt(along) * glm::dvec2(std::cos(glm::two_pi<double>() * turn),
                                                  std::sin(glm::two_pi<double>() * turn));
        }
        const double direction = std::atan2(place.y, place.x) / glm::two_pi<double>();
        samples.emplace_back(place, along, direction - std::floor(direction));
    }
    // Edges look up the points behind them by direction.
    std::ranges::sort(samples, {}, &glm::vec4::w);
    return samples;
}

/// Wedges weigh blockers, not layers: a closed caster hides the light with two layers, an open one with each.
void countAsBlockers(VolumeFrame& frame) {
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const EdgeMesh& edges = edgesOf(*frame.sources[i].mesh);
        const bool isClosed = edges.faces().size_bytes() == 2 * edges.edgeCount() * sizeof(uint);
        frame.layersEach[i] = isClosed ? 1 : 2;
    }
}

constexpr int mostSamples = 256;
/// A textured light has no exact area to correct its samples with.
constexpr int texturedFactor = 2;
constexpr int smallTile_px = 8;
constexpr int largeTile_px = 32;
/// The lists of large tiles, which are made larger rather than exceed this.
constexpr std::size_t largestLists_bytes = std::size_t(64) << 20;

}  // namespace

SoftVolumes::SoftVolumes(Device& device)
    : device_(device.internals()),
      counter_(device),
      gather_(device_.shaders, {shader("soft_gather")}),
      bounds_(device_.shaders, {shader("soft_bounds")}),
      lists_(device_.shaders, {shader("soft_lists")}),
      radiance_(device_.shaders, {shader("soft_radiance")}),
      hardResolve_(device_.shaders, {shader("hard_volumes")}),
      wedges_(device_.shaders, {"src/techniques/soft_shadow_volumes/wedge.vert.glsl",
                                "src/techniques/soft_shadow_volumes/wedge.frag.glsl"}),
      wedgeResolve_(device_.shaders, {shader("wedge_resolve")}),
      upsample_(device_.shaders, {shader("upsample")}),
      noVertices_(gl::makeFloatVertexArray()),
      constants_("soft-volumes/constants"),
      alphaMaskWarning_(device) {}

void SoftVolumes::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 3> countings = {"auto", "z-pass", "z-fail"};
    static constexpr std::array<std::string_view, 2> methods = {"layers", "wedges"};
    visitor.choice(
        {.name = "method",
         .help = "layers: counted at points of the light, from the silhouettes that each receiver sees; "
                 "wedges: as published, from the centre's silhouettes, each darkening by itself"},
        method_, methods);
    visitor.integer(
        {.name = "samples", .help = "points of the light at which overlapping blockers are told apart"},
        samples_, {16, mostSamples});
    static constexpr std::array<std::string_view, 3> sizes = {"full", "half", "quarter"};
    visitor.choice(
        {.name = "v_buffer", .help = "width and height of the V-buffer, as a part of the picture's"},
        vBufferSize_, sizes);
    visitor.real({.name = "frame_budget_ms",
                  .unit = "ms",
                  .help = "device time that the V-buffer's size is chosen to keep to; 0: v_buffer says"},
                 frameBudget_ms_, {0, 1000});
    visitor.choice(
        {.name = "counting",
         .help = "which sides of shadow volumes are counted: auto takes z-pass, the cheaper one, unless the "
                 "eye lies within rounding of a side"},
        counting_, countings);
}

void SoftVolumes::allocate(const VolumeFrame& frame) {
    // An edge of n faces is kept as at most (n + 1) / 2 records.
    largestEdgeCount_ = 0;
    for (const SilhouetteSource& source : frame.sources) {
        const EdgeMesh& edges = edgesOf(*source.mesh);
        largestEdgeCount_ += (edges.edgeCount() + edges.faces().size_bytes() / sizeof(uint)) / 2 + 1;
    }
    reserve(lightEdges_, largestEdgeCount_ * sizeof(LightEdge), "soft-volumes/edges");

    const glm::ivec2 size_px(frame_.buffer_px);
    const auto tilesOf = [&](int tile_px) { return (size_px + tile_px - 1) / tile_px; };
    const glm::ivec2 smallTiles = tilesOf(smallTile_px);
    reserve(tileBounds_, std::size_t(smallTiles.x) * std::size_t(smallTiles.y) * 2 * sizeof(glm::vec4),
            "soft-volumes/tile bounds");
    const std::size_t words = (largestEdgeCount_ + 31) / 32;
    int large_px = largeTile_px;
    const auto listBytes = [&] {
        const glm::ivec2 tiles = tilesOf(large_px);
        return std::size_t(tiles.x) * std::size_t(tiles.y) * words * sizeof(uint);
    };
    while (listBytes() > largestLists_bytes && large_px < std::max(size_px.x, size_px.y)) large_px *= 2;
    reserve(tileLists_, listBytes(), "soft-volumes/tile lists");
    frame_.tiles = {smallTiles.x, tilesOf(large_px).x, large_px / smallTile_px, int(words)};

    if (edgeCounts_.name() == 0 || edgeCounts_.width_px() != size_px.x ||
        edgeCounts_.height_px() != size_px.y) {
        edgeCounts_ = {};
        edgeCounts_ = gl::Texture({.width_px = size_px.x,
                                   .height_px = size_px.y,
                                   .format = GL_R32F,
                                   .label = "soft-volumes/edges a pixel"});
    }
}

void SoftVolumes::prepareSamples(const AreaLight& light) {
    const bool onSquare = light.shape == LightShape::rect;
    sampleCount_ = light.radianceTexture != 0 ? std::min(texturedFactor * samples_, mostSamples) : samples_;
    if (placedSamples_ != sampleCount_ || placedOnSquare_ != onSquare) {
        const std::vector<glm::vec4> places = spreadSamples(sampleCount_, onSquare);
        samplePlaces_ = gl::Buffer(std::as_bytes(std::span(places)), "soft-volumes/samples");
        sampleRadiances_ = gl::Buffer(std::as_bytes(std::span(places)), "soft-volumes/radiances");
        placedSamples_ = sampleCount_;
        placedOnSquare_ = onSquare;
    }
    bindStorage(4, samplePlaces_);
    bindStorage(5, sampleRadiances_);
    if (light.radianceTexture != 0) {
        radiance_.use();
        glBindTextureUnit(3, light.radianceTexture);
        glUniform1i(0, sampleCount_);
        glDispatchCompute(GLuint(sampleCount_ + 63) / 64, 1, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    if (resolveSamples_ != sampleCount_) {
        resolve_ = gl::Program(device_.shaders, {shader("soft_resolve")},
                               {"SAMPLES " + std::to_string(sampleCount_)});
        resolveSamples_ = sampleCount_;
    }
}

void SoftVolumes::gatherEdges(const VolumeFrame& frame) {
    gather_.use();
    bindStorage(2, counter_.eye());
    bindStorage(5, lightEdges_);
    for (const SilhouetteSource& source : frame.sources) {
        const EdgeMesh& edges = edgesOf(*source.mesh);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, source.mesh->positionBuffer());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, source.mesh->indexBuffer());
        bindStorage(3, edges.edges());
        bindStorage(4, edges.faces());
        glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(glm::mat4(source.lightFromMesh)));
        glUniform1ui(4, GLuint(edges.edgeCount()));
        if (edges.edgeCount() > 0) glDispatchCompute(GLuint(edges.edgeCount() + 63) / 64, 1, 1);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SoftVolumes::resolve(GLuint target, GLenum format) {
    const glm::ivec2 size_px(frame_.buffer_px);
    {
        const auto pass = timers_.pass("soft-volumes/tile lists");
        bounds_.use();
        counter_.depth().bind(4);
        bindStorage(0, tileBounds_);
        gl::dispatchPixels(size_px.x, size_px.y);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        lists_.use();
        bindStorage(1, lightEdges_);
        bindStorage(3, tileLists_);
        const int large_px = frame_.tiles.z * smallTile_px;
        glDispatchCompute(GLuint(frame_.tiles.y), GLuint((size_px.y + large_px - 1) / large_px),
                          GLuint(frame_.tiles.w / 512 + 1));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const auto pass = timers_.pass("soft-volumes/visibility");
    resolve_.use();
    counter_.bind(3, 2);
    glBindImageTexture(0, target, 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
    edgeCounts_.bindImage(1, GL_WRITE_ONLY);
    gl::dispatchPixels(size_px.x, size_px.y);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SoftVolumes::resolveHard(const VisibilityBuffer& out) {
    const auto pass = timers_.pass("soft-volumes/visibility");
    hardResolve_.use();
    counter_.bind(3, 2);
    bindVisibility(out, 0);
    gl::dispatchPixels(out.width_px(), out.height_px());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SoftVolumes::drawWedges(GLuint target, GLenum format) {
    const glm::ivec2 size_px(frame_.buffer_px);
    if (wedgeLayers_.name() == 0 || wedgeLayers_.width_px() != size_px.x ||
        wedgeLayers_.height_px() != size_px.y) {
        wedgeLayers_ = {};
        wedgeLayers_ = gl::Texture({.width_px = size_px.x,
                                    .height_px = size_px.y,
                                    .format = GL_RG32F,
                                    .label = "soft-volumes/V-buffer layers"});
        wedgeFramebuffer_ = gl::Framebuffer({&wedgeLayers_}, nullptr, "soft-volumes/V-buffer layers");
    }
    {
        const auto pass = timers_.pass("soft-volumes/wedges");
        // Back faces alone, so that each wedge is evaluated once a pixel: also where the eye is inside of it.
        gl::beginPass(wedgeFramebuffer_.name(), {.width_px = size_px.x,
                                                 .height_px = size_px.y,
                                                 .depthClamp = true,
                                                 .cull = GL_FRONT,
                                                 .blendEquation = GL_FUNC_ADD});
        const std::array<float, 4> zero{};
        glClearNamedFramebufferfv(wedgeFramebuffer_.name(), GL_COLOR, 0, zero.data());
        wedges_.use();
        glBindVertexArray(noVertices_.name());
        counter_.silhouettes().bindEdges(0);
        counter_.bindLayersEach(1);
        counter_.depth().bind(4);
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, counter_.eye().name());
        // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset, as OpenGL has it
        glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(offsetof(EyeState, wedges)));
    }
    const auto pass = timers_.pass("soft-volumes/visibility");
    wedgeResolve_.use();
    counter_.bind(3, 2);
    wedgeLayers_.bind(5);
    glBindImageTexture(0, target, 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
    gl::dispatchPixels(size_px.x, size_px.y);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

int SoftVolumes::chooseSize() {
    if (frameBudget_ms_ <= 0) return vBufferSize_;
    double total_ms = 0;
    for (const PassTime& pass : passTimes(timers_)) total_ms += pass.milliseconds;
    // A step changes the cost by four at most: below a fifth of the budget there is room for the larger size.
    if (total_ms > frameBudget_ms_) budgetedSize_ = std::min(budgetedSize_ + 1, 2);
    if (total_ms > 0 && total_ms < 0.2 * frameBudget_ms_) budgetedSize_ = std::max(budgetedSize_ - 1, 0);
    return budgetedSize_;
}

void SoftVolumes::upsample(const VisibilityBuffer& out) {
    const auto pass = timers_.pass("soft-volumes/upsample");
    upsample_.use();
    vBuffer_.bind(3);
    counter_.depth().bind(4);
    bindVisibility(out, 0);
    gl::dispatchPixels(out.width_px(), out.height_px());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SoftVolumes::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    alphaMaskWarning_.check(inputs.casters);
    const int pixelsPerTexel = hasNoSize(inputs.light) ? 1 : 1 << chooseSize();
    VolumeFrame frame(inputs, pixelsPerTexel);
    const bool wedges = method_ == int(Method::wedges) && !hasNoSize(inputs.light);
    if (wedges) countAsBlockers(frame);
    frame_ = frame.constants;
    allocate(frame);
    constants_.write(frame_);
    view_.bind(inputs.view, frame.lightFromWorld);
    constants_.bindUniform(1);
    {
        const auto pass = timers_.pass("soft-volumes/count");
        counter_.render(frame, Counting(counting_));
    }
    if (hasNoSize(inputs.light)) {
        resolveHard(out);
        return;
    }
    const GLenum format = out.colored() ? GL_RGBA16F : GL_R32F;
    GLuint target = out.texture();
    if (pixelsPerTexel > 1) {
        const glm::ivec2 size_px(frame_.buffer_px);
        if (vBuffer_.name() == 0 || vBuffer_.width_px() != size_px.x || vBuffer_.height_px() != size_px.y ||
            vBuffer_.format() != format) {
            vBuffer_ = {};
            vBuffer_ = gl::Texture({.width_px = size_px.x,
                                    .height_px = size_px.y,
                                    .format = format,
                                    .label = "soft-volumes/V-buffer"});
        }
        target = vBuffer_.name();
    }
    if (wedges) {
        drawWedges(target, format);
    } else {
        {
            const auto pass = timers_.pass("soft-volumes/edges");
            gatherEdges(frame);
            prepareSamples(inputs.light);
        }
        resolve(target, format);
    }
    if (pixelsPerTexel > 1) upsample(out);
}

void SoftVolumes::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "counts", .texture = counter_.counts().name(), .white = 4});
    visitor.texture({.name = "receiver depth", .texture = counter_.depth().name()});
    if (wedgeLayers_.name() != 0)
        visitor.texture({.name = "additive and subtractive layers", .texture = wedgeLayers_.name()});
    if (vBuffer_.name() != 0) visitor.texture({.name = "V-buffer", .texture = vBuffer_.name()});
    if (edgeCounts_.name() != 0)
        visitor.texture({.name = "edges a pixel", .texture = edgeCounts_.name(), .white = 32});
}

Statistics SoftVolumes::statistics() const {
    return {.counts = {{"edges", double(counter_.silhouettes().edgeCount())},
                       {"edge memory", double(lightEdges_.size_bytes() + tileLists_.size_bytes()) / (1 << 20),
                        "MiB"}},
            .passes = passTimes(timers_)};
}

}  // namespace penumbra
