// SPDX-License-Identifier: Apache-2.0
#include "src/gl/framebuffer.h"

#include <string>
#include <vector>

#include "penumbra/device.h"
#include "src/gl/texture.h"

namespace penumbra::gl {
namespace {

GLuint createFramebuffer() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return name;
}

}  // namespace

Framebuffer::Framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth,
                         std::string_view text)
    : handle_(createFramebuffer()) {
    std::vector<GLenum> drawBuffers;
    std::size_t textures = 0;
    for (const Texture* color : colors) {
        records_[textures++] = &color->record();
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + GLenum(drawBuffers.size());
        glNamedFramebufferTexture(name(), attachment, color->name(), 0);
        drawBuffers.push_back(attachment);
    }
    if (drawBuffers.empty()) drawBuffers.push_back(GL_NONE);
    glNamedFramebufferDrawBuffers(name(), GLsizei(drawBuffers.size()), drawBuffers.data());
    if (depth != nullptr) {
        records_[textures++] = &depth->record();
        const bool hasStencil = depth->format() == Format::depth32fStencil8;
        glNamedFramebufferTexture(name(), hasStencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                                  depth->name(), 0);
    }
    label(GL_FRAMEBUFFER, name(), text);
    if (glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(Error::Kind::outOfMemory, "the OpenGL device cannot draw into " + std::string(text) +
                                                  ": its framebuffer is incomplete");
    }
}

void Framebuffer::makeVisible() const {
    for (const WriteRecord* record : records_) {
        if (record != nullptr) record->makeVisible(GL_FRAMEBUFFER_BARRIER_BIT);
    }
}

void Framebuffer::attachDepthLayer(const Texture& depth, int layer) {
    glNamedFramebufferTextureLayer(name(), GL_DEPTH_ATTACHMENT, depth.name(), 0, layer);
}

}  // namespace penumbra::gl
