// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/adaptive.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "src/techniques/light_sampling/input_key.h"

namespace penumbra {
namespace {

constexpr std::array<const char*, deepestLevel + 1> mapPasses = {
    "adaptive/maps of level 0", "adaptive/maps of level 1", "adaptive/maps of level 2",
    "adaptive/maps of level 3", "adaptive/maps of level 4"};
constexpr std::array<const char*, deepestLevel> comparisonPasses = {
    "adaptive/comparison of level 0", "adaptive/comparison of level 1", "adaptive/comparison of level 2",
    "adaptive/comparison of level 3"};
constexpr std::array<const char*, deepestLevel> decisionPasses = {
    "adaptive/decision of level 0", "adaptive/decision of level 1", "adaptive/decision of level 2",
    "adaptive/decision of level 3"};
constexpr std::array<const char*, deepestLevel + 1> sampleCounts = {
    "samples of level 0", "samples of level 1", "samples of level 2", "samples of level 3",
    "samples of level 4"};
constexpr std::array<const char*, deepestLevel> splitCounts = {
    "quads split at level 0", "quads split at level 1", "quads split at level 2", "quads split at level 3"};
constexpr std::array<const char*, deepestLevel> failingCounts = {
    "failing fragments of level 0", "failing fragments of level 1", "failing fragments of level 2",
    "failing fragments of level 3"};

constexpr int cellsPerSide = 34;  // see lattice_weights.comp.glsl

}  // namespace

AdaptiveLightSampling::AdaptiveLightSampling(Device& device)
    : maps_(device),
      subdivision_(device),
      evaluation_(device),
      radiance_(device),
      cellShares_(cellsPerSide * cellsPerSide * sizeof(LightSample), "light sampling cell shares") {
    const std::vector<LightSample> shares(cellsPerSide * cellsPerSide,
                                          {.weight = glm::vec4(1.0f / (cellsPerSide * cellsPerSide))});
    cellShares_.write(std::as_bytes(std::span(shares)));
    for (const PatternPoint& cell : makePattern(SamplePattern::cells, cellsPerSide, 0, false)) {
        cells_.emplace_back(glm::vec2(cell.cellMin), glm::vec2(cell.cellMax));
    }
}

void AdaptiveLightSampling::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> weights = {"area", "paper"};
    visitor.integer({.name = "max_samples", .help = "the most points of the light to draw maps from"},
                    options_.maxSamples, {1, latticeVertices});
    visitor.integer({.name = "max_depth", .help = "the most times that the light is quartered"}, maxDepth_,
                    {0, deepestLevel});
    visitor.integer(
        {.name = "min_depth", .help = "the least times that all of the light is quartered (the paper's: 0)"},
        options_.minDepth, {0, deepestLevel});
    visitor.integer(
        {.name = "tolerated", .unit = "fragments", .help = "that may fail the test without a split"},
        options_.tolerated, {0, 1 << 24});
    visitor.real({.name = "comparison_scale", .help = "side of the comparison target over that of the frame"},
                 comparisonScale_, {0.0625f, 1});
    visitor.real({.name = "max_error",
                  .help = "split until no pixel's estimated error exceeds this; 0: the paper's test decides"},
                 options_.maxError, {0, 1});
    visitor.choice(
        {.name = "weights", .help = "of samples: the area each stands for, or the paper's equation 3"},
        weights_, weights);
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 16384});
    visitor.boolean({.name = "reuse", .help = "keep maps and subdivision while nothing has changed"},
                    reuses_);
    evaluationOptions_.describe(visitor);
}

bool AdaptiveLightSampling::usesBits() const {
    return comparisonScale_ == 1 && evaluationOptions_.filter == 1 &&
           evaluationOptions_.path == EvaluationOptions::array;
}

void AdaptiveLightSampling::chooseSamples(const LightSurface& surface) {
    samples_.clear();
    isCenterAlone_ = surface.isPoint() || options_.maxSamples < 4;
    if (isCenterAlone_) {
        samples_.push_back(surface.sample(glm::dvec2(0.5)));
        return;
    }
    for (const PatternPoint& point : makePattern(SamplePattern::cells, latticeSide, 0, false)) {
        samples_.push_back(surface.sample(point.square));
    }
}

void AdaptiveLightSampling::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    checkInputs(inputs, out);
    const Frame frame{inputs, lightFromWorld(inputs), out};

    // Maps and subdivision depend on nothing but the key; they stay where all maps have a place of their own.
    key_.clear();
    const bool isKnown = appendInputs(key_, inputs);
    appendBytes(key_, options_);
    appendBytes(key_, maxDepth_);
    appendBytes(key_, comparisonScale_);
    appendBytes(key_, mapSize_px_);
    wasStatic_ = reuses_ && isKnown && key_ == lastKey_ && maps_.isResident();
    lastKey_.clear();  // until the frame is complete

    if (!wasStatic_) {
        const LightSpaceScene scene = makeLightSpaceScene(inputs, frame.lightFromWorld);
        const LightSurface surface(inputs.light, scene);
        chooseSamples(surface);
        const int mapSize_px = mapSizeFor(surface, mapSize_px_);
        cameras_.fit(inputs.light, surface, samples_, scene, mapSize_px);
        maps_.prepare(inputs.casters, scene, samples_, cameras_, mapSize_px,
                      isCenterAlone_ ? 1 : options_.maxSamples);
    }
    if (isCenterAlone_ || cameras_.faces == 0) {
        renderCenterAlone(frame);
    } else {
        subdivide(frame);
        weigh(frame);
        evaluate(frame);
        subdivision_.requestReadback(maps_);
    }
    std::swap(lastKey_, key_);
}

void AdaptiveLightSampling::renderCenterAlone(const Frame& frame) {
    SamplingPlan plan{};
    for (glm::ivec4& stage : plan.stages) stage = {0, 1, 0, 0};
    constexpr std::array slots = {0};
    maps_.writePlan(plan, slots);
    isCenterAlone_ = true;
    if (frame.inputs.light.radianceTexture != 0) {
        const auto pass = timers_.pass("adaptive/weights");
        constexpr std::array whole = {glm::vec4(0, 0, 1, 1)};
        radiance_.weigh(frame.inputs.light.radianceTexture, whole, maps_.samples());
    }
    evaluateStage(frame, stageOfAll, 1, !wasStatic_);
}

void AdaptiveLightSampling::subdivide(const Frame& frame) {
    const auto scaled = [&](int size_px) {
        return std::max(1, int(std::lround(double(comparisonScale_) * size_px)));
    };
    subdivision_.prepare(scaled(frame.out.width_px()), scaled(frame.out.height_px()));
    // The square's rim is the far side of a sphere, where its corners fall together: they have nothing to
    // compare.
    SubdivisionOptions options = options_;
    if (frame.inputs.light.shape == LightShape::sphere) options.minDepth = std::max(2, options.minDepth);
    if (!wasStatic_) subdivision_.start(maps_, options);
    for (int level = 0; level < maxDepth_; ++level) {
        // A static frame asks the maps again, in case the host's depth has changed, but changes nothing else.
        if (!wasStatic_ || usesBits()) compareLevel(frame, level);
        if (wasStatic_) continue;
        const auto pass = timers_.pass(decisionPasses[std::size_t(level)]);
        subdivision_.examine(level, options);
        subdivision_.decide(maps_, level, options);
    }
    if (!wasStatic_ && options_.maxError > 0 && maxDepth_ == deepestLevel) {
        subdivision_.examine(deepestLevel, options_);
    }
}

void AdaptiveLightSampling::compareLevel(const Frame& frame, int level) {
    const int mostSlots = std::min(SubdivisionPasses::mostSlots[std::size_t(level)], options_.maxSamples);
    for (int batch = 0; batch < maps_.batches(mostSlots); ++batch) {
        if (!wasStatic_) {
            const auto pass = timers_.pass(mapPasses[std::size_t(level)]);
            maps_.draw(level, batch);
        }
        const auto pass = timers_.pass(comparisonPasses[std::size_t(level)]);
        view_.bind(frame.inputs.view, frame.lightFromWorld);
        subdivision_.compare(frame.inputs, cameras_, maps_, level, batch, level == 0 && batch == 0);
    }
}

void AdaptiveLightSampling::weigh(const Frame& frame) {
    const auto pass = timers_.pass("adaptive/weights");
    const GLuint texture = frame.inputs.light.radianceTexture;
    if (texture != 0) radiance_.weigh(texture, cells_, cellShares_);
    subdivision_.weigh(maps_, weights_ == 1, texture != 0 ? &cellShares_ : nullptr);
}

void AdaptiveLightSampling::evaluate(const Frame& frame) {
    const int deepestSlots =
        std::min(SubdivisionPasses::mostSlots[std::size_t(maxDepth_)], options_.maxSamples);
    if (usesBits()) {
        subdivision_.bindBits(4);
        evaluateStage(frame, maxDepth_, deepestSlots, !wasStatic_);
        return;
    }
    if (maps_.isResident()) {
        if (!wasStatic_) {
            const auto pass = timers_.pass(mapPasses[std::size_t(maxDepth_)]);
            maps_.draw(maxDepth_, 0);
        }
        evaluateStage(frame, stageOfAll, options_.maxSamples, false);
        return;
    }
    evaluateStage(frame, stageOfAll, options_.maxSamples, true);
}

void AdaptiveLightSampling::evaluateStage(const Frame& frame, int stage, int mostSlots, bool draws) {
    const int batches = maps_.batches(mostSlots);
    for (int batch = 0; batch < batches; ++batch) {
        if (draws) {
            const auto pass = timers_.pass(mapPasses[std::size_t(std::min(stage, deepestLevel))]);
            maps_.draw(stage, batch);
        }
        const auto pass = timers_.pass("adaptive/evaluation");
        view_.bind(frame.inputs.view, frame.lightFromWorld);
        evaluation_.add(frame.inputs, cameras_, evaluationOptions_, maps_,
                        {.stage = stage,
                         .batch = batch,
                         .mostSlots = std::min(maps_.capacity(), mostSlots),
                         .starts = batch == 0,
                         .ends = batch == batches - 1,
                         .usesBits = usesBits() && stage != stageOfAll},
                        frame.out);
    }
}

void AdaptiveLightSampling::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth maps", .texture = maps_.texture().name(), .layers = maps_.texture().layers()});
    if (isCenterAlone_) return;
    subdivision_.illustrate();
    visitor.texture({.name = "sums of the corners' shadows", .texture = subdivision_.sumsPicture().name()});
    visitor.texture({.name = "failing fragments", .texture = subdivision_.failingPicture().name()});
    visitor.texture({.name = "subdivision of the light", .texture = subdivision_.quadsPicture().name()});
}

Statistics AdaptiveLightSampling::statistics() const {
    Statistics statistics{.passes = passTimes(timers_)};
    if (isCenterAlone_) {
        statistics.counts = {{"maps", double(cameras_.faces)}, {"samples", 1}};
        return statistics;
    }
    const std::optional<SubdivisionPasses::Snapshot> latest = subdivision_.latest();
    if (!latest) return statistics;
    const auto& [tree, plan] = *latest;
    const double samples = plan.stages[stageOfAll].y;
    statistics.counts = {{"maps", samples * cameras_.faces},
                         {"samples", samples},
                         {"reached the maximum", double(tree.reachedMaximum)},
                         {"reused", double(wasStatic_)}};
    std::size_t quad = 0;
    for (std::size_t level = 0; level < deepestLevel; ++level) {
        double split = 0, failing = 0;
        for (std::size_t end = quad + (std::size_t(1) << (2 * level)); quad < end; ++quad) {
            split += tree.split[quad];
            failing += tree.failing[quad];
        }
        statistics.counts.push_back({sampleCounts[level], double(plan.stages[level].y)});
        statistics.counts.push_back({splitCounts[level], split});
        statistics.counts.push_back({failingCounts[level], failing, "fragments"});
    }
    statistics.counts.push_back({sampleCounts[deepestLevel], double(plan.stages[deepestLevel].y)});
    if (options_.maxError > 0) {
        statistics.counts.push_back({"estimated error", double(std::bit_cast<float>(tree.errorEstimate))});
        statistics.counts.push_back({"bound of the error", double(std::bit_cast<float>(tree.errorBound))});
    }
    return statistics;
}

}  // namespace penumbra
