// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/reference_technique.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>

#include "studio/frame/conversions.h"
#include "studio/frame/frame_renderer.h"

namespace penumbra::studio {
namespace {

constexpr std::array<std::string_view, 2> weightNames = {"area", "irradiance"};

std::span<const glm::vec3> asGlm(std::span<const Vec3> values) {
    return {reinterpret_cast<const glm::vec3*>(values.data()), values.size()};
}

std::span<const glm::vec2> asGlm(std::span<const Vec2> values) {
    return {reinterpret_cast<const glm::vec2*>(values.data()), values.size()};
}

/// The depth as clip-space z.
double clipZ(const DepthConvention& convention, float depth) {
    return convention.range == DepthConvention::Range::zeroToOne ? depth : 2.0 * depth - 1.0;
}

ReceiverImage readReceivers(const View& view) {
    const int width = view.width_px, height = view.height_px;
    Image depth(width, height, 1);
    const auto bytes = GLsizei(depth.values.size() * sizeof(float));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(view.depthTexture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, bytes, depth.values.data());
    const Image normals = readTexture(view.normalTexture, width, height, 3);
    const Image mask = view.receiverTexture != 0 ? readTexture(view.receiverTexture, width, height, 1)
                                                 : Image(width, height, 1, 1.0f);

    const glm::dmat4 worldFromView = glm::inverse(glm::dmat4(fromPenumbra(view.viewFromWorld)));
    const glm::dmat4 worldFromClip =
        worldFromView * glm::inverse(glm::dmat4(fromPenumbra(view.clipFromView)));
    const float background = view.depth.reversed ? 0.0f : 1.0f;
    ReceiverImage receivers{.width_px = width, .height_px = height, .eyeWorld = glm::vec3(worldFromView[3])};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float stored = depth.at(x, height - 1 - y);  // read back bottom row first
            const glm::dvec4 clip((x + 0.5) / width * 2 - 1, 1 - (y + 0.5) / height * 2,
                                  clipZ(view.depth, stored), 1);
            const glm::dvec4 posWorld = worldFromClip * clip;
            const bool valid = stored != background && mask.at(x, y) >= 0.5f;
            receivers.valid.push_back(valid);
            receivers.posWorld.push_back(valid ? glm::vec3(glm::dvec3(posWorld) / posWorld.w) : glm::vec3(0));
            receivers.normalWorld.emplace_back(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2));
        }
    }
    return receivers;
}

GLint textureParameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureParameteriv(texture, name, &value);
    return value;
}

/// A mask's texture on the CPU, first row at v = 0.
struct MaskPixels {
    int width_px = 0, height_px = 0;
    std::vector<std::uint8_t> rgba;
};

MaskPixels readMask(GLuint texture) {
    MaskPixels pixels;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &pixels.width_px);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &pixels.height_px);
    pixels.rgba.resize(std::size_t(pixels.width_px) * std::size_t(pixels.height_px) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(pixels.rgba.size()), pixels.rgba.data());
    return pixels;
}

ReferenceScene makeScene(std::span<const Caster> casters) {
    std::vector<TracedCaster> traced;
    std::vector<MaskPixels> masks;
    masks.reserve(casters.size());  // spans into them are kept
    for (const Caster& caster : casters) {
        if (!caster.casts) continue;
        TracedCaster& target = traced.emplace_back();
        target.positions = asGlm(caster.mesh->positions());
        target.indices = caster.mesh->indices();
        target.uvs = asGlm(caster.mesh->uvs());
        target.worldFromMesh = fromPenumbra(caster.worldFromMesh);
        if (caster.alphaMask.texture == 0) continue;
        const GLuint texture = caster.alphaMask.texture;
        const MaskPixels& pixels = masks.emplace_back(readMask(texture));
        target.alphaMask =
            TracedAlphaMask{.width_px = pixels.width_px,
                            .height_px = pixels.height_px,
                            .rgba = pixels.rgba,
                            .wrapS = Wrap(textureParameter(texture, GL_TEXTURE_WRAP_S)),
                            .wrapT = Wrap(textureParameter(texture, GL_TEXTURE_WRAP_T)),
                            .linearFilter = textureParameter(texture, GL_TEXTURE_MAG_FILTER) == GL_LINEAR,
                            .factor = caster.alphaMask.factor,
                            .cutoff = caster.alphaMask.cutoff};
    }
    return ReferenceScene(traced);
}

std::optional<RadianceTexture> readRadianceTexture(GLuint texture) {
    if (texture == 0) return std::nullopt;
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &height);
    Image rows(width, height, 3);  // GL's first row is the light's -Y edge, as RadianceTexture wants it
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, 0, GL_RGB, GL_FLOAT, GLsizei(rows.values.size() * sizeof(float)),
                      rows.values.data());
    // Read back, texels of sRGB formats stay encoded; shaders that sample them get linear light.
    GLint encoding = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &encoding);
    if (encoding == GL_SRGB8_ALPHA8 || encoding == GL_SRGB8) {
        for (float& value : rows.values) {
            value = value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
        }
    }
    return RadianceTexture{std::move(rows)};
}

/// Puts an image (rows from the top) into the visibility texture.
void write(const Image& image, const VisibilityBuffer& out) {
    Image flipped = image;
    const std::size_t row = std::size_t(image.width_px) * std::size_t(image.channels);
    for (std::size_t y = 0; y < std::size_t(image.height_px); ++y) {
        std::copy_n(&image.values[y * row], row,
                    &flipped.values[(std::size_t(image.height_px) - 1 - y) * row]);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(out.texture(), 0, 0, 0, image.width_px, image.height_px,
                        image.channels == 3 ? GL_RGB : GL_RED, GL_FLOAT, flipped.values.data());
}

}  // namespace

void ReferenceTechnique::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "samples", .unit = "rays", .help = "rays for each pixel"}, samples_, {2, 65536});
    visitor.integer({.name = "seed", .help = "chooses the sampling pattern"}, seed_, {0, 1 << 30});
    visitor.choice(
        {.name = "weight", .help = "what a part of the light counts by: its area, or its irradiance"},
        weight_, weightNames);
    visitor.boolean({.name = "cache", .help = "keep traces on disk and use them again"}, cached_);
}

void ReferenceTechnique::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    if (inputs.view.normalTexture == 0) {
        throw Error(Error::Kind::badArgument, "reference: View::normalTexture is missing");
    }
    const ReferenceScene scene = makeScene(inputs.casters);
    const std::optional<RadianceTexture> radiance = readRadianceTexture(inputs.light.radianceTexture);
    ReferenceCache cache(cached_ ? ReferenceCache::defaultFolder() : std::filesystem::path());
    last_ = cache.trace(scene, readReceivers(inputs.view), inputs.light, radiance ? &*radiance : nullptr,
                        {.samples = samples_,
                         .seed = std::uint32_t(seed_),
                         .weight = ReferenceOptions::Weight(weight_),
                         .progress = progress_});
    write(last_.visibility, out);
}

Statistics ReferenceTechnique::statistics() const {
    return {.counts = {{"samples", double(samples_)},
                       {"noise_rms", last_.noise_rms},
                       {"rays", double(last_.rays)},
                       {"trace_seconds", last_.seconds, "s"}},
            .passes = {{"reference/trace", 1e3 * last_.seconds}}};
}

}  // namespace penumbra::studio
