// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/exact.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>

#include "src/gl/pass.h"
#include "src/techniques/common/input_key.h"
#include "src/techniques/common/light_constants.h"
#include "src/techniques/exact_visibility/light_description.h"
#include "src/techniques/exact_visibility/round_plan.h"

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

}  // namespace

ExactVisibility::ExactVisibility(Device& device)
    : roundWork_(internalsOf(device).isSoftware ? softwareRoundWork : hardwareRoundWork),
      device_(internalsOf(device)),
      candidates_(device_.shaders, {candidatesShader}),
      sift_(device_.shaders, {"src/techniques/exact_visibility/sift.comp.glsl"}),
      weigh_(device_.shaders, {"src/techniques/exact_visibility/weights.comp.glsl"}),
      restore_(device_.shaders, {"src/techniques/common/restore.comp.glsl"}),
      frame_("exact/frame"),
      receivers_(device_.shaders),
      tiles_(device_.shaders),
      masks_("exact/masks"),
      panes_("exact/panes"),
      changedBoxes_("exact/changed boxes"),
      light_("exact/light") {}

void ExactVisibility::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> weights = {"area", "irradiance"};
    visitor.integer({.name = "samples", .help = "points of the light whose visibility is determined"},
                    samples_, {16, 1024});
    visitor.choice({.name = "weight",
                    .help = "what each part of the light counts: its area, or what it sends to the surface"},
                   weight_, weights);
    visitor.integer({.name = "cells",
                     .unit = "along a side",
                     .help = "of a rectangle that is not textured, past casters that are no panes: what is "
                             "seen of each stands in the inspected texture 'cells'"},
                    cells_, {1, EXACT_MOST_CELLS});
    visitor.boolean(
        {.name = "stand_ins",
         .help = "coarser geometry for what is far from whom it shadows, where that moves no edge "
                 "by more than a quarter of the distance between samples"},
        usesStandIns_);
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

const gl::Program& ExactVisibility::resolveFor(const ResolveKind& kind) {
    const auto found = resolve_.find(kind);
    if (found != resolve_.end()) return found->second;
    std::vector<std::string> defines{"ROWS " + std::to_string(kind.rows)};
    if (kind.isOfParts) defines.emplace_back("WITH_PARTS");
    if (kind.hasHoles) defines.emplace_back("WITH_HOLES");
    if (kind.isUneven) defines.emplace_back("WITH_WEIGHTS");
    if (kind.cells > 1) defines.emplace_back("CELLS " + std::to_string(kind.cells));
    if (kind.paneSteps > 0) defines.emplace_back("PANE_STEPS " + std::to_string(kind.paneSteps));
    return resolve_.emplace(kind, gl::Program(device_.shaders, {resolveShader}, std::move(defines)))
        .first->second;
}

int ExactVisibility::cellsFor(const AreaLight& light) const {
    const bool hasCells = light.shape == LightShape::rect && hasSize(light) && light.radianceTexture == 0 &&
                          soup_.paneTriangleCount() == 0;
    return hasCells ? cells_ : 1;
}

/// Writes down what each mask asks of its texture, and which that is, and what panes let through.
void ExactVisibility::sendMasks() {
    maskTextures_.clear();
    std::vector<glm::vec4> masks;
    for (const AlphaMask& mask : soup_.masks()) {
        auto it = std::ranges::find(maskTextures_, mask.texture);
        if (it == maskTextures_.end()) it = maskTextures_.insert(it, mask.texture);
        const auto which = int(it - maskTextures_.begin());
        masks.emplace_back(mask.factor, mask.cutoff, which % EXACT_GROUP_TEXTURES,
                           which / EXACT_GROUP_TEXTURES);
    }
    masks_.write(masks);
    panes_.write(soup_.transmittances());
}

/// Where the answer for a frame's light is kept. Beyond a quarter of a gigabyte lights share one, which is
/// then never as it was.
LightAnswer& ExactVisibility::answerFor(std::size_t place, const View& view) {
    constexpr std::size_t mostKept_bytes = std::size_t(256) << 20, pixel_bytes = 10;
    const std::size_t each_bytes = std::size_t(view.width_px) * std::size_t(view.height_px) * pixel_bytes;
    const std::size_t last = std::max<std::size_t>(mostKept_bytes / each_bytes, 1) - 1;
    while (answers_.size() <= std::min(place, last)) answers_.emplace_back();
    return answers_[std::min(place, last)];
}

void ExactVisibility::describeKey(const Stage& stage, const FrameLight& asked) {
    key_.clear();
    appendLight(key_, asked.light);
    appendBytes(key_, asked.out->colored());
    appendBytes(key_, stage.originWorld);
    appendBytes(key_, stage.hasCasters);
    appendBytes(key_, samples_);
    appendBytes(key_, weight_);
    appendBytes(key_, cells_);
    appendBytes(key_, usesStandIns_);
}

/// Whether tiles may keep their answers: the camera, the light and the options are those of the last frame,
/// and casters that are not are known. (Answers for cells are not kept.)
bool ExactVisibility::canKeep(const Stage& stage, const FrameLight& asked, const LightAnswer& answer) {
    describeKey(stage, asked);
    return isSameView_ && cells_ == 1 && key_ == answer.key &&
           (!stage.hasCasters || soup_.tellsChangesSince(answer.casterRevision));
}

void ExactVisibility::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const FrameLight light{.light = inputs.light, .out = &out};
    renderLights({.view = inputs.view, .casters = inputs.casters, .lights = {&light, 1}});
}

void ExactVisibility::renderLights(const FrameInputs& frame) {
    if (frame.lights.empty()) return;
    {
        const auto pass = frameTimers_.pass("exact/upload");
        soup_.update(frame.casters, usesStandIns_);
        sendMasks();
    }
    isSameView_ = receivers_.follow(frame.view);
    ++serial_;
    // Without casters coordinates begin elsewhere: with the bits of a frame that has none.
    const Stage casting{.view = frame.view,
                        .originWorld = soup_.originWorld(),
                        .frame = describeFrame(frame.view, soup_.originWorld(), tileCapacity_),
                        .casterRevision = soup_.revision(),
                        .hasCasters = true};
    const Stage bare{.view = frame.view, .frame = describeFrame(frame.view, glm::dvec3(0), tileCapacity_)};
    const Stage* prepared = nullptr;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        const Stage& stage = frame.lights[i].castsShadow ? casting : bare;
        if (std::exchange(prepared, &stage) != &stage) prepare(stage, frame);
        isFirst_ = i == 0;
        answer(stage, frame.lights[i], i);
        if (frame.answered) frame.answered(i);
    }
}

void ExactVisibility::prepare(const Stage& stage, const FrameInputs& frame) {
    glm::dmat4 sceneFromWorld(1);
    sceneFromWorld[3] = glm::dvec4(-stage.originWorld, 1);
    view_.fill(stage.view, sceneFromWorld);
    frame_.write(stage.frame);
    bool keeps = false;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        if (frame.lights[i].castsShadow != stage.hasCasters) continue;
        keeps = keeps || canKeep(stage, frame.lights[i], answerFor(i, stage.view));
    }
    const auto pass = frameTimers_.pass("exact/receivers");
    if (keeps) {
        receivers_.look(stage.view, view_, serial_);
        changedBoxes_.write(soup_.changedBoxes());
    }
    tiles_.look(stage.view, view_, frame_, stage.originWorld, receivers_, keeps ? serial_ : 0);
}

void ExactVisibility::answer(const Stage& stage, const FrameLight& asked, std::size_t place) {
    const AreaLight& light = asked.light;
    LightAnswer& answer = answerFor(place, stage.view);
    const bool keeps = canKeep(stage, asked, answer);
    answer.key.clear();  // until it is there
    answer.fit(asked.out->width_px(), asked.out->height_px(),
               asked.out->colored() ? gl::Format::rgba16f : gl::Format::r32f, cellsFor(light));
    answer_ = &answer;
    const gl::TextureRef visibility = keeps ? answer.visibility.ref() : imageOf(*asked.out);
    const ExactLight described = describeLight(light, stage.originWorld, latticesFor(light), weight_ != 0,
                                               stage.hasCasters ? int(soup_.nodeCount()) : 0);
    light_.write(described);
    findCandidates(stage, light, visibility, keeps);
    if (stage.view.isOfPoints) sift(visibility);
    resolve(stage, light, described, visibility);
    if (keeps) {
        gl::Pass(restore_)
            .bind("kept", answer.visibility)
            .bind("visibility", imageOf(*asked.out))
            .dispatchPixels(asked.out->width_px(), asked.out->height_px());
    }
    std::swap(answer.key, key_);
    answer.casterRevision = stage.casterRevision;
}

/// What all passes over tiles read, and where they answer.
void ExactVisibility::bindTiles(gl::Pass& pass, const gl::TextureRef& visibility) const {
    pass.bind(view_)
        .bind("FrameBlock", frame_)
        .bind("LightBlock", light_)
        .bind(soup_)
        .bind("Candidates", lists_)
        .bind("TileLists", answer_->tiles)
        .bind("visibility", visibility)
        .bind("errorBound", answer_->errorBound);
}

void ExactVisibility::findCandidates(const Stage& stage, const AreaLight& light,
                                     const gl::TextureRef& visibility, bool keeps) {
    LightAnswer& answer = *answer_;
    if (light.radianceTexture != 0) {
        const auto pass = timers_.pass("exact/weights");
        gl::Pass(weigh_)
            .constants(ExactLook{.serial = serial_})
            .bind("LightBlock", light_)
            .bind("radiance", gl::TextureRef{.name = light.radianceTexture})
            .bind("Weights", answer.weights)
            .dispatch(EXACT_MAX_ROWS / 8, EXACT_MAX_ROWS / 8, latticesFor(light).size());
    }
    const auto timed = timers_.pass("exact/candidates");
    busy_.reserve(sizeof(BusyTiles) + answer.tileCount * sizeof(std::uint32_t), "exact/busy tiles");
    busy_.clear(0, sizeof(BusyTiles));
    lists_.reserve(answer.tileCount * std::size_t(tileCapacity_) * sizeof(std::uint32_t), "exact/candidates");
    const bool haveCastersChanged = stage.casterRevision != answer.casterRevision;
    constexpr std::size_t groupTiles = 32;
    gl::Pass pass(candidates_);
    bindTiles(pass, visibility);
    pass
        .constants(ExactKeeping{
            .keeps = bool32(keeps),
            .changedBoxes = keeps && haveCastersChanged ? int(soup_.changedBoxes().size() / 2) : 0,
            .standInShift = usesStandIns_ ? standInShift(light, latticesFor(light), weight_ != 0) : 0})
        .bind("Tiles", tiles_.bounds())
        .bind("TileRevisions", receivers_.tileRevisions())
        .bind("Weights", answer.weights)
        .bind("MadeAt", answer.madeAt)
        .bind("ChangedBoxes", changedBoxes_)
        .bind("Busy", busy_)
        .dispatch((answer.tileCount + groupTiles - 1) / groupTiles);
}

/// Of points that follow each other most see all or nothing, where pixels have shared that with their tile.
void ExactVisibility::sift(const gl::TextureRef& visibility) {
    const auto timed = timers_.pass("exact/sift");
    parts_.reserve(sizeof(BusyTiles) + answer_->tileCount * EXACT_TILE_PARTS * sizeof(std::uint32_t),
                   "exact/busy parts of tiles");
    parts_.clear(0, sizeof(BusyTiles));
    gl::Pass pass(sift_);
    bindTiles(pass, visibility);
    pass.bind("Busy", busy_).bind("Parts", parts_).dispatchIndirect(busy_);
}

void ExactVisibility::resolve(const Stage& stage, const AreaLight& light, const ExactLight& described,
                              const gl::TextureRef& visibility) {
    const RoundPlan plan = planRounds(soup_, light, described, latticesFor(light), stage.frame.eye,
                                      maskTextures_.size(), roundWork_);
    const bool isCone = light.shape == LightShape::sphere || light.shape == LightShape::distant;
    const int cells = cellsFor(light);
    const bool isUneven = isCone || weight_ != 0 || light.radianceTexture != 0 || cells > 1;
    const auto pixels =
        std::size_t(answer_->errorBound.width_px()) * std::size_t(answer_->errorBound.height_px());
    const std::size_t stateWords =
        EXACT_STATE_WORDS + plan.rows + (plan.paneSteps > 0 ? EXACT_PANE_WORDS : 0);
    states_.reserve(pixels * stateWords * sizeof(std::uint32_t), "exact/states");
    rounds_.reserve(std::size_t(plan.rounds + 1) * 3 * sizeof(std::uint32_t), "exact/rounds");

    const auto timed = timers_.pass("exact/resolve");
    rounds_.clear();
    const gl::Buffer& busy = stage.view.isOfPoints ? parts_ : busy_;
    gl::Pass pass(resolveFor(
        {int(plan.rows), stage.view.isOfPoints, soup_.maskedCount() > 0, isUneven, cells, plan.paneSteps}));
    bindTiles(pass, visibility);
    pass.inOrder()
        .bind("Busy", busy)
        .bind("Weights", answer_->weights)
        .bind("radiance", gl::TextureRef{.name = light.radianceTexture})
        .bind("States", states_)
        .bind("Rounds", rounds_);
    if (cells > 1) pass.bind("cells", answer_->cells);
    if (pass.has("Masks")) pass.bind("Masks", masks_);
    if (pass.has("Panes")) pass.bind("Panes", panes_);
    bindMaskGroup(pass, maskTextures_, 0);
    ExactRound round{.number = 0, .work = roundWork_, .turnRounds = plan.turnRounds, .groups = plan.groups};
    pass.constants(round).dispatchIndirect(busy);
    const bool looks = stage.view.isOfPoints && device_.isSoftware;
    for (int turn = 0;;) {
        ++round.number;
        if (looks) round.number = askedRound(round.number, plan.rounds);
        if (round.number >= plan.rounds) break;
        if (plan.groups > 1 &&
            std::exchange(turn, round.number / plan.turnRounds) != round.number / plan.turnRounds)
            bindMaskGroup(pass, maskTextures_, turn % plan.groups);
        // Without work groups where nobody asked for the round.
        pass.constants(round).dispatchIndirect(rounds_,
                                               3 * sizeof(std::uint32_t) * std::size_t(round.number));
    }
}

/// The next round, of `count`, for which somebody has asked, or `count`. Software has done all that it was
/// told, so that a look costs less than rounds for nobody; who asks at points waits for the answer anyway.
int ExactVisibility::askedRound(int next, int count) const {
    constexpr int atATime = 256;
    std::array<std::array<std::uint32_t, 3>, atATime> groups;
    while (next < count) {
        const std::span some = std::span(groups).first(std::size_t(std::min(count - next, atATime)));
        rounds_.read(std::as_writable_bytes(some), sizeof(groups[0]) * std::size_t(next));
        const auto asked = std::ranges::find_if(some, [](const auto& round) { return round[0] > 0; });
        next += int(asked - some.begin());
        if (asked != some.end()) break;
    }
    return next;
}

void ExactVisibility::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "error bound", .texture = answer_ != nullptr ? answer_->errorBound.name() : 0});
    if (answer_ != nullptr && answer_->cells.name() != 0)
        visitor.texture(
            {.name = "cells", .texture = answer_->cells.name(), .layers = answer_->cells.layers()});
}

Statistics ExactVisibility::statistics() const {
    const TileCounts tiles = answer_ != nullptr ? answer_->countTiles() : TileCounts();
    const ErrorBounds bounds = answer_ != nullptr ? answer_->readBounds() : ErrorBounds();
    BusyTiles busy{};
    if (busy_.size_bytes() >= sizeof busy) busy_.read(std::as_writable_bytes(std::span(&busy, 1)));
    std::size_t memory_bytes = soup_.size_bytes() + lists_.size_bytes() + busy_.size_bytes() +
                               parts_.size_bytes() + states_.size_bytes() + rounds_.size_bytes() +
                               receivers_.size_bytes() + tiles_.size_bytes();
    for (const LightAnswer& answer : answers_) memory_bytes += answer.size_bytes();
    Statistics statistics;
    statistics.counts = {
        {"triangles", double(soup_.triangleCount() - soup_.standInTriangleCount())},
        {"triangles of stand-ins", double(soup_.standInTriangleCount())},
        {"tiles with candidates", double(tiles.withCandidates)},
        {"candidates per tile",
         tiles.withCandidates > 0 ? double(tiles.candidates) / tiles.withCandidates : 0.0},
        {"most candidates in a tile", double(tiles.mostCandidates)},
        {"tiles beyond their room", double(tiles.full)},
        {"tiles looked at", double(busy.count)},
        {"penumbra pixels", double(bounds.pixels)},
        {"mean error bound", bounds.pixels > 0 ? bounds.sum / bounds.pixels : 0.0},
        {"largest error bound", bounds.largest},
        {"memory", double(memory_bytes) / (1 << 20), "MiB"},
    };
    // What a frame's lights share counts for the first of them.
    if (isFirst_) statistics.passes = passTimes(frameTimers_);
    std::ranges::copy(passTimes(timers_), std::back_inserter(statistics.passes));
    return statistics;
}

}  // namespace penumbra::exact_visibility
