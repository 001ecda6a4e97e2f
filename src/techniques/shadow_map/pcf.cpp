// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/pcf.h"

#include <array>

#include "src/techniques/shadow_map/patterns.h"
#include "src/techniques/shadow_map/shadow_map_io.h"
#include "src/techniques/shadow_map/window_margin.h"

namespace penumbra::shadow_map {
namespace {

constexpr int poissonCount = 16;
constexpr std::array<std::string_view, 5> kernelNames = {"2x2", "3x3", "5x5", "bicubic", "poisson"};

}  // namespace

Pcf::Pcf(Device& device)
    : depthMap_(device),
      resolve_(internalsOf(device).shaders, {"src/techniques/shadow_map/pcf.comp.glsl"}),
      poissonDisk_("pcf/poisson disk") {
    poissonDisk_.write(poissonDisk(poissonCount));
}

void Pcf::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 16384});
    visitor.choice(
        {.name = "kernel",
         .help = "2x2: bilinear; 3x3, 5x5: tents of that width; bicubic: a B-spline over 4x4; poisson: a "
                 "disk of 16 bilinear taps"},
        kernel_, kernelNames);
    visitor.real(
        {.name = "radius", .unit = "texels", .help = "of the Poisson disk; the other kernels have their own"},
        radius_px_, {0, 64});
}

double Pcf::reach_px() const {
    switch (Kernel(kernel_)) {
        case Kernel::bilinear:
            return 1;
        case Kernel::tent3:
        case Kernel::bicubic:
            return 2;
        case Kernel::tent5:
            return 3;
        case Kernel::poisson:
            break;
    }
    return radius_px_ + 1.0;
}

void Pcf::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    LightCameras cameras = fitLightCameras(inputs.light, scene, {.mapSize_px = mapSize_px_, .splits = true});
    widenByTexels(cameras, reach_px(), mapSize_px_);
    {
        const auto pass = timers_.pass("pcf/depth map");
        depthMap_.render(inputs.casters, scene, cameras, mapSize_px_);
    }
    {
        const auto pass = timers_.pass("pcf/resolve");
        view_.fill(inputs.view, lightFromWorldMatrix);
        gl::Pass(resolve_)
            .constants(PcfConstants{.light = lightConstants(inputs.light),
                                    .mapCount = depthMap_.count(),
                                    .kernel = kernel_,
                                    .radius_px = radius_px_,
                                    .poissonCount = poissonCount})
            .bind(view_)
            .bind(depthMap_)
            .bind("PoissonDisk", poissonDisk_)
            .bind("visibility", imageOf(out))
            .dispatchPixels(out.width_px(), out.height_px());
    }
}

void Pcf::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
}

Statistics Pcf::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra::shadow_map
