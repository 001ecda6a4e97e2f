// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/reference_inputs.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>

#include "studio/frame/conversions.h"
#include "studio/frame/frame_renderer.h"
#include "studio/frame/surfaces.h"

namespace penumbra::studio {
namespace {

std::span<const glm::vec3> asGlm(std::span<const Vec3> values) {
    return {reinterpret_cast<const glm::vec3*>(values.data()), values.size()};
}

std::span<const glm::vec2> asGlm(std::span<const Vec2> values) {
    return {reinterpret_cast<const glm::vec2*>(values.data()), values.size()};
}

GLint textureParameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureParameteriv(texture, name, &value);
    return value;
}

TracedAlphaMask readMask(const AlphaMask& mask, std::vector<std::uint8_t>& rgba) {
    const GLuint texture = mask.texture;
    TracedAlphaMask read{.wrapS = Wrap(textureParameter(texture, GL_TEXTURE_WRAP_S)),
                         .wrapT = Wrap(textureParameter(texture, GL_TEXTURE_WRAP_T)),
                         .linearFilter = textureParameter(texture, GL_TEXTURE_MAG_FILTER) == GL_LINEAR,
                         .factor = mask.factor,
                         .cutoff = mask.cutoff};
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &read.width_px);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &read.height_px);
    rgba.resize(std::size_t(read.width_px) * std::size_t(read.height_px) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(rgba.size()), rgba.data());
    return read;
}

/// Of a view of points.
ReceiverImage readPoints(const View& view) {
    const Image places = readTexture(view.depthTexture, view.width_px, view.height_px, 4);
    const Image normals = readTexture(view.normalTexture, view.width_px, view.height_px, 3);
    ReceiverImage receivers{.width_px = view.width_px, .height_px = view.height_px, .areFromDepth = false};
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
            receivers.valid.push_back(places.at(x, y, 0) > 0);
            receivers.posWorld.emplace_back(places.at(x, y, 1), places.at(x, y, 2), places.at(x, y, 3));
            receivers.normalWorld.emplace_back(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2));
        }
    }
    return receivers;
}

}  // namespace

ReceiverImage readReceivers(const View& view) {
    if (view.isOfPoints) return readPoints(view);
    const int width = view.width_px, height = view.height_px;
    const Image depth = readDepth(view);
    const Image normals = readTexture(view.normalTexture, width, height, 3);
    const Image mask = view.receiverTexture != 0 ? readTexture(view.receiverTexture, width, height, 1)
                                                 : Image(width, height, 1, 1.0f);

    const glm::dmat4 worldFromView = glm::inverse(glm::dmat4(fromPenumbra(view.viewFromWorld)));
    const glm::dmat4 worldFromClip =
        worldFromView * glm::inverse(glm::dmat4(fromPenumbra(view.clipFromView)));
    const float background = backgroundOf(view.depth);
    ReceiverImage receivers{.width_px = width, .height_px = height, .eyeWorld = glm::vec3(worldFromView[3])};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float stored = depth.at(x, y);
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

CasterCopies::CasterCopies(std::span<const Caster> casters) {
    for (const Caster& caster : casters) {
        const auto positions = asGlm(caster.mesh->positions());
        const auto indices = caster.mesh->indices();
        const auto uvs = asGlm(caster.mesh->uvs());
        Copy& copy = copies_.emplace_back();
        copy.positions.assign(positions.begin(), positions.end());
        copy.indices.assign(indices.begin(), indices.end());
        copy.traced.worldFromMesh = fromPenumbra(caster.worldFromMesh);
        copy.traced.blocks = caster.casts;
        const Vec3& passes = caster.transmittance;
        copy.traced.transmittance = {passes.x, passes.y, passes.z};
        if (caster.alphaMask.texture == 0) continue;
        copy.uvs.assign(uvs.begin(), uvs.end());
        copy.traced.alphaMask = readMask(caster.alphaMask, copy.maskRgba);
    }
}

ReferenceScene CasterCopies::makeScene() const {
    std::vector<TracedCaster> traced;
    for (const Copy& copy : copies_) {
        TracedCaster& target = traced.emplace_back(copy.traced);
        target.positions = copy.positions;
        target.indices = copy.indices;
        target.uvs = copy.uvs;
        if (target.alphaMask) target.alphaMask->rgba = copy.maskRgba;
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

void writeVisibility(const Image& image, const VisibilityBuffer& out) {
    Image flipped(image.width_px, image.height_px, out.colored() ? 3 : image.channels);
    for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
            for (int c = 0; c < flipped.channels; ++c)
                flipped.at(x, image.height_px - 1 - y, c) = image.at(x, y, std::min(c, image.channels - 1));
        }
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(out.texture(), 0, 0, 0, image.width_px, image.height_px,
                        flipped.channels == 3 ? GL_RGB : GL_RED, GL_FLOAT, flipped.values.data());
}

}  // namespace penumbra::studio
