// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/hard.h"

#include "src/techniques/shadow_map/shadow_map_io.h"

namespace penumbra::shadow_map {

HardShadowMap::HardShadowMap(Device& device)
    : depthMap_(device),
      resolve_(internalsOf(device).shaders, {"src/techniques/shadow_map/hard.comp.glsl"}) {}

void HardShadowMap::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 16384});
}

void HardShadowMap::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras =
        fitLightCameras(inputs.light, scene, {.mapSize_px = mapSize_px_, .splits = true});
    {
        const auto pass = timers_.pass("hard/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_);
    }
    {
        const auto pass = timers_.pass("hard/resolve");
        view_.fill(inputs.view, lightFromWorldMatrix);
        gl::Pass(resolve_)
            .constants(HardConstants{.light = lightConstants(inputs.light), .mapCount = depthMap_.count()})
            .bind(view_)
            .bind(depthMap_)
            .bind("visibility", imageOf(out))
            .dispatchPixels(out.width_px(), out.height_px());
    }
}

void HardShadowMap::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
}

Statistics HardShadowMap::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra::shadow_map
