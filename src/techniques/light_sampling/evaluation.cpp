// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/evaluation.h"

#include <algorithm>
#include <array>

namespace penumbra {

void EvaluationOptions::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> paths = {"array", "accumulation"};
    static constexpr std::array<std::string_view, 2> weightings = {"area", "irradiance"};
    visitor.choice(
        {.name = "evaluation", .help = "all maps of a batch in one pass, or an accumulation pass a map"},
        path, paths);
    visitor.integer(
        {.name = "filter", .unit = "texels", .help = "side of the kernel that smooths each map; 1: none"},
        filter, {1, 3});
    visitor.choice(
        {.name = "weight", .help = "what a part of the light counts by: its area, or its irradiance"},
        weighting, weightings);
}

SampleLookup::SampleLookup(Device& device, std::string file)
    : device_(device.internals()), file_(std::move(file)) {}

std::vector<std::string> SampleLookup::Variant::defines() const {
    std::vector<std::string> defines = {"FILTER " + std::to_string(filter)};
    if (wishes.colored) defines.push_back("COLORED");
    if (wishes.bits) defines.push_back("BITS");
    if (wishes.smooth) defines.push_back("SMOOTH");
    if (distant) defines.push_back("DISTANT");
    if (sphere) defines.push_back("SPHERE");
    if (cube) defines.push_back("CUBE");
    return defines;
}

void SampleLookup::use(const AreaLight& light, const SampleCameras& cameras, const EvaluationOptions& options,
                       const Wishes& wishes) {
    const Variant variant{wishes, options.filter, light.shape == LightShape::distant,
                          light.shape == LightShape::sphere && light.radius_m > 0, cameras.isCube};
    auto found = programs_.find(variant);
    if (found == programs_.end()) {
        found = programs_.emplace(variant, gl::Program(device_.shaders, {file_}, variant.defines())).first;
    }
    found->second.use();
    glUniform2f(5, float(cameras.near_m), float(cameras.far_m));
    glUniform1i(6, isOneSided(light));
    glUniform1i(7, options.weighting);
    std::array<glm::mat3, 6> faces;
    for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = glm::mat3(cameras.faceFromLight[i]);
    glUniformMatrix3fv(10, cameras.isCube ? 6 : 1, GL_FALSE, &faces[0][0][0]);
}

SampleEvaluation::SampleEvaluation(Device& device)
    : lookup_(device, "src/techniques/light_sampling/evaluate.comp.glsl") {}

void SampleEvaluation::add(const ShadowInputs& inputs, const SampleCameras& cameras,
                           const EvaluationOptions& options, const SampleMaps& maps, const Batch& batch,
                           VisibilityBuffer& out) {
    const bool byPass = options.path == EvaluationOptions::accumulation && batch.mostSlots > 1;
    if (byPass || !batch.starts || !batch.ends) {
        const gl::Format format = out.colored() ? gl::Format::rgba32f : gl::Format::r32f;
        if (seen_.width_px() != out.width_px() || seen_.height_px() != out.height_px() ||
            seen_.format() != format) {
            const gl::TextureSpec spec{.width_px = out.width_px(),
                                       .height_px = out.height_px(),
                                       .format = format,
                                       .label = "light sampling accumulation"};
            seen_ = {};
            whole_ = {};
            seen_ = gl::Texture(spec);
            whole_ = gl::Texture(spec);
        }
        seen_.bindImage(1, GL_READ_WRITE);
        whole_.bindImage(2, GL_READ_WRITE);
    }
    lookup_.use(inputs.light, cameras, options,
                {.colored = out.colored(), .bits = batch.usesBits, .smooth = batch.taps > 0});
    if (batch.taps > 0) glUniform1i(17, batch.taps);
    maps.bind();
    maps.setBatch(batch.stage, batch.batch);
    bindVisibility(out, 0);
    const int step = byPass ? 1 : batch.mostSlots;
    for (int slot = 0; slot < batch.mostSlots; slot += step) {
        glUniform4i(16, slot, slot + step, batch.starts && slot == 0,
                    batch.ends && slot + step >= batch.mostSlots);
        gl::dispatchPixels(out.width_px(), out.height_px());
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    }
}

RadianceWeights::RadianceWeights(Device& device)
    : program_(device.internals().shaders, {"src/techniques/light_sampling/weigh.comp.glsl"}),
      cells_("light sampling cells") {}

void RadianceWeights::weigh(GLuint radianceTexture, std::span<const glm::vec4> cells,
                            const gl::Buffer& samples) {
    cells_.write(cells);
    program_.use();
    glBindTextureUnit(0, radianceTexture);
    cells_.bind(0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, samples.name());
    glUniform1i(0, int(cells.size()));
    glDispatchCompute(GLuint(cells.size() + 63) / 64, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

int mapSizeFor(const LightSurface& surface, int mapSize_px) {
    return surface.isPoint() ? std::min(4 * mapSize_px, 16384) : mapSize_px;
}

}  // namespace penumbra
