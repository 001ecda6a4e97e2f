// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>

#include "src/device/device_internals.h"
#include "src/device/host_scope.h"
#include "src/device/visibility_internals.h"
#include "src/gl/texture_target.h"

namespace penumbra {
namespace {

struct WritableFormat {
    GLenum format;
    int channels;
};
/// What image stores know (OpenGL 4.5, table 8.26) and visibility can be told in.
constexpr std::array<WritableFormat, 14> writableFormats = {{{GL_R8, 1},
                                                             {GL_R16, 1},
                                                             {GL_R16F, 1},
                                                             {GL_R32F, 1},
                                                             {GL_RG8, 2},
                                                             {GL_RG16, 2},
                                                             {GL_RG16F, 2},
                                                             {GL_RG32F, 2},
                                                             {GL_RGBA8, 4},
                                                             {GL_RGBA16, 4},
                                                             {GL_RGBA16F, 4},
                                                             {GL_RGBA32F, 4},
                                                             {GL_RGB10_A2, 4},
                                                             {GL_R11F_G11F_B10F, 3}}};

void require(bool condition, const std::string& message) {
    if (!condition) throw Error(Error::Kind::badArgument, "VisibilityBuffer: " + message);
}

void requireSize(const Device::Internals& device, int width_px, int height_px) {
    const int limit = device.maxTextureSize_px;
    require(width_px >= 1 && height_px >= 1 && width_px <= limit && height_px <= limit,
            "sizes must lie in 1.." + std::to_string(limit) + ", not " + std::to_string(width_px) + "x" +
                std::to_string(height_px));
}

GLenum writableFormatOf(const VisibilityBuffer::HostTexture& host, bool colored) {
    const std::string name = "texture " + std::to_string(host.texture);
    const GLenum target = gl::targetOf(host.texture);
    require(target != GL_NONE, name + " is no texture of the current context");
    require(target == GL_TEXTURE_2D, name + " is no GL_TEXTURE_2D");
    GLint width_px = 0, height_px = 0, format = 0;
    glGetTextureLevelParameteriv(host.texture, 0, GL_TEXTURE_WIDTH, &width_px);
    glGetTextureLevelParameteriv(host.texture, 0, GL_TEXTURE_HEIGHT, &height_px);
    glGetTextureLevelParameteriv(host.texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    require(host.x_px >= 0 && host.y_px >= 0 && host.x_px + host.width_px <= width_px &&
                host.y_px + host.height_px <= height_px,
            "the rectangle does not lie in " + name + ", which is " + std::to_string(width_px) + "x" +
                std::to_string(height_px));
    const auto found = std::ranges::find(writableFormats, GLenum(format), &WritableFormat::format);
    require(found != writableFormats.end(), name + " has a format that shaders cannot write");
    require(!colored || found->channels >= 3, name + " has too few channels for a textured light");
    return found->format;
}

gl::Texture makeTexture(int width_px, int height_px, GLenum format) {
    return gl::Texture(
        {.width_px = width_px, .height_px = height_px, .format = gl::Format(format), .label = "visibility"});
}

}  // namespace

VisibilityBuffer::VisibilityBuffer() : internals_(std::make_unique<Internals>()) {}

VisibilityBuffer VisibilityBuffer::Internals::make(Device::Internals& device, int width_px, int height_px,
                                                   bool colored) {
    VisibilityBuffer made;
    made.internals_->device = device.shared_from_this();
    made.internals_->colored = colored;
    made.internals_->format = GLenum(colored ? GL_RGBA16F : GL_R32F);
    made.resize(width_px, height_px);
    return made;
}

VisibilityBuffer::VisibilityBuffer(Device& device, int width_px, int height_px, bool colored)
    : VisibilityBuffer(Internals::make(internalsOf(device), width_px, height_px, colored)) {}

VisibilityBuffer::VisibilityBuffer(Device& device, const HostTexture& host, bool colored)
    : VisibilityBuffer() {
    requireSize(internalsOf(device), host.width_px, host.height_px);
    const HostScope scope(internalsOf(device));
    internals_->device = internalsOf(device).shared_from_this();
    internals_->host = host;
    internals_->colored = colored;
    internals_->format = writableFormatOf(host, colored);
}

VisibilityBuffer::Internals& VisibilityBuffer::internals() const {
    if (internals_) return *internals_;
    throw Error(Error::Kind::badArgument,
                "VisibilityBuffer: it was moved from: use the buffer that it was moved to");
}

VisibilityBuffer::VisibilityBuffer(VisibilityBuffer&&) noexcept = default;
VisibilityBuffer& VisibilityBuffer::operator=(VisibilityBuffer&&) noexcept = default;
VisibilityBuffer::~VisibilityBuffer() = default;

void VisibilityBuffer::resize(int width_px, int height_px) {
    internals().device->requireContext();
    requireSize(*internals().device, width_px, height_px);
    require(internals().host.texture == 0, "one that writes into the host's texture cannot be resized");
    if (texture() != 0 && width_px == this->width_px() && height_px == this->height_px()) return;
    const gl::ObjectRegistryScope scope(internals().device->registry);
    internals().own = {};  // freed first, so that the two need not fit together
    internals().own = makeTexture(width_px, height_px, internals().format);
}

int VisibilityBuffer::width_px() const {
    return internals().host.texture == 0 ? internals().own.width_px() : internals().host.width_px;
}
int VisibilityBuffer::height_px() const {
    return internals().host.texture == 0 ? internals().own.height_px() : internals().host.height_px;
}
bool VisibilityBuffer::colored() const {
    return internals().colored;
}
std::uint32_t VisibilityBuffer::texture() const {
    return internals().host.texture == 0 ? internals().own.name() : internals().host.texture;
}

}  // namespace penumbra
