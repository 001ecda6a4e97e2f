// SPDX-License-Identifier: Apache-2.0
#include "penumbra/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>

#include "src/device/glm_types.h"
#include "src/device/host_scope.h"
#include "src/device/input_checks.h"
#include "src/gl/texture.h"

namespace penumbra {
namespace {

/// Points that follow each other fill squares of this many pixels a side, which techniques look at together,
/// and in them, eight by eight, rectangles of half the width and a quarter of the height.
constexpr std::size_t side_px = 8, squarePoints = side_px * side_px;
constexpr std::size_t partWidth_px = 4, partHeight_px = 2, partPoints = partWidth_px * partHeight_px;

/// Squares side by side: a texture that many points make nearly square, and few not larger than needed.
constexpr std::size_t mostAcross = 128;

bool isFinite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 unit(const Vec3& v) {
    const glm::dvec3 exact(toGlm(v));
    return exact / glm::length(exact);
}

}  // namespace

struct Points::Internals {
    std::size_t count = 0;
    std::size_t across = 1;  ///< squares
    std::shared_ptr<Device::Internals> device;
    gl::Texture places, normals;

    std::size_t pixelOf(std::size_t point) const {
        const std::size_t square = point / squarePoints, within = point % squarePoints;
        const std::size_t part = within / partPoints, inPart = within % partPoints;
        const std::size_t x = side_px * (square % across) + partWidth_px * (part % 2) + inPart % partWidth_px;
        const std::size_t y =
            side_px * (square / across) + partHeight_px * (part / 2) + inPart / partWidth_px;
        return y * side_px * across + x;
    }
};

Points::Points(Device& device, std::span<const Vec3> positions, std::span<const Vec3> normals)
    : internals_(std::make_unique<Internals>()) {
    const HostScope scope(internalsOf(device));
    if (positions.empty()) refuse("Points: positions", "are none: give at least one");
    if (positions.size() != normals.size()) {
        refuse("Points: normals", "are " + std::to_string(normals.size()) + " for " +
                                      std::to_string(positions.size()) + " positions: give one each");
    }
    const std::size_t squares = (positions.size() + squarePoints - 1) / squarePoints;
    internals_->count = positions.size();
    internals_->across = std::min(squares, mostAcross);
    internals_->device = internalsOf(device).shared_from_this();
    const std::size_t width_px = side_px * internals_->across;
    const std::size_t height_px = side_px * ((squares + internals_->across - 1) / internals_->across);
    if (height_px > std::size_t(device.maxTextureSize_px())) {
        refuse("Points: positions", "are too many for one texture of this device: give at most " +
                                        std::to_string(width_px * std::size_t(device.maxTextureSize_px())) +
                                        " at a time");
    }

    std::vector<glm::vec4> placeTexels(width_px * height_px, glm::vec4(0)), normalTexels = placeTexels;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!isFinite(positions[i])) refuse({"Points: positions", i, ""}, "is not finite");
        if (!isFinite(normals[i]) || normals[i] == Vec3{})
            refuse({"Points: normals", i, ""}, "is not finite or has no length");
        const std::size_t pixel = internals_->pixelOf(i);
        placeTexels[pixel] = {1, positions[i].x, positions[i].y, positions[i].z};
        normalTexels[pixel] = glm::vec4(glm::vec3(unit(normals[i])), 0);
    }
    const auto makeTexture = [&](const std::vector<glm::vec4>& texels, std::string_view label) {
        gl::Texture made({.width_px = int(width_px),
                          .height_px = int(height_px),
                          .format = gl::Format::rgba32f,
                          .label = label});
        made.write(std::as_bytes(std::span(texels)));
        return made;
    };
    internals_->places = makeTexture(placeTexels, "points/places");
    internals_->normals = makeTexture(normalTexels, "points/normals");
}

Points::Points(Points&&) noexcept = default;
Points& Points::operator=(Points&&) noexcept = default;
Points::~Points() = default;

std::size_t Points::count() const {
    return internals_->count;
}
int Points::width_px() const {
    return internals_->places.width_px();
}
int Points::height_px() const {
    return internals_->places.height_px();
}

View Points::view() const {
    return {.width_px = width_px(),
            .height_px = height_px(),
            .depthTexture = internals_->places.name(),
            .normalTexture = internals_->normals.name(),
            .isOfPoints = true};
}

std::vector<float> Points::read(std::uint32_t texture, int channels) const {
    const HostScope scope(*internals_->device);
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &height);
    if (width != width_px() || height != height_px())
        refuse("Points: read:", "the texture is not of Points::width_px and height_px: make one that is");
    constexpr std::array<GLenum, 4> formats = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    if (channels < 1 || channels > int(formats.size()))
        refuse("Points: read:", "a texture has 1 to 4 channels");
    const std::size_t perPoint = std::size_t(channels);
    std::vector<float> texels(std::size_t(width) * std::size_t(height) * perPoint);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(texture, 0, formats[perPoint - 1], GL_FLOAT, GLsizei(texels.size() * sizeof(float)),
                      texels.data());
    std::vector<float> values;
    values.reserve(count() * perPoint);
    for (std::size_t i = 0; i < count(); ++i) {
        const auto first = texels.begin() + std::ptrdiff_t(internals_->pixelOf(i) * perPoint);
        values.insert(values.end(), first, first + std::ptrdiff_t(perPoint));
    }
    return values;
}

}  // namespace penumbra
