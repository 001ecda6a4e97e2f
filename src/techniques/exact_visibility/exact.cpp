// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/exact.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <string>

#include "penumbra/light_plane.h"
#include "src/device/glm_types.h"
#include "src/gl/pass.h"
#include "src/techniques/common/input_key.h"
#include "src/techniques/common/light_constants.h"

namespace penumbra::exact_visibility {
namespace {

constexpr const char* candidatesShader = "src/techniques/exact_visibility/candidates.comp.glsl";
constexpr const char* resolveShader = "src/techniques/exact_visibility/resolve.comp.glsl";

// llvmpipe ends all loops of a shader, without a word, once an invocation has gone through 65,535 iterations;
// the last triangle before a pause may take some hundred more than this. Elsewhere it is watchdogs that want
// an end.
constexpr int softwareRoundWork = 40000;
constexpr int hardwareRoundWork = 1000000;

void bindMaskGroup(gl::Pass& pass, std::span<const unsigned> textures, int group) {
    if (!pass.has("alphaTextures")) return;
    for (std::size_t i = 0; i < EXACT_GROUP_TEXTURES; ++i) {
        const std::size_t which = std::size_t(group) * EXACT_GROUP_TEXTURES + i;
        pass.bind("alphaTextures", i, {.name = which < textures.size() ? textures[which] : 0});
    }
}

/// Whether a receiver may see the light through six windows (light.glsl): any sphere, and distant lights of
/// which an edge is more than 60 degrees from the middle.
bool mayFillHalfTheSky(const AreaLight& light) {
    constexpr float widest_rad = 1.0471f;  // 60 degrees, but for rounding
    return light.shape == LightShape::sphere ||
           (light.shape == LightShape::distant && 0.5f * light.angle_rad > widest_rad);
}

}  // namespace

ExactVisibility::ExactVisibility(Device& device)
    : roundWork_(internalsOf(device).isSoftware ? softwareRoundWork : hardwareRoundWork),
      device_(internalsOf(device)),
      candidates_(device_.shaders, {candidatesShader}),
      weigh_(device_.shaders, {"src/techniques/exact_visibility/weights.comp.glsl"}),
      restore_(device_.shaders, {"src/techniques/common/restore.comp.glsl"}),
      light_("exact/light"),
      masks_("exact/masks"),
      changedBoxes_("exact/changed boxes"),
      receivers_(device_.shaders) {}

void ExactVisibility::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> weights = {"area", "irradiance"};
    visitor.integer({.name = "samples", .help = "points of the light whose visibility is determined"},
                    samples_, {16, 1024});
    visitor.choice({.name = "weight",
                    .help = "what each part of the light counts: its area, or what it sends to the surface"},
                   weight_, weights);
    visitor.integer({.name = "tile_candidates",
                     .unit = "nodes",
                     .help = "room for each 8 x 8 pixels; those with more take longer, and give the same"},
                    tileCapacity_, {1, 65536});
    visitor.integer({.name = "round_work",
                     .unit = "iterations",
                     .help = "how much is done for a pixel before it pauses, to go on in another dispatch"},
                    roundWork_,
                    {2000, device_.isSoftware ? softwareRoundWork : std::numeric_limits<int>::max()});
}

const std::vector<LightLattice>& ExactVisibility::latticesFor(const AreaLight& light) {
    const bool disk = light.shape != LightShape::rect && light.shape != LightShape::cylinder;
    const std::pair key(hasSize(light) ? samples_ : 1, disk);
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
    const bool isTube = light.shape == LightShape::cylinder;
    const double halfAngle = 0.5 * double(light.angle_rad);
    const glm::dvec3 center = isDistant ? glm::dvec3(0) : glm::dvec3(worldFromLight[3]) - soup_.originWorld();
    const glm::dvec2 size = lightExtent(light);
    glm::dvec3 low, high;
    for (int i = 0; i < 3; ++i) {
        if (isDistant) {
            // The cone's directions make angles with the axis that run from one to the other.
            const double angle = std::acos(std::clamp(axes[2][i], -1.0, 1.0));
            low[i] = std::cos(std::min(angle + halfAngle, std::acos(-1.0))) - 1e-6;
            high[i] = std::cos(std::max(angle - halfAngle, 0.0)) + 1e-6;
        } else {
            const double across = isTube ? std::hypot(axes[1][i], axes[2][i]) : std::abs(axes[1][i]);
            const double reach = isSphere ? light.radius_m : std::abs(axes[0][i]) * size.x + across * size.y;
            const double pad = 1e-6 * (std::abs(center[i]) + reach);
            low[i] = center[i] - reach - pad;
            high[i] = center[i] + reach + pad;
        }
    }

    const glm::dmat4 worldFromView = glm::inverse(toGlm(inputs.view.viewFromWorld));
    const glm::dmat4 clipFromWorld = toGlm(inputs.view.clipFromView) * toGlm(inputs.view.viewFromWorld);
    const glm::dvec4 share = glm::row(clipFromWorld, 3);
    const glm::dmat2 lattice = lattices.front().latticeFromUv, inverse = glm::inverse(lattice);
    ExactLight result{
        .emitter = lightConstants(light),
        .center = center,
        .coneCosine = float(std::cos(halfAngle)),
        .axisX = axes[0],
        .isWeightedByIrradiance = bool32(weight_),
        .axisY = axes[1],
        .latticeCount = int(lattices.size()),
        .axisZ = axes[2],
        .tilesAcross = (inputs.view.width_px + EXACT_TILE - 1) / EXACT_TILE,
        .boxMin = low,
        .tileCapacity = tileCapacity_,
        .boxMax = high,
        .nodeCount = int(soup_.nodeCount()),
        .eye = glm::dvec3(worldFromView[3]) - soup_.originWorld(),
        .planeTolerance = lightPlaneTolerance,
        .sight = glm::dvec3(share),
        .sightOffset = float(share.w + glm::dot(glm::dvec3(share), soup_.originWorld())),
        .latticeFromU = lattice[0],
        .latticeFromV = lattice[1],
        .uvFromI = inverse[0],
        .uvFromJ = inverse[1],
    };
    for (std::size_t i = 0; i < lattices.size(); ++i) {
        result.offsets[i] = glm::vec4(lattices[i].offset, 0, 0);
        for (std::size_t j = 0; j < lattices[i].validRows.size(); ++j) {
            const std::size_t row = i * EXACT_MAX_ROWS + j;
            result.valid[row / 4][int(row % 4)] = lattices[i].validRows[j];
        }
    }
    return result;
}

const gl::Program& ExactVisibility::resolveFor(const ResolveKind& kind) {
    const auto found = resolve_.find(kind);
    if (found != resolve_.end()) return found->second;
    std::vector<std::string> defines{"ROWS " + std::to_string(kind.rows)};
    if (kind.hasHoles) defines.emplace_back("WITH_HOLES");
    if (kind.isUneven) defines.emplace_back("WITH_WEIGHTS");
    return resolve_.emplace(kind, gl::Program(device_.shaders, {resolveShader}, std::move(defines)))
        .first->second;
}

/// How many triangles may take a look at each sample: those with holes, and those that may reach the light.
/// Spheres and tubes may make any triangle one, flat lights those of casters that come near their planes:
/// within a hundredth of the scene's size, for receivers up to a thousand times that away.
std::size_t ExactVisibility::countSpecial(const ExactLight& light, LightShape shape) const {
    if (shape == LightShape::distant) return soup_.maskedCount();
    if (shape == LightShape::sphere || shape == LightShape::cylinder) return soup_.triangleCount();
    const float size = glm::distance(light.eye, light.center) + soup_.farthestFrom(light.center);
    return soup_.maskedCount() + soup_.countNear(light.center, light.axisZ, 0.01f * size);
}

/// How many rounds a turn takes at most: every node visited, every triangle projected, every sample looked
/// at, as resolve.comp.glsl counts them.
int ExactVisibility::roundsFor(std::span<const LightLattice> lattices, std::size_t special) const {
    constexpr double perNode = 2, perTriangle = 8, perRow = 32, perRound = 1000;
    double rows = 0, samples = 0;
    for (const LightLattice& lattice : lattices) {
        double count = 0;
        for (const unsigned row : lattice.validRows) count += std::popcount(row);
        samples = std::max(samples, count);
        rows = std::max(rows, double(lattice.validRows.size()));
    }
    const double work = double(soup_.nodeCount()) * perNode + double(soup_.triangleCount()) * perTriangle +
                        double(special) * (rows + samples) + perRow * rows;
    return int(std::min(1 + std::ceil(work / (roundWork_ - perRound)), 1e6));
}

void ExactVisibility::allocate(int width_px, int height_px, int rows, int rounds) {
    const std::size_t tiles = answer_.tileCount;
    busy_.reserve(sizeof(BusyTiles) + tiles * sizeof(std::uint32_t), "exact/busy tiles");
    lists_.reserve(tiles * std::size_t(tileCapacity_) * sizeof(std::uint32_t), "exact/candidates");
    states_.reserve(std::size_t(width_px) * std::size_t(height_px) * std::size_t(EXACT_STATE_WORDS + rows) *
                        sizeof(std::uint32_t),
                    "exact/states");
    rounds_.reserve(std::size_t(rounds + 1) * 3 * sizeof(std::uint32_t), "exact/rounds");
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
    return textures;
}

/// Whether tiles may keep their answers: the camera, the light and the options are those of the last frame,
/// and casters that are not are known.
bool ExactVisibility::canKeep(const AreaLight& light, bool isSameView) {
    key_.clear();
    appendLight(key_, light);
    appendBytes(key_, soup_.originWorld());
    appendBytes(key_, samples_);
    appendBytes(key_, weight_);
    return isSameView && key_ == answer_.key && soup_.tellsChangesSince(answer_.casterRevision);
}

void ExactVisibility::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    {
        const auto pass = timers_.pass("exact/upload");
        soup_.update(inputs.casters);
    }
    const bool keeps = canKeep(inputs.light, receivers_.follow(inputs.view));
    answer_.key.clear();  // until it is there
    answer_.fit(out.width_px(), out.height_px(), out.colored() ? gl::Format::rgba16f : gl::Format::r32f);
    const gl::TextureRef visibility = keeps ? answer_.visibility.ref() : imageOf(out);
    const std::span<const glm::vec4> changed =
        soup_.revision() == answer_.casterRevision ? std::span<const glm::vec4>() : soup_.changedBoxes();
    const std::vector<LightLattice>& lattices = latticesFor(inputs.light);
    std::size_t rows = 0;
    for (const LightLattice& lattice : lattices) rows = std::max(rows, lattice.validRows.size());
    const std::vector<unsigned> maskTextures = sendMasks();
    // A turn for each group of alpha textures, for each lattice, in each of a cone's windows.
    const int groups =
        std::max(int(maskTextures.size() + EXACT_GROUP_TEXTURES - 1) / EXACT_GROUP_TEXTURES, 1);
    const bool isCone = inputs.light.shape == LightShape::sphere || inputs.light.shape == LightShape::distant;
    const int turns = groups * int(lattices.size()) * (mayFillHalfTheSky(inputs.light) ? 6 : 1);
    const ExactLight light = describeLight(inputs, lattices);
    const int turnRounds = roundsFor(lattices, countSpecial(light, inputs.light.shape));
    allocate(out.width_px(), out.height_px(), int(rows), turns * turnRounds);
    const bool isUneven = isCone || weight_ != 0 || inputs.light.radianceTexture != 0;
    const gl::Program& resolve = resolveFor({int(rows), soup_.maskedCount() > 0, isUneven});
    light_.write(light);
    glm::dmat4 sceneFromWorld(1);
    sceneFromWorld[3] = glm::dvec4(-soup_.originWorld(), 1);
    view_.fill(inputs.view, sceneFromWorld);
    busy_.clear(0, sizeof(BusyTiles));
    ++serial_;
    if (keeps) {
        const auto pass = timers_.pass("exact/receivers");
        receivers_.look(inputs.view, view_, serial_);
        changedBoxes_.write(changed);
    }
    const gl::TextureRef radiance{.name = inputs.light.radianceTexture};
    if (inputs.light.radianceTexture != 0) {
        const auto pass = timers_.pass("exact/weights");
        gl::Pass(weigh_)
            .constants(ExactLook{.serial = serial_})
            .bind("LightBlock", light_)
            .bind("radiance", radiance)
            .bind("Weights", answer_.weights)
            .dispatch(EXACT_MAX_ROWS / 8, EXACT_MAX_ROWS / 8, lattices.size());
    }
    {
        const auto pass = timers_.pass("exact/candidates");
        constexpr std::size_t groupTiles = 32;
        gl::Pass(candidates_)
            .constants(
                ExactKeeping{.keeps = bool32(keeps), .changedBoxes = keeps ? int(changed.size() / 2) : 0})
            .bind(view_)
            .bind("LightBlock", light_)
            .bind(soup_)
            .bind("Candidates", lists_)
            .bind("TileLists", answer_.tiles)
            .bind("TileRevisions", receivers_.tileRevisions())
            .bind("Weights", answer_.weights)
            .bind("MadeAt", answer_.madeAt)
            .bind("ChangedBoxes", changedBoxes_)
            .bind("Busy", busy_)
            .bind("visibility", visibility)
            .bind("errorBound", answer_.errorBound)
            .dispatch((answer_.tileCount + groupTiles - 1) / groupTiles);
    }
    const auto timed = timers_.pass("exact/resolve");
    rounds_.clear();
    gl::Pass pass(resolve);
    pass.inOrder()
        .bind(view_)
        .bind("LightBlock", light_)
        .bind(soup_)
        .bind("Candidates", lists_)
        .bind("TileLists", answer_.tiles)
        .bind("Busy", busy_)
        .bind("Weights", answer_.weights)
        .bind("radiance", radiance)
        .bind("States", states_)
        .bind("Rounds", rounds_)
        .bind("visibility", visibility)
        .bind("errorBound", answer_.errorBound);
    if (pass.has("Masks")) pass.bind("Masks", masks_);
    bindMaskGroup(pass, maskTextures, 0);
    ExactRound round{.number = 0, .work = roundWork_, .turnRounds = turnRounds, .groups = groups};
    pass.constants(round).dispatchIndirect(busy_);
    while (++round.number < turns * turnRounds) {
        if (groups > 1 && round.number % turnRounds == 0)
            bindMaskGroup(pass, maskTextures, round.number / turnRounds % groups);
        // Without work groups where nobody asked for the round.
        pass.constants(round).dispatchIndirect(rounds_,
                                               3 * sizeof(std::uint32_t) * std::size_t(round.number));
    }
    if (keeps) {
        gl::Pass(restore_)
            .bind("kept", answer_.visibility)
            .bind("visibility", imageOf(out))
            .dispatchPixels(out.width_px(), out.height_px());
    }
    std::swap(answer_.key, key_);
    answer_.casterRevision = soup_.revision();
}

void ExactVisibility::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "error bound", .texture = answer_.errorBound.name()});
}

Statistics ExactVisibility::statistics() const {
    const TileCounts tiles = answer_.countTiles();
    const ErrorBounds bounds = answer_.readBounds();
    BusyTiles busy{};
    if (busy_.size_bytes() >= sizeof busy) busy_.read(std::as_writable_bytes(std::span(&busy, 1)));
    Statistics statistics;
    statistics.counts = {
        {"triangles", double(soup_.triangleCount())},
        {"tiles with candidates", double(tiles.withCandidates)},
        {"candidates per tile",
         tiles.withCandidates > 0 ? double(tiles.candidates) / tiles.withCandidates : 0.0},
        {"most candidates in a tile", double(tiles.mostCandidates)},
        {"tiles beyond their room", double(tiles.full)},
        {"tiles looked at", double(busy.count)},
        {"penumbra pixels", double(bounds.pixels)},
        {"mean error bound", bounds.pixels > 0 ? bounds.sum / bounds.pixels : 0.0},
        {"largest error bound", bounds.largest},
        {"memory",
         double(soup_.size_bytes() + lists_.size_bytes() + busy_.size_bytes() + states_.size_bytes() +
                rounds_.size_bytes() + answer_.size_bytes() + receivers_.size_bytes()) /
             (1 << 20),
         "MiB"},
    };
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra::exact_visibility
