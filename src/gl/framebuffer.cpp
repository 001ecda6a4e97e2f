// SPDX-License-Identifier: Apache-2.0
#include "src/gl/framebuffer.h"

#include <algorithm>
#include <string>

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

void Framebuffer::fit(std::initializer_list<const Texture*> colors, const Texture* depth,
                      std::string_view text) {
    std::array<std::uint64_t, mostTextures> identities{};
    std::ranges::transform(colors, identities.begin(), &Texture::identity);
    if (depth != nullptr) identities.back() = depth->identity();
    const bool areKnown =
        std::ranges::none_of(colors, [](const Texture* color) { return color->identity() == 0; }) &&
        (depth == nullptr || depth->identity() != 0);
    if (name() != 0 && areKnown && identities == identities_) return;

    *this = {};
    handle_ = Handle<deleteFramebuffer>(createFramebuffer());
    std::array<GLenum, mostTextures> drawBuffers{GL_NONE};
    std::size_t textures = 0;
    for (const Texture* color : colors) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + GLenum(textures);
        glNamedFramebufferTexture(name(), attachment, color->name(), 0);
        drawBuffers[textures] = attachment;
        records_[textures++] = &color->record();
    }
    glNamedFramebufferDrawBuffers(name(), GLsizei(std::max<std::size_t>(1, textures)), drawBuffers.data());
    if (depth != nullptr) {
        records_[textures] = &depth->record();
        const bool hasStencil = depth->format() == Format::depth32fStencil8;
        glNamedFramebufferTexture(name(), hasStencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                                  depth->name(), 0);
    }
    label(GL_FRAMEBUFFER, name(), text);
    if (glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(Error::Kind::outOfMemory, "the OpenGL device cannot draw into " + std::string(text) +
                                                  ": its framebuffer is incomplete");
    }
    identities_ = identities;  // last: what failed is tried again
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
