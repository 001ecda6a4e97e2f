// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/point_lighting.h"

#include "src/gl/pass.h"
#include "studio/frame/conversions.h"
#include "studio/frame/lighting_constants.h"
#include "studio/frame/point_lighting_io.h"
#include "studio/frame/shaders.h"

namespace penumbra::studio {
namespace {

gl::ShaderLibrary makeShaderLibrary(std::filesystem::path sourceDirectory) {
    gl::ShaderLibrary shaders(std::move(sourceDirectory));
    shaders.add(frameShaders());
    return shaders;
}

/// Finds the texture in which a technique says how far its last answer may be off.
class ErrorBound : public InspectionVisitor {
  public:
    explicit ErrorBound(const Technique& technique) { technique.inspect(*this); }
    void texture(const InspectedTexture& inspected) override {
        if (inspected.name == "error bound") name_ = inspected.texture;
    }
    std::uint32_t name() const {
        if (name_ != 0) return name_;
        throw Error(Error::Kind::badArgument,
                    "this technique does not say how far it may be off: take exact or reference");
    }

  private:
    std::uint32_t name_ = 0;
};

}  // namespace

PointLighting::PointLighting(Device& device, std::filesystem::path shaderSourceDirectory)
    : device_(device), shaders_(makeShaderLibrary(std::move(shaderSourceDirectory))) {}

const gl::Program& PointLighting::programFor(const Kind& kind) {
    const auto found = lighting_.find(kind);
    if (found != lighting_.end()) return found->second;
    std::vector<std::string> defines{"ONLY_SHAPE " + std::to_string(int(kind.shape)),
                                     "ONLY_PROFILED " + std::to_string(int(kind.isProfiled))};
    if (kind.isTextured) defines.emplace_back("WITH_TEXTURE");
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
    if (light.castsShadow) {
        technique.render({.view = points.view(), .light = shape, .casters = scene.casters()}, visibility);
        errorBound = ErrorBound(technique).name();
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
    gl::Pass pass(programFor({shape.shape, light.profile.has_value(), shape.radianceTexture != 0}));
    pass.constants(constants)
        .bind("Profile", scene.profile(light))
        .bind("places", gl::TextureRef{.name = points.view().depthTexture})
        .bind("normals", gl::TextureRef{.name = points.view().normalTexture})
        .bind("visibilityTexture", gl::TextureRef{.name = visibility.texture()})
        .bind("errorBound", gl::TextureRef{.name = errorBound})
        .bind("measured", measured_);
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
