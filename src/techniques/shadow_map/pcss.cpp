// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/pcss.h"

#include <array>
#include <cmath>

#include "src/techniques/common/light_constants.h"
#include "src/techniques/shadow_map/patterns.h"
#include "src/techniques/shadow_map/window_margin.h"

namespace penumbra::shadow_map {
namespace {

constexpr std::array<std::string_view, 2> patternNames = {"fixed", "rotated"};
constexpr std::array<std::string_view, 2> blockerMeanNames = {"arithmetic", "harmonic"};

AreaLight scaled(AreaLight light, float scale) {
    light.width_m *= scale;
    light.height_m *= scale;
    light.radius_m *= scale;
    light.angle_rad = std::min(light.angle_rad * scale, 3.1415927f);
    return light;
}

}  // namespace

Pcss::Pcss(Device& device)
    : depthMap_(device),
      nearestTiles_(device),
      resolve_(internalsOf(device).shaders, {"src/techniques/shadow_map/pcss.comp.glsl"}),
      searchPattern_("pcss/search pattern"),
      filterPattern_("pcss/filter pattern") {}

void Pcss::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 16384});
    visitor.integer({.name = "search_samples", .help = "looks into the map to find blockers"}, searchSamples_,
                    {1, 1024});
    visitor.integer({.name = "filter_samples", .help = "looks into the map to average over the penumbra"},
                    filterSamples_, {1, 1024});
    visitor.choice(
        {.name = "pattern", .help = "fixed: no noise; rotated: another one at each pixel, for few samples"},
        pattern_, patternNames);
    visitor.choice({.name = "blocker_mean",
                    .help = "of the blockers' distances; arithmetic is the sketch's, harmonic leaks less"},
                   blockerMean_, blockerMeanNames);
    visitor.real(
        {.name = "light_scale",
         .help = "times the light's size, the sketch's w_Light; 1 is what the light's size and distance say"},
        lightScale_, {0, 100});
}

PcssConstants Pcss::constantsOf(const AreaLight& light) const {
    const glm::dvec2 extent = lightExtent(light);
    const double cosine = 1 / std::sqrt(1 + extent.x * extent.x);
    // A light without a size looks the same from every sample.
    const bool soft = hasSize(light);
    return {
        .light = lightConstants(light),
        .oneMinusCosine = float(1 - cosine),
        .searchSamples = soft ? searchSamples_ : 1,
        .filterSamples = soft ? filterSamples_ : 1,
        .isRotated = Pattern(pattern_) == Pattern::rotated,
        .meanIsHarmonic = BlockerMean(blockerMean_) == BlockerMean::harmonic,
        .mapCount = depthMap_.count(),
        .tile_px = nearestTiles_.tile_px(),
    };
}

void Pcss::updatePatterns(const AreaLight& light) {
    if (searchPatternSize_ != searchSamples_) {
        searchPattern_.write(searchPattern(searchSamples_));
        searchPatternSize_ = searchSamples_;
    }
    const bool isSquare = light.shape == LightShape::rect;
    if (filterPatternSize_ != filterSamples_ || filterPatternIsSquare_ != isSquare) {
        filterPattern_.write(isSquare ? squarePattern(filterSamples_) : diskPattern(filterSamples_));
        filterPatternSize_ = filterSamples_;
        filterPatternIsSquare_ = isSquare;
    }
}

void Pcss::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const AreaLight light = scaled(inputs.light, lightScale_);
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    LightCameras cameras = fitLightCameras(light, scene, {.mapSize_px = mapSize_px_, .splits = true});
    widenForLight(cameras, light, scene);
    updatePatterns(light);
    {
        const auto pass = timers_.pass("pcss/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_);
    }
    {
        const auto pass = timers_.pass("pcss/nearest blockers");
        nearestTiles_.build(depthMap_, light);
    }
    {
        const auto pass = timers_.pass("pcss/resolve");
        view_.fill(inputs.view, lightFromWorldMatrix);
        gl::Pass(resolve_)
            .constants(constantsOf(light))
            .bind(view_)
            .bind(depthMap_)
            .bind("SearchPattern", searchPattern_)
            .bind("FilterPattern", filterPattern_)
            .bind("NearestTiles", nearestTiles_.tiles())
            .bind("radiance", gl::TextureRef{.name = light.radianceTexture})
            .bind("visibility", imageOf(out))
            .dispatchPixels(out.width_px(), out.height_px());
    }
}

void Pcss::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
}

Statistics Pcss::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    statistics.counts.push_back({"search samples", double(searchSamples_), "a pixel"});
    statistics.counts.push_back({"filter samples", double(filterSamples_), "a pixel"});
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra::shadow_map
