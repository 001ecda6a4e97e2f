// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/adaptive.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "src/techniques/common/input_key.h"

namespace penumbra::light_sampling {
namespace {

constexpr std::array<const char*, mostRounds> mapPasses = {
    "adaptive/maps of round 0", "adaptive/maps of round 1", "adaptive/maps of round 2",
    "adaptive/maps of round 3"};
constexpr std::array<const char*, mostRounds> comparisonPasses = {
    "adaptive/comparison of round 0", "adaptive/comparison of round 1", "adaptive/comparison of round 2",
    "adaptive/comparison of round 3"};
constexpr std::array<const char*, mostRounds> decisionPasses = {
    "adaptive/decision of round 0", "adaptive/decision of round 1", "adaptive/decision of round 2",
    "adaptive/decision of round 3"};
constexpr const char* lastMapsPass = "adaptive/maps of the last round";
/// Points of a cell: they make bands as many times narrower. The paper's test passes bands of three pixels
/// (section 3.3.3: a different value in the 1-ring), of which four make less than a pixel; an error target
/// takes more.
constexpr int tapsAgainstBands = 4;
constexpr int tapsForError = 16;

/// The error of a cell that an edge crosses, over its area, in the root mean square. Without a filter nothing
/// is known of its lit part: all parts alike deviate by 1 / sqrt(12). With one, straight edges of all
/// directions and places: the 16 points of the kernel against the area.
constexpr float errorOfUnknownCell = 0.289f;
constexpr float errorOfSmoothedCell = 0.042f;

/// Of a tree whose every quad is split once.
constexpr int leastSamples = 9;

/// Of a light's maps. What is compared stays, 81 maps at most, and the others come in batches. Suns take
/// more: there texels are what errors come from. So does the paper, which keeps all of its maps.
constexpr double memory_bytes = 120.0 * 1024 * 1024, largeMemory_bytes = 320.0 * 1024 * 1024;

/// Steps of an eighth, of which the error of a ramp is 0.04.
constexpr int depthWithoutFilter = 3;

}  // namespace

AdaptiveLightSampling::AdaptiveLightSampling(Device& device)
    : device_(device),
      maps_(device),
      receivers_(device),
      subdivision_(device),
      evaluation_(device),
      radiance_(device) {}

void AdaptiveLightSampling::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> weights = {"area", "paper"};
    static constexpr std::array<std::string_view, 2> lattices = {"cells", "corners"};
    static constexpr std::array<std::string_view, 2> countings = {"counters", "queries"};
    static constexpr std::array<std::string_view, 2> emissions = {"surface", "volume"};
    visitor.boolean(
        {.name = "published",
         .help = "the paper alone: lattice=corners, counting=queries, min_depth=0, weights=paper, "
                 "smooth=false, reuse=false, plain kernels"},
        isPublished_);
    visitor.integer({.name = "max_samples", .help = "the most points of the light to draw maps from"},
                    options_.maxSamples, {1, latticeVertices});
    visitor.integer({.name = "max_depth", .help = "the most times that the light is quartered"},
                    options_.maxDepth, {0, deepestLevel});
    visitor.integer(
        {.name = "min_depth", .help = "the least times that all of the light is quartered (the paper's: 0)"},
        options_.minDepth, {0, deepestLevel});
    visitor.integer(
        {.name = "tolerated", .unit = "fragments", .help = "that may fail the test without a split"},
        options_.tolerated, {0, 1 << 24});
    visitor.real({.name = "comparison_scale", .help = "side of the comparison target over that of the frame"},
                 comparisonScale_, {0.0625f, 1});
    visitor.real(
        {.name = "max_error",
         .help = "split until the bound of no pixel's error exceeds this; 0: the paper's test decides"},
        options_.maxError, {0, 1});
    visitor.choice(
        {.name = "weights", .help = "of samples: the area each stands for, or the paper's equation 3"},
        weights_, weights);
    visitor.choice(
        {.name = "lattice", .help = "samples: the middles of 17 x 17 cells, or the light's very corners"},
        lattice_, lattices);
    visitor.choice(
        {.name = "counting",
         .help = "failing fragments: by counters, on the device, or by occlusion queries, one a quad, "
                 "for which the CPU waits; these know no max_error, smooth and reuse"},
        counting_, countings);
    visitor.real({.name = "jitter", .help = "moves samples at random; in parts of the lattice's cell"},
                 jitter_, {0, 1});
    visitor.choice({.name = "emission",
                    .help = "a ball shines from its surface, or from all of its inside (counting=queries)"},
                   emission_, emissions);
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 16384});
    visitor.boolean({.name = "smooth",
                     .help = "filter between samples that disagree, as wide as their shadows lie apart"},
                    smooths_);
    visitor.boolean({.name = "reuse", .help = "keep maps and subdivision while nothing has changed"},
                    reuses_);
    evaluationOptions_.describe(visitor);
}

bool AdaptiveLightSampling::usesBits() const {
    return comparisonScale_ == 1 && evaluationOptions_.filter == 1 &&
           evaluationOptions_.path == EvaluationOptions::array;
}

int AdaptiveLightSampling::taps() const {
    if (!smooths_ || !usesBits() || !maps_.isResident() || cameras_.isCube) return 0;
    return options_.maxError > 0 ? tapsForError : tapsAgainstBands;
}

bool AdaptiveLightSampling::isVolume(const AreaLight& light) const {
    return emission_ == 1 && light.shape == LightShape::sphere && light.radius_m > 0;
}

bool AdaptiveLightSampling::countsByQueries(const AreaLight& light) const {
    return isPublished_ || counting_ == 1 || isVolume(light);
}

void AdaptiveLightSampling::chooseSamples(const AreaLight& light, const LightSurface& surface) {
    samples_.clear();
    isCenterAlone_ = surface.isPoint() || options_.maxSamples < 4;
    if (isCenterAlone_) {
        samples_.push_back(surface.sample(glm::dvec2(0.5)));
        return;
    }
    if (isVolume(light)) {
        samples_ = ballSamples(light.radius_m, PublishedSampling::side(3));
        return;
    }
    const SamplePattern pattern = usesCorners() ? SamplePattern::corners : SamplePattern::cells;
    for (const PatternPoint& point : makePattern(pattern, latticeSide, 0, false, jitter_)) {
        samples_.push_back(surface.sampleWithSpans(point.square, 1.0 / latticeSide));
    }
}

SubdivisionOptions AdaptiveLightSampling::treeOptionsFor(const AreaLight& light, int mapSize_px) const {
    SubdivisionOptions options = options_;
    // The square's rim is the far side of a sphere, where its corners fall together: they have nothing to
    // compare.
    if (light.shape == LightShape::sphere) options.minDepth = std::max(2, options.minDepth);
    // Under the sun more and finer maps than were asked for are paid for with samples, so that all maps stay.
    if (light.shape == LightShape::distant) {
        const double sample_bytes =
            SampleMaps::texel_bytes * mapSize_px * mapSize_px * std::max(1, cameras_.faces);
        const int room = int(largeMemory_bytes / sample_bytes);
        if (room < options.mostSlotsInAll())
            options.maxSamples = std::min(options.maxSamples, std::max(leastSamples, room / 2));
    }
    // Where nothing filters between samples, more of them have to do: the test passes bands of three pixels.
    if (smooths_ && usesBits() && cameras_.isCube)
        options.minDepth = std::max(depthWithoutFilter, options.minDepth);
    return options;
}

SampleMaps::Room AdaptiveLightSampling::roomFor(const AreaLight& light) const {
    if (isCenterAlone_) return {.memory_bytes = largeMemory_bytes};
    if (countsByQueries(light))
        return {.samples = options_.maxSamples, .memory_bytes = largeMemory_bytes, .staysWithin = true};
    return {.samples = treeOptions_.mostSlotsInAll(),
            .compared = treeOptions_.mostCompared(),
            .memory_bytes = light.shape == LightShape::distant ? largeMemory_bytes : memory_bytes};
}

void AdaptiveLightSampling::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const Frame frame{inputs, lightFromWorld(inputs), out};

    // Maps and subdivision depend on nothing but the key; they stay where all maps have a place of their own.
    key_.clear();
    const bool isKnown = appendInputs(key_, inputs);
    appendBytes(key_, options_);
    appendBytes(key_, comparisonScale_);
    appendBytes(key_, smooths_);                 // an error target's tree depends on it
    appendBytes(key_, evaluationOptions_.path);  // and with these, what is looked up
    appendBytes(key_, evaluationOptions_.filter);
    appendBytes(key_, mapSize_px_);
    appendBytes(key_, usesCorners());
    appendBytes(key_, jitter_);
    appendBytes(key_, reuses_);  // else no answer has been kept
    const bool usesQueries = countsByQueries(inputs.light);
    wasStatic_ = reuses_ && !usesQueries && isKnown && key_ == lastKey_;
    lastKey_.clear();  // until the frame is complete

    if (!wasStatic_) {
        const LightSpaceScene scene = makeLightSpaceScene(inputs, frame.lightFromWorld);
        const LightSurface surface(inputs.light, scene);
        chooseSamples(inputs.light, surface);
        const int mapSize_px = cameras_.fitMaps(inputs.light, surface, samples_, scene, mapSize_px_,
                                                largeMemory_bytes / (leastSamples * SampleMaps::texel_bytes));
        treeOptions_ = treeOptionsFor(inputs.light, mapSize_px);
        maps_.prepare(inputs.casters, scene, samples_, cameras_, mapSize_px, roomFor(inputs.light));
    }
    maps_.keep(inputs.casters);
    view_.fill(inputs.view, frame.lightFromWorld);
    if (isCenterAlone_ || cameras_.faces == 0) {
        renderCenterAlone(frame);
    } else if (usesQueries) {
        renderByQueries(frame);
        return;
    } else {
        subdivide(frame);
        weigh(frame);
        evaluate(frame);
        subdivision_.requestReadback(maps_);
        wasPublished_ = false;
    }
    std::swap(lastKey_, key_);
}

void AdaptiveLightSampling::renderCenterAlone(const Frame& frame) {
    maps_.planAll();
    isCenterAlone_ = true;
    lastTreeOptions_.reset();
    if (frame.inputs.light.radianceTexture != 0) {
        const auto pass = timers_.pass("adaptive/weights");
        constexpr std::array whole = {glm::vec4(0, 0, 1, 1)};
        radiance_.weigh(frame.inputs.light.radianceTexture, whole, maps_.samples());
    }
    if (!wasStatic_) {
        const auto pass = timers_.pass(lastMapsPass);
        maps_.draw(stageOfAll, 0, cameras_, {});
    }
    evaluateBatch(frame, {});
}

void AdaptiveLightSampling::renderByQueries(const Frame& frame) {
    if (!published_) published_ = std::make_unique<PublishedSampling>(device_);
    lastTreeOptions_.reset();
    wasPublished_ = true;
    const bool isBall = isVolume(frame.inputs.light);
    EvaluationOptions evaluation = evaluationOptions_;
    evaluation.hasBoxKernel = isPublished_;
    evaluation.emitsThroughout = isBall;
    published_->render({.inputs = frame.inputs,
                        .view = view_,
                        .cameras = cameras_,
                        .samples = samples_,
                        .maps = maps_,
                        .radiance = radiance_,
                        .timers = timers_,
                        .out = frame.out},
                       {.maxSamples = options_.maxSamples,
                        .minDepth = isPublished_ ? 0 : options_.minDepth,
                        .maxDepth = options_.maxDepth,
                        .tolerated = options_.tolerated,
                        .comparisonScale = comparisonScale_,
                        .usesPaperWeights = usesPaperWeights(),
                        .dimensions = isBall ? 3 : 2,
                        .hasMargin = isBall || !usesCorners(),
                        .evaluation = evaluation});
}

void AdaptiveLightSampling::findReceivers(const Frame& frame) {
    const auto pass = timers_.pass("adaptive/receivers");
    receivers_.findAll(frame.inputs, view_, cameras_, maps_, frame.out);
}

SampleMaps::Needs AdaptiveLightSampling::needs(int depth) const {
    // What a sample stands for reaches half a quad's side to each side of it at most, and a quarter more
    // where that is turned into a square around its middle (Cell, in lattice_weights.comp.glsl).
    return {.tiles = &receivers_.all(),
            .tileCount = receivers_.count(),
            .reach = taps() > 0 ? 0.75f * float(16 >> depth) / latticeSide : 0,
            .redraw = wasStatic_ ? &receivers_.redraw() : nullptr};
}

void AdaptiveLightSampling::subdivide(const Frame& frame) {
    const auto scaled = [&](int size_px) {
        return std::max(1, int(std::lround(double(comparisonScale_) * size_px)));
    };
    subdivision_.prepare(scaled(frame.out.width_px()), scaled(frame.out.height_px()));
    treeOptions_.cellError = taps() > 0 ? errorOfSmoothedCell : errorOfUnknownCell;
    findReceivers(frame);
    if (wasStatic_) {
        // Nothing changes, but the host's depth may: what the device has found to be elsewhere is done again.
        evaluation_.restore(frame.out);
        for (int batch = 0; usesBits() && batch < maps_.batches(treeOptions_.mostCompared()); ++batch) {
            drawMaps(stageOfCoarse, batch, mapPasses[0], needs(treeOptions_.baseDepth()));
            compare(frame, stageOfCoarse, batch, 0);
        }
        return;
    }
    // Slots that are in no order of the tree's would change the order of sums where no bits hold the values.
    const bool isCoherent = usesBits() && maps_.isResident() && lastTreeOptions_ == treeOptions_;
    lastTreeOptions_ = treeOptions_;
    subdivision_.start(maps_, treeOptions_, isCoherent);
    for (int round = 0; round < treeOptions_.rounds(); ++round) {
        for (int batch = 0; batch < maps_.batches(treeOptions_.mostSlots(round)); ++batch) {
            drawMaps(round, batch, mapPasses[std::size_t(round)], needs(treeOptions_.baseDepth()));
            compare(frame, round, batch, round);
        }
        const auto pass = timers_.pass(decisionPasses[std::size_t(round)]);
        subdivision_.examine(maps_, treeOptions_);
        subdivision_.decide(maps_, round, treeOptions_);
    }
    if (treeOptions_.maxError > 0 && treeOptions_.maxDepth == deepestLevel) {
        subdivision_.examineError(treeOptions_);
    }
}

void AdaptiveLightSampling::compare(const Frame& frame, int stage, int batch, int round) {
    const auto pass = timers_.pass(comparisonPasses[std::size_t(round)]);
    subdivision_.compare(frame.inputs, view_, cameras_, maps_, treeOptions_, stage, batch,
                         wasStatic_ ? &receivers_.redraw() : nullptr);
}

void AdaptiveLightSampling::weigh(const Frame& frame) {
    const auto pass = timers_.pass("adaptive/weights");
    const GLuint texture = frame.inputs.light.radianceTexture;
    shares_.set(usesCorners());
    if (texture != 0) radiance_.weigh(texture, shares_.cells(), shares_.buffer());
    subdivision_.weigh(maps_, usesPaperWeights(), shares_, texture != 0);
}

void AdaptiveLightSampling::drawMaps(int stage, int batch, const char* passName,
                                     const SampleMaps::Needs& needs) {
    const auto pass = timers_.pass(passName);
    maps_.draw(stage, batch, cameras_, needs);
}

void AdaptiveLightSampling::evaluate(const Frame& frame) {
    SampleMaps::Needs ofDeepest = needs(treeOptions_.maxDepth);
    if (usesBits()) {
        {
            const auto pass = timers_.pass("adaptive/unsettled receivers");
            receivers_.findUnsettled(frame.inputs, view_, cameras_, maps_, subdivision_, frame.out,
                                     wasStatic_);
        }
        ofDeepest.tiles = &receivers_.unsettled();
        ofDeepest.asksByQuads = true;
        const int mostSlots = treeOptions_.mostSlots(treeOptions_.rounds());
        const int batches = maps_.batchesOfDeepest(mostSlots);
        for (int batch = 0; batch < batches; ++batch) {
            drawMaps(stageOfDeepest, batch, lastMapsPass, ofDeepest);
            evaluateBatch(frame, {.stage = stageOfDeepest,
                                  .batch = batch,
                                  .mostSlots = std::min(maps_.capacity(), mostSlots),
                                  .isOnlyOne = batches == 1,
                                  .bits = &subdivision_,
                                  .taps = taps()});
        }
        return;
    }
    const bool isWhole = maps_.isWhole();
    const int batches = maps_.batches(treeOptions_.maxSamples);
    if (isWhole) drawMaps(wasStatic_ ? stageOfAll : stageOfDeepest, 0, lastMapsPass, ofDeepest);
    for (int batch = 0; batch < batches; ++batch) {
        if (!isWhole) drawMaps(stageOfAll, batch, lastMapsPass, ofDeepest);
        evaluateBatch(frame, {.stage = stageOfAll,
                              .batch = batch,
                              .mostSlots = std::min(maps_.capacity(), treeOptions_.maxSamples),
                              .isOnlyOne = batches == 1});
    }
}

void AdaptiveLightSampling::evaluateBatch(const Frame& frame, SampleEvaluation::Batch batch) {
    const auto pass = timers_.pass("adaptive/evaluation");
    batch.isKept = reuses_ && !isCenterAlone_;
    batch.redraw = batch.isKept && wasStatic_ ? &receivers_.redraw() : nullptr;
    evaluation_.add(frame.inputs, view_, cameras_, evaluationOptions_, maps_, batch, frame.out);
}

void AdaptiveLightSampling::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth maps", .texture = maps_.texture().name(), .layers = maps_.texture().layers()});
    if (isCenterAlone_) return;
    const auto show = [&](const auto& tree) {
        visitor.texture({.name = "sums of the corners' shadows", .texture = tree.sumsPicture().name()});
        visitor.texture({.name = "failing fragments", .texture = tree.failingPicture().name()});
        visitor.texture({.name = "subdivision of the light", .texture = tree.quadsPicture().name()});
    };
    if (wasPublished_) {
        show(*published_);
    } else {
        subdivision_.illustrate();
        show(subdivision_);
    }
}

Statistics AdaptiveLightSampling::statistics() const {
    Statistics statistics{.passes = passTimes(timers_)};
    if (isCenterAlone_) {
        statistics.counts = {{"maps", double(cameras_.faces)}, {"samples", 1}};
        return statistics;
    }
    if (wasPublished_) {
        statistics.counts = published_->counts().statistics(cameras_.faces);
        return statistics;
    }
    const std::optional<SubdivisionPasses::Snapshot> latest = subdivision_.latest();
    if (!latest) return statistics;
    const auto& [tree, plan] = *latest;
    statistics.counts = TreeCounts::of(tree, plan.stages[stageOfAll].y).statistics(cameras_.faces);
    statistics.counts.push_back({"reused", double(wasStatic_)});
    if (options_.maxError > 0) {
        statistics.counts.push_back({"bound of the error", double(std::bit_cast<float>(tree.errorBound))});
    }
    return statistics;
}

}  // namespace penumbra::light_sampling
