// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "src/gl/pass.h"
#include "studio/frame/conversions.h"
#include "studio/frame/lighting_constants.h"
#include "studio/frame/shaders.h"

namespace penumbra::studio {
namespace {

/// Saturation-based exposure values (ISO 12232), of a lens that lets 65 % through.
constexpr float whiteAtZero_nits = 1.2f;

gl::ShaderLibrary makeShaderLibrary(std::filesystem::path sourceDirectory) {
    gl::ShaderLibrary shaders(std::move(sourceDirectory));
    shaders.add(frameShaders());
    return shaders;
}

/// A distant light's place does not matter; near the camera its coordinates stay small.
glm::dmat4 worldFromLight(const AreaLight& light, const CameraView& camera) {
    glm::dmat4 matrix = fromPenumbra(light.worldFromLight);
    if (light.shape == LightShape::distant) matrix[3] = glm::inverse(camera.viewFromWorld)[3];
    return matrix;
}

}  // namespace

FrameRenderer::FrameRenderer(Device& device, std::filesystem::path shaderSourceDirectory)
    : device_(device),
      shaders_(makeShaderLibrary(std::move(shaderSourceDirectory))),
      gbuffer_(shaders_),
      lighting_(shaders_, {"studio/frame/lighting.comp.glsl"}),
      luminaire_(shaders_, {"studio/frame/luminaire.comp.glsl"}),
      exposureRows_(shaders_, {"studio/frame/exposure_rows.comp.glsl"}),
      exposure_(shaders_, {"studio/frame/exposure.comp.glsl"}),
      toneMap_(shaders_, {"studio/frame/tone_map.comp.glsl"}),
      exposureResult_(sizeof(float), "exposure") {}

void FrameRenderer::resize(int width_px, int height_px) {
    if (display_.width_px() == width_px && display_.height_px() == height_px && display_.name() != 0) return;
    const auto make = [&](gl::Format format, std::string_view label) {
        return gl::Texture({.width_px = width_px, .height_px = height_px, .format = format, .label = label});
    };
    radiance_ = make(gl::Format::rgba32f, "radiance");
    unshadowed_ = make(gl::Format::rgba32f, "unshadowed radiance");
    illuminance_ = make(gl::Format::r32f, "illuminance");
    reach_ = make(gl::Format::r32f, "unshadowed irradiance of one light");
    nearness_ = make(gl::Format::r32f, "1 / distance of the lights that are seen");
    display_ = make(gl::Format::rgba8, "display");
    rowSums_ = gl::Buffer(std::size_t(height_px) * sizeof(glm::vec2), "exposure, row by row");
}

void FrameRenderer::draw(const GpuScene& scene, const SceneMoment& moment, const Camera& camera, int width_px,
                         int height_px) {
    resize(width_px, height_px);
    scene_ = &scene;
    camera_ = makeCameraView(camera, moment.bounds, width_px, height_px);
    gbuffer_.render(scene, camera_, width_px, height_px);
    beginLighting();
}

void FrameRenderer::beginLighting() {
    // What glows is seen before any light is there.
    gbuffer_.emission().copyTo(radiance_);
    gbuffer_.emission().copyTo(unshadowed_);
    illuminance_.clear();
    nearness_.clear();
}

ShadowInputs FrameRenderer::shadowInputs(const Light& light) const {
    ShadowInputs inputs{.view = gbuffer_.view(), .light = light.shape};
    if (light.castsShadow) inputs.casters = scene_->casters();
    inputs.light.radianceTexture = scene_->radianceTexture(light.texture);
    return inputs;
}

bool FrameRenderer::needsColor(const Light& light) const {
    const ShadowInputs inputs = shadowInputs(light);
    return penumbra::needsColor(inputs.light, inputs.casters);
}

VisibilityBuffer FrameRenderer::makeVisibility(const Light& light) const {
    return VisibilityBuffer(device_, display_.width_px(), display_.height_px(), needsColor(light));
}

std::vector<VisibilityBuffer> FrameRenderer::makeVisibilities(std::span<const Light> lights) const {
    std::vector<VisibilityBuffer> made;
    for (const Light& light : lights) made.push_back(makeVisibility(light));
    return made;
}

FrameLight FrameRenderer::frameLight(const Light& light, VisibilityBuffer& out) const {
    FrameLight one{.light = light.shape, .out = &out, .castsShadow = light.castsShadow};
    one.light.radianceTexture = scene_->radianceTexture(light.texture);
    return one;
}

std::vector<FrameLight> FrameRenderer::frameLights(std::span<const Light> lights,
                                                   std::span<VisibilityBuffer> out) const {
    std::vector<FrameLight> all;
    for (std::size_t i = 0; i < lights.size(); ++i) all.push_back(frameLight(lights[i], out[i]));
    return all;
}

FrameInputs FrameRenderer::frameInputs(std::span<const FrameLight> lights) const {
    return {.view = gbuffer_.view(), .casters = scene_->casters(), .lights = lights};
}

LightingConstants FrameRenderer::constantsOf(const Light& light) const {
    const glm::dmat4 fromLight = worldFromLight(light.shape, camera_);
    LightingConstants constants = lightingConstants(light, fromLight);
    constants.lightFromClip = glm::inverse(camera_.clipFromView * camera_.viewFromWorld * fromLight);
    constants.size_px = {display_.width_px(), display_.height_px()};
    return constants;
}

void FrameRenderer::addLight(const Light& light, const VisibilityBuffer& visibility) {
    const gl::DebugGroup group("lighting");
    LightingConstants constants = constantsOf(light);
    constants.isVisibilityColored = visibility.colored();
    gl::Pass(lighting_)
        .constants(constants)
        .bind("Profile", scene_->profile(light))
        .bind("depthTexture", gl::TextureRef{.name = gbuffer_.view().depthTexture})
        .bind("shadingNormals", gbuffer_.shadingNormals())
        .bind("albedoTexture", gbuffer_.albedo())
        .bind("visibilityTexture", gl::TextureRef{.name = visibility.texture()})
        .bind("radianceTexture", gl::TextureRef{.name = scene_->radianceTexture(light.texture)})
        .bind("radianceImage", radiance_)
        .bind("unshadowedImage", unshadowed_)
        .bind("reachImage", reach_)
        .bind("illuminanceImage", illuminance_)
        .dispatchPixels(display_.width_px(), display_.height_px());
}

void FrameRenderer::addLuminaires(std::span<const Light> lights) {
    if (!showsLuminaires_) return;
    const gl::DebugGroup group("luminaires");
    for (const Light& light : lights) {
        const LightingConstants constants = constantsOf(light);
        if (constants.isPoint || light.shape.shape == LightShape::distant) continue;
        gl::Pass(luminaire_)
            .constants(constants)
            .bind("Profile", scene_->profile(light))
            .bind("depthTexture", gl::TextureRef{.name = gbuffer_.view().depthTexture})
            .bind("radianceTexture", gl::TextureRef{.name = scene_->radianceTexture(light.texture)})
            .bind("radianceImage", radiance_)
            .bind("nearnessImage", nearness_)
            .dispatchPixels(display_.width_px(), display_.height_px());
    }
}

Image FrameRenderer::readVisibility(const VisibilityBuffer& visibility) const {
    return readTexture(visibility.texture(), visibility.width_px(), visibility.height_px(),
                       visibility.colored() ? 3 : 1);
}

Image FrameRenderer::readReach() const {
    return readTexture(reach_.name(), reach_.width_px(), reach_.height_px(), 1);
}

Image FrameRenderer::readRadiance() const {
    return readTexture(radiance_.name(), radiance_.width_px(), radiance_.height_px(), 3);
}

const gl::Texture& FrameRenderer::toneMap() {
    const gl::DebugGroup group("tone mapping");
    if (exposureValue_) {
        const float scale = 1 / (whiteAtZero_nits * std::exp2(*exposureValue_));
        exposureResult_.write(std::as_bytes(std::span(&scale, 1)));
    } else {
        gl::Pass(exposureRows_)
            .bind("unshadowedTexture", unshadowed_)
            .bind("RowSums", rowSums_)
            .dispatch(GLuint(display_.height_px()));
        gl::Pass(exposure_).bind("RowSums", rowSums_).bind("Exposure", exposureResult_).dispatch(1);
    }
    gl::Pass(toneMap_)
        .bind("radianceTexture", radiance_)
        .bind("albedoTexture", gbuffer_.albedo())
        .bind("depthTexture", gl::TextureRef{.name = gbuffer_.view().depthTexture})
        .bind("nearnessTexture", nearness_)
        .bind("Exposure", exposureResult_)
        .bind("displayImage", display_)
        .dispatchPixels(display_.width_px(), display_.height_px());
    // For whoever shows or reads it without a pass.
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    return display_;
}

float FrameRenderer::readExposureValue() const {
    float scale = 1;
    exposureResult_.read(std::as_writable_bytes(std::span(&scale, 1)));
    return std::log2(1 / (whiteAtZero_nits * scale));
}

Image FrameRenderer::readDisplay() {
    return readTexture(toneMap().name(), display_.width_px(), display_.height_px(), 3);
}

Image readTexture(GLuint texture, int width_px, int height_px, int channels) {
    constexpr std::array<GLenum, 4> formats = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    Image bottomUp(width_px, height_px, channels);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, 0, formats[std::size_t(channels) - 1], GL_FLOAT,
                      GLsizei(bottomUp.values.size() * sizeof(float)), bottomUp.values.data());
    Image image(width_px, height_px, channels);
    const std::size_t row = std::size_t(width_px) * std::size_t(channels);
    for (std::size_t y = 0; y < std::size_t(height_px); ++y) {
        std::copy_n(&bottomUp.values[y * row], row, &image.values[(std::size_t(height_px) - 1 - y) * row]);
    }
    return image;
}

}  // namespace penumbra::studio
