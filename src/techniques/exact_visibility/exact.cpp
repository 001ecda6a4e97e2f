// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/exact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <string>

#include "src/techniques/common/glm_types.h"

namespace penumbra {
namespace {

constexpr const char* candidatesShader = "src/techniques/exact_visibility/candidates.comp.glsl";
constexpr const char* resolveShader = "src/techniques/exact_visibility/resolve.comp.glsl";
constexpr int tile_px = 8;
constexpr unsigned firstMaskUnit = 8;

// llvmpipe ends all loops of a shader, without a word, once an invocation has gone through 65,535 iterations;
// the last triangle before a pause may take some hundred more than this. Elsewhere it is watchdogs that want
// an end.
constexpr int softwareRoundWork = 40000;
constexpr int hardwareRoundWork = 1000000;

bool isPoint(const AreaLight& light) {
    switch (light.shape) {
        case LightShape::rect:
            return light.width_m == 0 && light.height_m == 0;
        case LightShape::distant:
            return light.angle_rad == 0;
        default:
            return light.radius_m == 0;
    }
}

void bindMaskGroup(std::span<const unsigned> textures, int group) {
    for (std::size_t i = 0; i < EXACT_GROUP_TEXTURES; ++i) {
        const std::size_t which = std::size_t(group) * EXACT_GROUP_TEXTURES + i;
        glBindTextureUnit(firstMaskUnit + unsigned(i), which < textures.size() ? textures[which] : 0);
    }
}

}  // namespace

ExactVisibility::ExactVisibility(Device& device)
    : roundWork_(device.internals().isSoftware ? softwareRoundWork : hardwareRoundWork),
      device_(device.internals()),
      candidates_(device_.shaders, {candidatesShader}),
      weigh_(device_.shaders, {"src/techniques/exact_visibility/weights.comp.glsl"}),
      light_("exact/light"),
      masks_("exact/masks"),
      counters_(sizeof(Counters), "exact/counters"),
      weights_(std::size_t(EXACT_MAX_LATTICES * EXACT_MAX_ROWS * EXACT_MAX_ROWS) * sizeof(glm::vec4),
               "exact/weights") {
    glClearNamedBufferData(counters_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void ExactVisibility::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> weights = {"area", "irradiance"};
    visitor.integer({.name = "samples", .help = "points of the light whose visibility is determined"},
                    samples_, {16, 1024});
    visitor.choice({.name = "weight",
                    .help = "what each part of the light counts: its area, or what it sends to the surface"},
                   weight_, weights);
    visitor.integer({.name = "tile_candidates",
                     .unit = "triangles",
                     .help = "room for each 8 x 8 pixels; those with more take longer, and give the same"},
                    tileCapacity_, {1, 65536});
    visitor.integer({.name = "round_work",
                     .unit = "iterations",
                     .help = "how much is done for a pixel before it pauses, to go on in another dispatch"},
                    roundWork_,
                    {2000, device_.isSoftware ? softwareRoundWork : std::numeric_limits<int>::max()});
}

const std::vector<LightLattice>& ExactVisibility::latticesFor(const AreaLight& light) {
    const bool disk = light.shape != LightShape::rect;
    const std::pair key(isPoint(light) ? 1 : samples_, disk);
    const auto found = lattices_.find(key);
    if (found != lattices_.end()) return found->second;
    return lattices_[key] = makeLightLattices(key.first, disk);
}

ExactLight ExactVisibility::describeLight(const ShadowInputs& inputs,
                                          std::span<const LightLattice> lattices) const {
    const AreaLight& light = inputs.light;
    const glm::dmat4 worldFromLight = toGlm(light.worldFromLight);
    const glm::dmat3 axes(worldFromLight);
    const bool isDistant = light.shape == LightShape::distant, isSphere = light.shape == LightShape::sphere;
    const double halfAngle = 0.5 * double(light.angle_rad);
    glm::dvec3 center = isDistant ? glm::dvec3(0) : glm::dvec3(worldFromLight[3]) - soup_.originWorld();
    double sizeX = light.radius_m, sizeY = light.radius_m;
    if (light.shape == LightShape::rect)
        sizeX = 0.5 * double(light.width_m), sizeY = 0.5 * double(light.height_m);
    glm::dvec3 low, high;
    for (int i = 0; i < 3; ++i) {
        if (isDistant) {
            // The cone's directions make angles with the axis that run from one to the other.
            const double angle = std::acos(std::clamp(axes[2][i], -1.0, 1.0));
            low[i] = std::cos(std::min(angle + halfAngle, std::acos(-1.0))) - 1e-6;
            high[i] = std::cos(std::max(angle - halfAngle, 0.0)) + 1e-6;
        } else {
            const double reach =
                isSphere ? light.radius_m : std::abs(axes[0][i]) * sizeX + std::abs(axes[1][i]) * sizeY;
            const double pad = 1e-6 * (std::abs(center[i]) + reach);
            low[i] = center[i] - reach - pad;
            high[i] = center[i] + reach + pad;
        }
    }
    if (isDistant) sizeX = std::tan(std::min(halfAngle, 1.2)), sizeY = std::cos(halfAngle);

    const glm::dmat4 worldFromView = glm::inverse(toGlm(inputs.view.viewFromWorld));
    const glm::dmat2 lattice = lattices.front().latticeFromUv, inverse = glm::inverse(lattice);
    ExactLight result{};
    const int shape = isDistant                         ? EXACT_DISTANT
                      : isSphere                        ? EXACT_SPHERE
                      : light.shape == LightShape::disk ? EXACT_DISK
                                                        : EXACT_RECT;
    result.center = glm::vec4(center, shape);
    result.axisX = glm::vec4(axes[0], sizeX);
    result.axisY = glm::vec4(axes[1], sizeY);
    result.axisZ = glm::vec4(axes[2], light.twoSided);
    result.boxMin = glm::vec4(low, isPoint(light));
    result.boxMax = glm::vec4(high, weight_);
    result.eye = glm::vec4(glm::dvec3(worldFromView[3]) - soup_.originWorld(), light.radianceTexture != 0);
    const glm::dmat4 clipFromWorld = toGlm(inputs.view.clipFromView) * toGlm(inputs.view.viewFromWorld);
    const glm::dvec4 share = glm::row(clipFromWorld, 3);
    result.sight = glm::vec4(glm::dvec3(share), share.w + glm::dot(glm::dvec3(share), soup_.originWorld()));
    result.lattice = glm::vec4(lattice[0], lattice[1]);
    result.uvFromLattice = glm::vec4(inverse[0], inverse[1]);
    result.counts = {int(lattices.size()), (inputs.view.width_px + tile_px - 1) / tile_px, tileCapacity_,
                     int(soup_.nodeCount())};
    for (std::size_t i = 0; i < lattices.size(); ++i) {
        result.offsets[i] = glm::vec4(lattices[i].offset, 0, 0);
        for (std::size_t j = 0; j < lattices[i].validRows.size(); ++j) {
            const std::size_t row = i * EXACT_MAX_ROWS + j;
            result.valid[row / 4][int(row % 4)] = lattices[i].validRows[j];
        }
    }
    return result;
}

/// How many rounds a turn takes at most: every node visited, every triangle projected, every sample looked
/// at.
int ExactVisibility::roundsFor(int rows, LightShape shape) const {
    const double samples = EXACT_MAX_ROWS * EXACT_MAX_ROWS;
    const double perTriangle = 6 + 3 * rows;
    const double perSpecialTriangle = perTriangle + samples;
    // Spheres may make any triangle special, flat lights those of casters on both sides of their planes.
    const double special = double(shape == LightShape::distant ? soup_.maskedCount() : soup_.triangleCount());
    const double work = double(soup_.nodeCount()) + double(soup_.triangleCount()) * perTriangle +
                        special * perSpecialTriangle + 32.0 * rows;
    return int(std::min(1 + std::ceil(work / (roundWork_ - 1000)), 1e6));
}

void ExactVisibility::allocate(int width_px, int height_px, int rows, int rounds) {
    if (errorBound_.name() == 0 || errorBound_.width_px() != width_px ||
        errorBound_.height_px() != height_px) {
        errorBound_ = {};
        errorBound_ = gl::Texture({.width_px = width_px,
                                   .height_px = height_px,
                                   .format = gl::Format::r16f,
                                   .label = "exact/error bound"});
    }
    tileCount_ = ((width_px + tile_px - 1) / tile_px) * ((height_px + tile_px - 1) / tile_px);
    const std::size_t tiles_bytes = std::size_t(tileCount_) * sizeof(glm::uvec4);
    const std::size_t lists_bytes =
        std::size_t(tileCount_) * std::size_t(tileCapacity_) * sizeof(std::uint32_t);
    if (tiles_.size_bytes() < tiles_bytes) tiles_ = gl::Buffer(tiles_bytes, "exact/tiles");
    if (lists_.size_bytes() < lists_bytes) {
        lists_ = {};
        lists_ = gl::Buffer(lists_bytes, "exact/candidates");
    }
    const std::size_t states_bytes = std::size_t(width_px) * std::size_t(height_px) *
                                     std::size_t(EXACT_STATE_WORDS + rows) * sizeof(std::uint32_t);
    if (states_.size_bytes() < states_bytes) {
        states_ = {};
        states_ = gl::Buffer(states_bytes, "exact/states");
    }
    const std::size_t rounds_bytes = std::size_t(rounds + 1) * 3 * sizeof(std::uint32_t);
    if (rounds_.size_bytes() < rounds_bytes) rounds_ = gl::Buffer(rounds_bytes, "exact/rounds");
}

/// Writes down what each mask asks of its texture, and which that is; the result has each texture once.
std::vector<unsigned> ExactVisibility::sendMasks() {
    std::vector<unsigned> textures;
    std::vector<glm::vec4> masks;
    for (const AlphaMask& mask : soup_.masks()) {
        auto it = std::ranges::find(textures, mask.texture);
        if (it == textures.end()) it = textures.insert(it, mask.texture);
        const auto which = int(it - textures.begin());
        masks.emplace_back(mask.factor, mask.cutoff, which % EXACT_GROUP_TEXTURES,
                           which / EXACT_GROUP_TEXTURES);
    }
    masks_.write(masks);
    masks_.bind(3);
    return textures;
}

void ExactVisibility::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    {
        const auto pass = timers_.pass("exact/upload");
        soup_.update(inputs.casters);
    }
    const std::vector<LightLattice>& lattices = latticesFor(inputs.light);
    std::size_t rows = 0;
    for (const LightLattice& lattice : lattices) rows = std::max(rows, lattice.validRows.size());
    const std::vector<unsigned> maskTextures = sendMasks();
    // A turn for each group of alpha textures, for each lattice, in each of a cone's windows.
    const int groups =
        std::max(int(maskTextures.size() + EXACT_GROUP_TEXTURES - 1) / EXACT_GROUP_TEXTURES, 1);
    const bool isCone = inputs.light.shape == LightShape::sphere || inputs.light.shape == LightShape::distant;
    const int turns = groups * int(lattices.size()) * (isCone ? 6 : 1);
    const int turnRounds = roundsFor(int(rows), inputs.light.shape);
    allocate(out.width_px(), out.height_px(), int(rows), turns * turnRounds);
    auto resolve = resolve_.find(int(rows));
    if (resolve == resolve_.end()) {
        gl::Program program(device_.shaders, {resolveShader}, {"ROWS " + std::to_string(rows)});
        resolve = resolve_.emplace(int(rows), std::move(program)).first;
    }
    light_.write(describeLight(inputs, lattices));
    light_.bindUniform(1);
    glm::dmat4 sceneFromWorld(1);
    sceneFromWorld[3] = glm::dvec4(-soup_.originWorld(), 1);
    view_.bind(inputs.view, sceneFromWorld);
    soup_.bind(3);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, lists_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, tiles_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, counters_.name());
    {
        const auto pass = timers_.pass("exact/candidates");
        glClearNamedBufferData(counters_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        candidates_.use();
        glDispatchCompute(GLuint(tileCount_ + 31) / 32, 1, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }
    glBindTextureUnit(6, inputs.light.radianceTexture);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, weights_.name());
    if (inputs.light.radianceTexture != 0) {
        const auto pass = timers_.pass("exact/weights");
        weigh_.use();
        glDispatchCompute(EXACT_MAX_ROWS / 8, EXACT_MAX_ROWS / 8, GLuint(lattices.size()));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    {
        const auto pass = timers_.pass("exact/resolve");
        resolve->second.use();
        bindVisibility(out, 0);
        errorBound_.bindImage(1, GL_WRITE_ONLY);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, states_.name());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, rounds_.name());
        glClearNamedBufferData(rounds_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        glUniform1i(1, roundWork_);
        glUniform1i(2, turnRounds);
        glUniform1i(3, groups);
        bindMaskGroup(maskTextures, 0);
        glUniform1i(0, 0);
        gl::dispatchPixels(out.width_px(), out.height_px());
        for (int round = 1; round < turns * turnRounds; ++round) {
            if (groups > 1 && round % turnRounds == 0)
                bindMaskGroup(maskTextures, round / turnRounds % groups);
            // Without work groups where nobody asked for the round.
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
            glUniform1i(0, round);
            gl::dispatchIndirect(rounds_, 3 * sizeof(std::uint32_t) * std::size_t(round));
        }
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    }
}

void ExactVisibility::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "error bound", .texture = errorBound_.name()});
}

Statistics ExactVisibility::statistics() const {
    Counters counters;
    counters_.read(std::as_writable_bytes(std::span(&counters, 1)));
    Statistics statistics;
    statistics.counts = {
        {"triangles", double(soup_.triangleCount())},
        {"tiles with candidates", double(counters.busyTiles)},
        {"candidates per tile",
         counters.busyTiles > 0 ? double(counters.triangleSum) / counters.busyTiles : 0.0},
        {"most candidates in a tile", double(counters.largestTile)},
        {"tiles beyond their room", double(counters.fullTiles)},
        {"penumbra pixels", double(counters.boundedPixels)},
        {"mean error bound",
         counters.boundedPixels > 0 ? counters.boundSum / 256.0 / counters.boundedPixels : 0.0},
        {"largest error bound", counters.largestBound / 256.0},
        {"memory",
         double(soup_.size_bytes() + lists_.size_bytes() + tiles_.size_bytes() + states_.size_bytes() +
                rounds_.size_bytes() + weights_.size_bytes() +
                2 * std::size_t(errorBound_.width_px()) * std::size_t(errorBound_.height_px())) /
             (1 << 20),
         "MiB"},
    };
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra
