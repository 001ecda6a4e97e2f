// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/published_widths.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "src/techniques/shadow_width_map/widths_cpu.h"

namespace penumbra::shadow_width_map {
namespace {

constexpr std::array<std::string_view, 2> curveNames = {"linear", "smooth"};
constexpr std::array<std::string_view, 2> placeNames = {"receiver", "plane"};
constexpr std::array<std::string_view, 2> neighbourNames = {"3", "6"};
constexpr std::array<std::string_view, 4> startNames = {"1/4", "1/16", "1/64", "1/256"};
/// From the least starting difference, 1/256, to 1.
constexpr int mostSteps = 9;

constexpr int neighbourCount(int choice) {
    return choice == 0 ? 3 : 6;
}
constexpr float startDifference(int choice) {
    return 1.0f / float(4 << (2 * choice));
}

}  // namespace

PublishedWidths::PublishedWidths(Device& device)
    : table_(tabulateAttenuation(linearAttenuation)),
      composite_(internalsOf(device).shaders, {"src/techniques/shadow_width_map/composite.comp.glsl"}),
      resolve_(internalsOf(device).shaders, {"src/techniques/shadow_width_map/resolve_published.comp.glsl"}) {
}

void PublishedWidths::describe(ParameterVisitor& visitor) {
    visitor.boolean(
        {.name = "physical",
         .help = "published modes: choose c_scale so that the umbra is as large as the light makes it"},
        physical_);
    visitor.real(
        {.name = "c_scale", .help = "published modes, unless physical: c_scale of equation I(sd, sw)"},
        cScale_, {0, std::numeric_limits<float>::max()});
    visitor.real({.name = "c_bias", .help = "published modes: c_bias of equation I(sd, sw)"}, cBias_, {0, 1});
    const int curve = curve_;
    visitor.choice({.name = "curve", .help = "published modes: how I falls from 1 to 0"}, curve_, curveNames);
    if (curve != curve_) setAttenuation(curve_ == 0 ? linearAttenuation : smoothAttenuation);
    visitor.choice(
        {.name = "widths_at",
         .help = "published modes: where a distance in the map is measured, at the receiver, or as "
                 "published on a plane behind all blockers"},
        widthsAt_, placeNames);
    visitor.boolean(
        {.name = "back_faces",
         .help = "published modes, where no caster receives too: the farthest surfaces of casters are "
                 "in the depth map, not the nearest (section 5)"},
        backFaces_);
    visitor.choice({.name = "neighbours", .help = "compositing: how many neighbours each step looks at"},
                   neighbours_, neighbourNames);
    visitor.choice({.name = "start_difference",
                    .help = "compositing: the first difference; its inverse is the widest width in texels"},
                   startDifference_, startNames);
    visitor.integer(
        {.name = "steps",
         .help = "compositing: how many steps are shown of those that are needed (figure 4); 0: all"},
        steps_, {0, mostSteps});
}

void PublishedWidths::setAttenuation(const AttenuationFunction& attenuation) {
    table_ = tabulateAttenuation(attenuation);
    isTableUploaded_ = false;
}

void PublishedWidths::appendKey(std::pmr::vector<double>& key) const {
    key.insert(key.end(),
               {double(backFaces_), double(neighbours_), double(startDifference_), double(steps_)});
}

DepthMap::Surface PublishedWidths::surfaceFor(const ShadowInputs& inputs) const {
    const bool isAnyBoth = std::ranges::any_of(
        inputs.casters, [](const Caster& caster) { return caster.casts && caster.receives; });
    return backFaces_ && !isAnyBoth ? DepthMap::Surface::farthest : DepthMap::Surface::nearest;
}

void PublishedWidths::make(Construction construction, const DepthMap& depthMap, DepthMap::Surface surface,
                           double plane_m, gl::PassTimers& timers) {
    background_ = surface == DepthMap::Surface::nearest ? 0 : 1;
    plane_m_ = plane_m;
    mapCount_ = depthMap.count();
    if (mapCount_ == 0) return;
    const int size_px = depthMap.texture().width_px();
    const gl::TextureSpec spec{.width_px = size_px,
                               .height_px = size_px,
                               .layers = mapCount_,
                               .format = gl::Format::r32f,
                               .label = "shadow widths"};
    widths_.fit(spec);
    if (construction == Construction::compositing) {
        const auto pass = timers.pass("shadow-width/compositing");
        scratch_.fit(spec);
        composite(depthMap);
    } else {
        const auto pass = timers.pass("shadow-width/sweeps on the CPU");
        sweepOnCpu(depthMap);
    }
}

void PublishedWidths::composite(const DepthMap& depthMap) {
    const auto groups = std::size_t((widths_.width_px() + 7) / 8), maps = std::size_t(mapCount_);
    const auto step = [&](int neighbours, float distance_px, float difference) {
        gl::Pass(composite_)
            .constants(CompositeConstants{.neighbours = neighbours,
                                          .distance_px = distance_px,
                                          .difference = difference,
                                          .background = background_})
            .bind("depthMaps", depthMap.texture())
            .bind("before", scratch_)
            .bind("after", widths_)
            .dispatch(groups, groups, maps);
    };
    step(0, 0, 0);
    float distance_px = 1, difference = startDifference(startDifference_);
    for (int i = 0; difference <= 1 && (steps_ == 0 || i < steps_); ++i) {
        std::swap(widths_, scratch_);
        step(neighbourCount(neighbours_), distance_px, difference);
        distance_px *= 2;
        difference *= 2;
    }
}

void PublishedWidths::sweepOnCpu(const DepthMap& depthMap) {
    const int size_px = widths_.width_px();
    const auto texels = std::size_t(size_px) * std::size_t(size_px);
    std::vector<float> depths(texels);
    const auto blocked = std::make_unique<bool[]>(texels);
    for (int layer = 0; layer < mapCount_; ++layer) {
        depthMap.texture().read(std::as_writable_bytes(std::span(depths)), layer);
        std::ranges::transform(depths, blocked.get(), [&](float depth) { return depth != background_; });
        const std::vector<float> widths =
            sweepShadowWidths({blocked.get(), texels}, size_px, startDifference(startDifference_));
        widths_.write(std::as_bytes(std::span(widths)), layer);
    }
}

void PublishedWidths::resolve(const ReceiverBinding& receivers, float meanHalfExtent,
                              gl::PassTimers& timers) {
    const auto pass = timers.pass("shadow-width/resolve");
    if (!isTableUploaded_) {
        curveTable_.fit({.width_px = int(table_.size()),
                         .format = gl::Format::r32f,
                         .filter = gl::Filter::linear,
                         .label = "attenuation"});
        curveTable_.write(std::as_bytes(std::span(table_)));
        isTableUploaded_ = true;
    }
    gl::Pass(resolve_)
        .constants(AttenuationConstants{.isPhysical = physical_,
                                        .cScale = cScale_,
                                        .cBias = cBias_,
                                        .unit_px = 1 / startDifference(startDifference_),
                                        .curveEnd = attenuationTableEnd,
                                        .umbraBegins = umbraBegins(table_),
                                        .meanHalfExtent = meanHalfExtent,
                                        .background = background_,
                                        .plane_m = widthsAt_ == 0 ? 0 : float(plane_m_)})
        .bind(receivers)
        .bind("widths", widths_)
        .bind("curve", curveTable_)
        .dispatchPixels(receivers.out.width_px(), receivers.out.height_px());
}

void PublishedWidths::inspect(InspectionVisitor& visitor) const {
    if (widths_.name() == 0) return;
    visitor.texture({.name = "shadow-width map", .texture = widths_.name(), .layers = mapCount_});
}

}  // namespace penumbra::shadow_width_map
