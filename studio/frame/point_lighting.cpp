// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/point_lighting.h"

#include <cmath>
#include <span>

#include "src/gl/pass.h"
#include "studio/frame/conversions.h"
#include "studio/frame/lighting_constants.h"
#include "studio/frame/point_lighting_io.h"
#include "studio/frame/shaders.h"
#include "studio/scene/profiles/light_profile.h"

namespace penumbra::studio {
namespace {

gl::ShaderLibrary makeShaderLibrary(std::filesystem::path sourceDirectory) {
    gl::ShaderLibrary shaders(std::move(sourceDirectory));
    shaders.add(frameShaders());
    return shaders;
}

/// But for rounding, which is far less than half a step.
bool areEven(std::span<const double> angles_deg) {
    if (angles_deg.size() < 3) return true;
    const double step_deg = (angles_deg.back() - angles_deg.front()) / double(angles_deg.size() - 1);
    for (std::size_t i = 1; i < angles_deg.size(); ++i) {
        if (std::abs(angles_deg[i] - angles_deg[i - 1] - step_deg) > 1e-3 * step_deg) return false;
    }
    return true;
}

bool hasEvenAngles(const Light& light) {
    if (!light.profile) return false;
    const CandelaGrid& grid = light.profile->profile->grid;
    return areEven(grid.verticals_deg) && areEven(grid.horizontals_deg);
}

/// Finds the textures in which a technique says how far its last answer may be off, and what is seen of each
/// of the light's cells.
class Inspected : public InspectionVisitor {
  public:
    explicit Inspected(const Technique& technique) { technique.inspect(*this); }
    void texture(const InspectedTexture& inspected) override {
        if (inspected.name == "error bound") errorBound_ = inspected.texture;
        if (inspected.name == "cells") cells_ = inspected;
    }
    const InspectedTexture& cells() const { return cells_; }
    std::uint32_t errorBound() const {
        if (errorBound_ != 0) return errorBound_;
        throw Error(Error::Kind::badArgument,
                    "this technique does not say how far it may be off: take exact or reference");
    }

  private:
    std::uint32_t errorBound_ = 0;
    InspectedTexture cells_;
};

}  // namespace

PointLighting::PointLighting(Device& device, std::filesystem::path shaderSourceDirectory)
    : device_(device), shaders_(makeShaderLibrary(std::move(shaderSourceDirectory))) {}

const gl::Program& PointLighting::programFor(const Kind& kind) {
    const auto found = lighting_.find(kind);
    if (found != lighting_.end()) return found->second;
    std::vector<std::string> defines{"ONLY_SHAPE " + std::to_string(int(kind.shape)),
                                     "ONLY_PROFILE " + std::to_string(kind.profileType),
                                     "ONLY_EVEN_ANGLES " + std::to_string(int(kind.hasEvenAngles))};
    if (kind.isTextured) defines.emplace_back("WITH_TEXTURE");
    if (kind.cells > 1) defines.emplace_back("CELLS " + std::to_string(kind.cells));
    return lighting_
        .emplace(kind, gl::Program(shaders_, {"studio/frame/point_lighting.comp.glsl"}, std::move(defines)))
        .first->second;
}

std::vector<PointLight> PointLighting::measure(const Points& points, const GpuScene& scene,
                                               const Light& light, Technique& technique) {
    AreaLight shape = light.shape;
    shape.radianceTexture = scene.radianceTexture(light.texture);
    VisibilityBuffer visibility(device_, points.width_px(), points.height_px(),
                                needsColor(shape, scene.casters()));
    std::uint32_t errorBound = 0;
    InspectedTexture cells;
    if (light.castsShadow) {
        technique.render({.view = points.view(), .light = shape, .casters = scene.casters()}, visibility);
        const Inspected inspected(technique);
        errorBound = inspected.errorBound();
        if (light.profile) cells = inspected.cells();
    }

    PointLightingConstants constants{
        .light = lightingConstants(light, glm::dmat4(fromPenumbra(shape.worldFromLight))),
        .isShadowed = light.castsShadow,
    };
    constants.light.isVisibilityColored = visibility.colored();
    constants.light.size_px = {points.width_px(), points.height_px()};
    measured_.fit({.width_px = points.width_px(),
                   .height_px = points.height_px(),
                   .format = gl::Format::rgba32f,
                   .label = "light at points"});
    const int cellsAlong = int(std::lround(std::sqrt(float(cells.layers))));
    gl::Pass pass(programFor({.shape = shape.shape,
                              .profileType = constants.light.profile.type,
                              .hasEvenAngles = hasEvenAngles(light),
                              .isTextured = shape.radianceTexture != 0,
                              .cells = cellsAlong}));
    pass.constants(constants)
        .bind("Profile", scene.profile(light))
        .bind("places", gl::TextureRef{.name = points.view().depthTexture})
        .bind("normals", gl::TextureRef{.name = points.view().normalTexture})
        .bind("visibilityTexture", gl::TextureRef{.name = visibility.texture()})
        .bind("errorBound", gl::TextureRef{.name = errorBound})
        .bind("measured", measured_);
    if (cellsAlong > 1) pass.bind("cells", gl::TextureRef{.name = cells.texture});
    if (shape.radianceTexture != 0)
        pass.bind("radianceTexture", gl::TextureRef{.name = shape.radianceTexture});
    pass.dispatchPixels(points.width_px(), points.height_px());

    constexpr int channels = 4;
    const std::vector<float> values = points.read(measured_.name(), channels);
    std::vector<PointLight> result;
    result.reserve(points.count());
    for (std::size_t i = 0; i < values.size(); i += channels)
        result.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
    return result;
}

}  // namespace penumbra::studio
