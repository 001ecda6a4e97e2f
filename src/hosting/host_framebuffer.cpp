// SPDX-License-Identifier: Apache-2.0
#include "penumbra/framebuffer.h"

#include <algorithm>
#include <array>
#include <string>

#include "src/device/host_scope.h"
#include "src/device/input_checks.h"
#include "src/device/visibility_internals.h"
#include "src/gl/framebuffer.h"
#include "src/gl/pass.h"
#include "src/hosting/darkening_io.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra {
namespace {

GLint attachment(GLuint framebuffer, GLenum own, GLenum windows, GLenum parameter) {
    GLint value = 0;
    glGetNamedFramebufferAttachmentParameteriv(framebuffer, framebuffer == 0 ? windows : own, parameter,
                                               &value);
    return value;
}

GLint depthAttachment(GLuint framebuffer, GLenum parameter) {
    return attachment(framebuffer, GL_DEPTH_ATTACHMENT, GL_DEPTH, parameter);
}

GLint stencilAttachment(GLuint framebuffer, GLenum parameter) {
    return attachment(framebuffer, GL_STENCIL_ATTACHMENT, GL_STENCIL, parameter);
}

/// Depths and stencil in one image, which copies can only be made of as a whole.
bool isPacked(GLuint framebuffer) {
    if (stencilAttachment(framebuffer, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE) return false;
    return framebuffer == 0 || stencilAttachment(framebuffer, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME) ==
                                   depthAttachment(framebuffer, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME);
}

/// That of the framebuffer's depths: copies cannot convert.
GLenum depthFormat(GLuint framebuffer) {
    const GLint bits = depthAttachment(framebuffer, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
    const bool packed = isPacked(framebuffer);
    if (depthAttachment(framebuffer, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT)
        return packed ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
    if (packed) return GL_DEPTH24_STENCIL8;
    return bits <= 16 ? GL_DEPTH_COMPONENT16 : bits <= 24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32;
}

void requireRectangle(const View& view) {
    if (view.width_px < 1 || view.height_px < 1 || view.x_px < 0 || view.y_px < 0)
        refuse("View:", "its rectangle lies in no framebuffer: width_px and height_px must be at least 1");
}

}  // namespace

struct HostFramebuffer::Internals {
    explicit Internals(Device::Internals& of)
        : device(of.shared_from_this()),
          darken(of.shaders, {"src/hosting/darkening.vert.glsl", "src/hosting/darkening.frag.glsl"}) {}

    void fit(int width_px, int height_px, GLenum newFormat, GLint newSamples);

    std::shared_ptr<Device::Internals> device;
    gl::Program darken;
    gl::Handle<gl::deleteTexture> depth;
    gl::Handle<gl::deleteFramebuffer> framebuffer;
    std::array<int, 2> size_px{};
    GLenum format = GL_NONE;
    GLint samples = 0;
};

/// Not a gl::Texture, which has one sample and formats of our own.
void HostFramebuffer::Internals::fit(int width_px, int height_px, GLenum newFormat, GLint newSamples) {
    if (size_px == std::array{width_px, height_px} && format == newFormat && samples == newSamples) return;
    size_px = {width_px, height_px};
    format = newFormat;
    samples = newSamples;
    GLuint name = 0;
    glCreateTextures(samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &name);
    depth = gl::Handle<gl::deleteTexture>(name);
    gl::forgetErrors();
    if (samples > 0) {
        glTextureStorage2DMultisample(name, samples, format, width_px, height_px, GL_TRUE);
    } else {
        glTextureStorage2D(name, 1, format, width_px, height_px);
    }
    gl::checkAllocated("a copy of the host's depths");
    gl::label(GL_TEXTURE, name, "host's depths");
    glCreateFramebuffers(1, &name);
    framebuffer = gl::Handle<gl::deleteFramebuffer>(name);
    const bool packed = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    glNamedFramebufferTexture(name, packed ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth.name(),
                              0);
    glNamedFramebufferDrawBuffer(name, GL_NONE);
}

HostFramebuffer::HostFramebuffer(Device& device) {
    const HostScope scope(internalsOf(device));
    internals_ = std::make_unique<Internals>(internalsOf(device));
}
HostFramebuffer::HostFramebuffer(HostFramebuffer&&) noexcept = default;
HostFramebuffer& HostFramebuffer::operator=(HostFramebuffer&&) noexcept = default;
HostFramebuffer::~HostFramebuffer() = default;

void HostFramebuffer::copyDepth(std::uint32_t framebuffer, View& view) {
    if (!internals_) refuse("HostFramebuffer:", "it was moved from");
    const HostScope scope(*internals_->device);
    requireRectangle(view);
    const std::string name = "framebuffer " + std::to_string(framebuffer);
    if (framebuffer != 0 && !glIsFramebuffer(framebuffer))
        refuse("HostFramebuffer:", name + " is none of the current context: give the name of one, or 0");
    if (depthAttachment(framebuffer, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE)
        refuse("HostFramebuffer:", name + " has no depths: give the one that the scene is drawn into");
    GLint samples = 0;
    glGetNamedFramebufferParameteriv(framebuffer, GL_SAMPLES, &samples);
    if (view.sample < 0 || view.sample >= std::max(samples, 1)) {
        refuse("View:", "there is no sample " + std::to_string(view.sample) + " in " + name + ", which has " +
                            std::to_string(samples));
    }

    // At the same place: copies of several samples cannot be moved.
    const int right_px = view.x_px + view.width_px, top_px = view.y_px + view.height_px;
    internals_->fit(right_px, top_px, depthFormat(framebuffer), samples);
    glBlitNamedFramebuffer(framebuffer, internals_->framebuffer.name(), view.x_px, view.y_px, right_px,
                           top_px, view.x_px, view.y_px, right_px, top_px, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    view.depthTexture = internals_->depth.name();
    view.samplePlace.reset();
    if (samples == 0) return;
    std::array<GLfloat, 2> place = {0.5f, 0.5f};
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(view.sample), place.data());
    view.samplePlace = Vec2{place[0], place[1]};
}

void HostFramebuffer::multiply(std::uint32_t framebuffer, const View& view,
                               const VisibilityBuffer& visibility, float leastLit) {
    if (!internals_) refuse("HostFramebuffer:", "it was moved from");
    const HostScope scope(*internals_->device);
    requireRectangle(view);
    if (!(leastLit >= 0 && leastLit <= 1)) refuse("HostFramebuffer:", "leastLit must lie in [0, 1]");
    if (framebuffer != 0 && !glIsFramebuffer(framebuffer))
        refuse("HostFramebuffer:", "there is no such framebuffer: give the name of one, or 0");
    const VisibilityBuffer::HostTexture& host = internalsOf(visibility).host;
    gl::beginPass(framebuffer, {});
    glViewport(view.x_px, view.y_px, view.width_px, view.height_px);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    gl::Pass(internals_->darken)
        .constants(DarkeningConstants{.pictureCorner_px = {view.x_px, view.y_px},
                                      .visibilityCorner_px = {host.x_px, host.y_px},
                                      .leastLit = leastLit,
                                      .isColored = visibility.colored()})
        .bind("visibility", gl::TextureRef{.name = visibility.texture()})
        .draw(gl::Primitive::triangles, 3);
}

}  // namespace penumbra
