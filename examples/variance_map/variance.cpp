// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/variance_map/variance.h"

#include "src/device/device_internals.h"
#include "src/techniques/common/light_constants.h"
#include "src/techniques/variance_map/variance_io.h"

namespace penumbra::variance_map {

Variance::Variance(Device& device)
    : depthMap_(device),
      filter_(internalsOf(device).shaders, {"src/techniques/variance_map/moments.comp.glsl"}),
      resolve_(internalsOf(device).shaders, {"src/techniques/variance_map/variance.comp.glsl"}) {}

void Variance::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 8192});
    visitor.integer({.name = "radius", .unit = "texels", .help = "of the square filter: the paper's own"},
                    radius_px_, {0, 64});
}

void Variance::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras =
        fitLightCameras(inputs.light, scene, {.mapSize_px = mapSize_px_, .splits = true});
    {
        const auto pass = timers_.pass("variance/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_);
    }
    if (depthMap_.count() > 0) filter();
    const auto pass = timers_.pass("variance/resolve");
    view_.fill(inputs.view, lightFromWorldMatrix);
    gl::Pass(resolve_)
        .constants(VarianceConstants{.light = lightConstants(inputs.light), .mapCount = depthMap_.count()})
        .bind(view_)
        .bind(depthMap_)
        .bind("moments", moments_)
        .bind("visibility", imageOf(out))
        .dispatchPixels(out.width_px(), out.height_px());
}

void Variance::filter() {
    const auto pass = timers_.pass("variance/filter");
    const gl::TextureSpec spec{.width_px = mapSize_px_,
                               .height_px = mapSize_px_,
                               .layers = depthMap_.count(),
                               .format = gl::Format::rg32f,
                               .filter = gl::Filter::linear,
                               .label = "variance/moments"};
    across_.fit(spec);
    moments_.fit(spec);
    const auto groups = std::size_t(mapSize_px_ + 7) / 8;
    gl::Pass(filter_)
        .constants(MomentsConstants{.radius_px = radius_px_, .isAcross = true})
        .bind("source", depthMap_.texture())
        .bind("moments", across_)
        .dispatch(groups, groups, std::size_t(depthMap_.count()));
    gl::Pass(filter_)
        .constants(MomentsConstants{.radius_px = radius_px_, .isAcross = false})
        .bind("source", across_)
        .bind("moments", moments_)
        .dispatch(groups, groups, std::size_t(depthMap_.count()));
}

void Variance::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "moments", .texture = moments_.name(), .layers = depthMap_.count()});
}

Statistics Variance::statistics() const {
    return {.counts = {{"maps", double(depthMap_.count())}}, .passes = passTimes(timers_)};
}

}  // namespace penumbra::variance_map
