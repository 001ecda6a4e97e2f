// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/shadow_width_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/techniques/shadow_width_map/map_cameras.h"

namespace penumbra::shadow_width_map {
namespace {

constexpr std::array<std::string_view, 3> modeNames = {"exact", "compositing", "cpu-sweep"};

/// Half the light's largest extent; of a distant light, as a tangent.
float largestHalfExtent(const AreaLight& light) {
    if (light.shape == LightShape::rect) return 0.5f * std::hypot(light.width_m, light.height_m);
    // Near 180 degrees a tangent says nothing any more.
    return light.shape == LightShape::distant ? std::tan(0.5f * std::min(light.angle_rad, 3.0f))
                                              : light.radius_m;
}

/// The mean of a rect's half axes; of other lights their one half extent.
float meanHalfExtent(const AreaLight& light) {
    return light.shape == LightShape::rect ? 0.25f * (light.width_m + light.height_m)
                                           : largestHalfExtent(light);
}

}  // namespace

ShadowWidthMap::ShadowWidthMap(Device& device)
    : depthMap_(device), exact_(device), published_(device), constants_("shadow-width constants") {}

void ShadowWidthMap::describe(ParameterVisitor& visitor) {
    visitor.choice(
        {.name = "mode",
         .help = "how widths are found: exactly, or as published by compositing or by sweeps on the CPU"},
        mode_, modeNames);
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each map"},
                    mapSize_px_, {16, 4096});
    exact_.describe(visitor);
    visitor.boolean({.name = "reuse_maps", .help = "keep the maps while nothing that they show has changed"},
                    reuseMaps_);
    published_.describe(visitor);
}

void ShadowWidthMap::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras = fitMapCameras(inputs.light, scene, mapSize_px_, mode_ == exact);

    std::pmr::vector<double> key{
        {double(mode_), double(mapSize_px_), double(largestHalfExtent(inputs.light))},
        gl::ObjectRegistryScope::frameMemory()};
    exact_.appendKey(key);
    published_.appendKey(key);
    appendMapKey(key, inputs, scene, cameras);
    // Without a revision nobody can tell whether a mask's texels have changed.
    const bool mayChangeUnseen = std::ranges::any_of(inputs.casters, [](const Caster& caster) {
        return caster.alphaMask.texture != 0 && caster.alphaMask.revision == 0;
    });
    if (!reuseMaps_ || mayChangeUnseen || !std::ranges::equal(key, mapsMadeFrom_)) {
        mapsMadeFrom_.clear();
        makeMaps(inputs, scene, cameras);
        mapsMadeFrom_.assign(key.begin(), key.end());
        ++timesMade_;
    }
    resolve(inputs, lightFromWorldMatrix, out);
}

void ShadowWidthMap::makeMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                              std::span<const LightCamera> cameras) {
    const DepthMap::Surface surface =
        mode_ == exact ? DepthMap::Surface::nearest : published_.surfaceFor(inputs);
    {
        const auto pass = timers_.pass("shadow-width/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_, surface);
    }
    if (!cameras.empty()) {
        faceFromLight_ = cameras.front().faceFromLight;
        firstCamera_ = cameras.front().constants(mapSize_px_);
        firstCamera_.faceFromLight = glm::mat4(1);
    }
    if (mode_ == exact) {
        exact_.make(inputs, scene, cameras, depthMap_, largestHalfExtent(inputs.light), timers_);
    } else {
        published_.make(mode_ == compositing ? PublishedWidths::Construction::compositing
                                             : PublishedWidths::Construction::cpuSweep,
                        depthMap_, surface, planeBehindCasters_m(inputs, scene, cameras), timers_);
    }
}

ShadowWidthConstants ShadowWidthMap::constants(const AreaLight& light,
                                               const glm::dmat3& spaceFromLight) const {
    const bool isDisk = light.shape == LightShape::disk, isRect = light.shape == LightShape::rect;
    const double halfX = isRect ? 0.5f * light.width_m : isDisk ? light.radius_m : 0;
    const double halfY = isRect ? 0.5f * light.height_m : isDisk ? light.radius_m : 0;
    return {
        .light = lightConstants(light),
        .halfAxisX = spaceFromLight * glm::dvec3(halfX, 0, 0),
        .radius = isRect || isDisk ? 0 : largestHalfExtent(light),
        .halfAxisY = spaceFromLight * glm::dvec3(0, halfY, 0),
        .mapCount = depthMap_.count(),
        .emission = spaceFromLight * glm::dvec3(0, 0, -1),
        .kinds = exact_.kinds(),
        .firstCamera = firstCamera_,
        .cell_px = ExactWidths::cell_px(mapSize_px_),
        .cellsAcross = ExactWidths::cellsAcross(mapSize_px_),
    };
}

void ShadowWidthMap::resolve(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld,
                             VisibilityBuffer& out) {
    // With one map, shaders work in that map's space, which spares them a transform.
    const glm::dmat4 faceFromLight = depthMap_.count() == 1 ? faceFromLight_ : glm::dmat4(1);
    view_.fill(inputs.view, faceFromLight * lightFromWorld);
    constants_.write(constants(inputs.light, glm::dmat3(faceFromLight)));
    const ReceiverBinding receivers{.view = view_,
                                    .depthMap = depthMap_,
                                    .constants = constants_,
                                    .out = out,
                                    .hasNormals = inputs.view.normalTexture != 0};
    if (mode_ == exact) {
        exact_.resolve(receivers, timers_);
    } else {
        published_.resolve(receivers, meanHalfExtent(inputs.light), timers_);
    }
}

void ShadowWidthMap::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
    if (mode_ == exact) {
        exact_.inspect(visitor);
    } else {
        published_.inspect(visitor);
    }
}

Statistics ShadowWidthMap::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    statistics.counts.push_back({"times the maps were made", double(timesMade_)});
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra::shadow_width_map
