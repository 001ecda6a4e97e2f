// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/published.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/techniques/light_sampling/published_io.h"

namespace penumbra::light_sampling {
namespace {

constexpr std::array<const char*, deepestLevel + 1> mapPasses = {
    "adaptive/maps of level 0", "adaptive/maps of level 1", "adaptive/maps of level 2",
    "adaptive/maps of level 3", "adaptive/maps of level 4"};
constexpr std::array<const char*, deepestLevel> comparisonPasses = {
    "adaptive/queries of level 0", "adaptive/queries of level 1", "adaptive/queries of level 2",
    "adaptive/queries of level 3"};

constexpr int quadsPictureSize_px = 257;
constexpr int stageOfNew = 0;

std::string shader(const char* name) {
    return std::string("src/techniques/light_sampling/") + name;
}

int quadIndex(int level, const glm::ivec2& quad) {
    return ((1 << (2 * level)) - 1) / 3 + quad.y * (1 << level) + quad.x;
}

}  // namespace

PublishedSampling::PublishedSampling(Device& device)
    : test_(internalsOf(device).shaders,
            {shader("published_picture.vert.glsl"), shader("published_test.frag.glsl")}),
      illustrateQuads_(internalsOf(device).shaders, {shader("illustrate_quads.comp.glsl")}),
      sums_(device, {shader("published_picture.vert.glsl"), shader("published_sums.frag.glsl")}),
      evaluation_(device),
      tree_(sizeof(Subdivision), "published light subdivision") {}

void PublishedSampling::render(const Frame& frame, const Options& options) {
    dimensions_ = options.dimensions;
    side_ = side(dimensions_);
    // The paper keeps all of its maps.
    maxSamples_ = std::min(options.maxSamples, frame.maps.capacity());
    if (maxSamples_ < corners()) {
        throw Error(Error::Kind::badArgument,
                    "there is no room for the maps of the light's corners, which the published method keeps: "
                    "lower map_size, or set published=false");
    }
    if (gl::SampleQuery::isTaken()) {
        throw Error(Error::Kind::badArgument,
                    "the published method needs an occlusion query, and one is under way already: end it "
                    "first, or set published=false and counting=counters");
    }
    prepareTargets(frame.out, options.comparisonScale);
    subdivide(frame, options);
    weigh(frame, options);
    evaluate(frame, options);
}

void PublishedSampling::prepareTargets(const VisibilityBuffer& out, float scale) {
    const auto scaled = [&](int size_px) { return std::max(1, int(std::lround(double(scale) * size_px))); };
    gl::TextureSpec spec{.width_px = scaled(out.width_px()),
                         .height_px = scaled(out.height_px()),
                         .format = gl::Format::r32ui,
                         .label = "sums of shadow values"};
    sumsTarget_.fit(spec);
    spec.format = gl::Format::rgba8;
    spec.label = "published light sampling pictures";
    sumsPicture_.fit(spec);
    failingPicture_.fit(spec);
    failing_.fit({&failingPicture_}, nullptr, "failing fragments");
    sumsOfRoot_.fit({&sumsTarget_, &sumsPicture_}, nullptr, "sums of the root");
    sumsOfCell_.fit({&sumsTarget_}, nullptr, "sums of a quad");
    failingPicture_.clear();
}

void PublishedSampling::subdivide(const Frame& frame, const Options& options) {
    counts_ = {};
    leaves_.clear();
    vertexOfSlot_.clear();
    slotOfVertex_.assign(frame.samples.size(), -1);
    drawnSlots_ = 0;
    Subdivision picture{};
    std::fill(std::begin(picture.slotOfVertex), std::end(picture.slotOfVertex), -1);

    // Section 3.3.1: the corners, which are always there.
    const int all = side_ - 1;
    std::vector<Cell> cells = {{.side = all}}, finer;
    for (int i = 0; i < corners(); ++i) {
        const int vertex = vertexAt(all * cornerOf(i) * glm::ivec3(1, 1, dimensions_ == 3));
        slotOfVertex_[std::size_t(vertex)] = int(vertexOfSlot_.size());
        vertexOfSlot_.push_back(vertex);
    }
    counts_.samples[0] = corners();
    drawNewMaps(frame, 0);

    const int maxDepth = std::min(options.maxDepth, dimensions_ == 3 ? 3 : deepestLevel);
    for (int level = 0; level < maxDepth && !cells.empty(); ++level) {
        // Section 3.3.3. All queries of a level are under way before the first is waited for.
        while (queries_.size() < cells.size()) queries_.emplace_back();
        {
            const auto pass = frame.timers.pass(comparisonPasses[std::size_t(level)]);
            for (std::size_t i = 0; i < cells.size(); ++i) count(frame, options, cells[i], queries_[i]);
        }
        std::vector<std::pair<std::uint64_t, Cell>> failing;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::uint64_t fragments = queries_[i].passed();
            counts_.failing[std::size_t(level)] += double(fragments);
            if (level < options.minDepth || fragments > std::uint64_t(options.tolerated)) {
                failing.emplace_back(fragments, cells[i]);
            } else {
                leaves_.push_back(cells[i]);
            }
        }
        // Section 3.3.4. If samples run out, they went where most fragments fail.
        std::ranges::stable_sort(failing, std::greater{}, &std::pair<std::uint64_t, Cell>::first);
        finer.clear();
        for (const auto& [fragments, cell] : failing) {
            if (!split(cell, finer)) continue;
            counts_.split[std::size_t(level)] += 1;
            if (dimensions_ == 2) picture.split[quadIndex(level, glm::ivec2(cell.low) / cell.side)] = 1;
        }
        drawNewMaps(frame, level + 1);
        cells = finer;
    }
    leaves_.insert(leaves_.end(), cells.begin(), cells.end());
    counts_.slots = double(vertexOfSlot_.size());

    if (dimensions_ != 2) return;
    for (const int vertex : vertexOfSlot_) picture.slotOfVertex[vertex] = slotOfVertex_[std::size_t(vertex)];
    tree_.write(std::as_bytes(std::span(&picture, 1)));
}

void PublishedSampling::count(const Frame& frame, const Options& options, const Cell& cell,
                              gl::SampleQuery& query) {
    PublishedConstants constants{.slots = {},
                                 .target_px = {sumsTarget_.width_px(), sumsTarget_.height_px()},
                                 .corners = corners(),
                                 .brightness = 0.25f * float(cell.level + 1)};
    for (int i = 0; i < corners(); ++i) {
        constants.slots[i / 4][i % 4] =
            slotOfVertex_[std::size_t(vertexAt(cell.low + cell.side * cornerOf(i)))];
    }
    const gl::RasterState target{.width_px = sumsTarget_.width_px(), .height_px = sumsTarget_.height_px()};
    EvaluationOptions unfiltered = options.evaluation;
    unfiltered.filter = 1;
    frame.maps.choose(stageOfAll, 0);
    gl::Pass(sums_.prepare(frame.inputs.light, frame.cameras, unfiltered, {}))
        .constants(constants)
        .bind(frame.view)
        .bind(frame.maps)
        .bind(sums_)
        .into(cell.level == 0 ? sumsOfRoot_ : sumsOfCell_, target)
        .draw(gl::Primitive::triangles, 3);
    gl::RasterState brightest = target;
    brightest.blend = gl::Blend::largest;
    gl::Pass test(test_);
    test.constants(constants).bind("sums", sumsTarget_).into(failing_, brightest);
    query.begin();
    test.draw(gl::Primitive::triangles, 3);
    query.end();
}

/// False if the samples have run out.
bool PublishedSampling::split(const Cell& cell, std::vector<Cell>& finer) {
    const int half = cell.side / 2;
    std::vector<int> added;
    for (int i = 0; i < (dimensions_ == 3 ? 27 : 9); ++i) {
        const int vertex = vertexAt(cell.low + half * glm::ivec3(i % 3, i / 3 % 3, i / 9));
        if (slotOfVertex_[std::size_t(vertex)] < 0) added.push_back(vertex);
    }
    if (int(vertexOfSlot_.size() + added.size()) > maxSamples_) {
        counts_.reachedMaximum = true;
        leaves_.push_back(cell);
        return false;
    }
    for (const int vertex : added) {
        slotOfVertex_[std::size_t(vertex)] = int(vertexOfSlot_.size());
        vertexOfSlot_.push_back(vertex);
    }
    counts_.samples[std::size_t(cell.level + 1)] += double(added.size());
    for (int i = 0; i < corners(); ++i)
        finer.push_back({.low = cell.low + half * cornerOf(i), .level = cell.level + 1, .side = half});
    return true;
}

void PublishedSampling::drawNewMaps(const Frame& frame, int level) {
    frame.maps.plan(vertexOfSlot_, drawnSlots_);
    if (drawnSlots_ == int(vertexOfSlot_.size())) return;
    const auto pass = frame.timers.pass(mapPasses[std::size_t(level)]);
    frame.maps.draw(stageOfNew, 0, frame.cameras, {});
    drawnSlots_ = int(vertexOfSlot_.size());
}

void PublishedSampling::weigh(const Frame& frame, const Options& options) {
    // Equation 3, its depth being that of the finest quad at the sample; or the area nearest to it in its
    // leaves.
    std::vector<int> depth(frame.samples.size(), 0);
    std::vector<double> area(frame.samples.size(), 0);
    const int all = side_ - 1;
    const double margin = options.hasMargin ? 0.5 : 0, extent = all + 2 * margin;
    for (const Cell& leaf : leaves_) {
        for (int i = 0; i < corners(); ++i) {
            const glm::ivec3 corner = cornerOf(i);
            const auto vertex = std::size_t(vertexAt(leaf.low + leaf.side * corner));
            depth[vertex] = std::max(depth[vertex], leaf.level);
            double part = 1;
            for (int axis = 0; axis < dimensions_; ++axis) {
                const int place = leaf.low[axis] + leaf.side * corner[axis];
                part *= (0.5 * leaf.side + (place == 0 || place == all ? margin : 0)) / extent;
            }
            area[vertex] += part;
        }
    }
    cells_.assign(frame.samples.size(), glm::vec4(0));
    for (const int vertex : vertexOfSlot_) {
        const auto at = std::size_t(vertex);
        const double weight =
            options.usesPaperWeights ? std::pow((1 << depth[at]) + 1, -dimensions_) : area[at];
        setShare(frame.samples[at], float(weight));
        // Of a textured light's radiance: as much as lies nearest to the sample among those of its depth.
        const glm::vec2 place((glm::vec2(vertex % side_, vertex / side_ % side_) + float(margin)) /
                              float(extent));
        const float half = 0.5f * float(all >> depth[at]) / float(extent);
        cells_[at] = glm::clamp(glm::vec4(place - half, place + half), 0.0f, 1.0f);
    }
    frame.maps.setSamples(frame.samples);
    if (frame.inputs.light.radianceTexture != 0)
        frame.radiance.weigh(frame.inputs.light.radianceTexture, cells_, frame.maps.samples());
}

void PublishedSampling::evaluate(const Frame& frame, const Options& options) {
    const auto pass = frame.timers.pass("adaptive/evaluation");
    evaluation_.add(frame.inputs, frame.view, frame.cameras, options.evaluation, frame.maps,
                    {.mostSlots = int(vertexOfSlot_.size())}, frame.out);
}

const gl::Texture& PublishedSampling::quadsPicture() const {
    quadsPicture_.fit({.width_px = quadsPictureSize_px,
                       .height_px = quadsPictureSize_px,
                       .format = gl::Format::rgba8,
                       .label = "published quads"});
    gl::Pass(illustrateQuads_)
        .bind("SubdivisionBlock", tree_)
        .bind("picture", quadsPicture_)
        .dispatchPixels(quadsPictureSize_px, quadsPictureSize_px);
    return quadsPicture_;
}

}  // namespace penumbra::light_sampling
