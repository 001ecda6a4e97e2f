// SPDX-License-Identifier: Apache-2.0
#include "src/gl/texture.h"

#include <algorithm>

namespace penumbra::gl {
namespace {

GLuint createTexture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return name;
}

/// How texels travel.
struct Transfer {
    GLenum format, type;
};

Transfer transferOf(Format format) {
    switch (format) {
        case Format::r8:
            return {GL_RED, GL_UNSIGNED_BYTE};
        case Format::r16f:
            return {GL_RED, GL_HALF_FLOAT};
        case Format::r32f:
            return {GL_RED, GL_FLOAT};
        case Format::r32ui:
            return {GL_RED_INTEGER, GL_UNSIGNED_INT};
        case Format::rg16f:
            return {GL_RG, GL_HALF_FLOAT};
        case Format::rg32f:
            return {GL_RG, GL_FLOAT};
        case Format::rgba8:
        case Format::rgba8srgb:
            return {GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::rgba16f:
            return {GL_RGBA, GL_HALF_FLOAT};
        case Format::rgba32f:
            return {GL_RGBA, GL_FLOAT};
        case Format::rgba32ui:
            return {GL_RGBA_INTEGER, GL_UNSIGNED_INT};
        case Format::depth32f:
            return {GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::depth32fStencil8:
            return {GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
        case Format::none:
            break;
    }
    return {GL_NONE, GL_NONE};
}

std::size_t sizeOf(GLuint texture, const TextureSpec& spec) {
    std::size_t texel_bits = 0;
    for (const GLenum part :
         {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE,
          GL_TEXTURE_SHARED_SIZE, GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE}) {
        GLint bits = 0;
        glGetTextureLevelParameteriv(texture, 0, part, &bits);
        texel_bits += std::size_t(bits);
    }
    std::size_t texels = 0;
    for (int level = 0; level < spec.levels; ++level) {
        texels += std::size_t(std::max(1, spec.width_px >> level)) *
                  std::size_t(std::max(1, spec.height_px >> level)) * std::size_t(std::max(1, spec.layers));
    }
    return texels * texel_bits / 8;
}

}  // namespace

Texture::Texture(const TextureSpec& spec)
    : handle_(createTexture(spec.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D)), spec_(spec) {
    forgetErrors();
    if (spec.layers > 0) {
        glTextureStorage3D(name(), spec.levels, GLenum(spec.format), spec.width_px, spec.height_px,
                           spec.layers);
    } else {
        glTextureStorage2D(name(), spec.levels, GLenum(spec.format), spec.width_px, spec.height_px);
    }
    checkAllocated(spec.label);
    handle_.enter(sizeOf(name(), spec));
    label(GL_TEXTURE, name(), spec.label);
    spec_.label = {};
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GLint(spec.filter));
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GLint(spec.filter));
    glTextureParameteri(name(), GL_TEXTURE_WRAP_S, GLint(spec.wrap));
    glTextureParameteri(name(), GL_TEXTURE_WRAP_T, GLint(spec.wrap));
}

bool Texture::fit(const TextureSpec& spec) {
    const bool fits = name() != 0 && spec_.width_px == spec.width_px && spec_.height_px == spec.height_px &&
                      spec_.levels == spec.levels && spec_.format == spec.format &&
                      (spec_.layers == 0) == (spec.layers == 0) && spec_.layers >= spec.layers;
    if (fits) return false;
    *this = {};  // freed first, so that the two need not fit together
    *this = Texture(spec);
    return true;
}

void Texture::clear() {
    record_.makeVisible(GL_TEXTURE_UPDATE_BARRIER_BIT);
    const Transfer transfer = transferOf(spec_.format);
    glClearTexImage(name(), 0, transfer.format, transfer.type, nullptr);
}

void Texture::copyTo(Texture& target) const {
    record_.makeVisible(GL_TEXTURE_UPDATE_BARRIER_BIT);
    target.record_.makeVisible(GL_TEXTURE_UPDATE_BARRIER_BIT);
    const GLenum kind = spec_.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    glCopyImageSubData(name(), kind, 0, 0, 0, 0, target.name(), kind, 0, 0, 0, 0, spec_.width_px,
                       spec_.height_px, std::max(1, spec_.layers));
}

namespace {

/// Rows of texels stand on the CPU one right behind the other; OpenGL would begin each at a multiple of 4.
class TightRows {
  public:
    explicit TightRows(GLenum alignment) : alignment_(alignment) { glPixelStorei(alignment, 1); }
    TightRows(const TightRows&) = delete;
    TightRows& operator=(const TightRows&) = delete;
    ~TightRows() { glPixelStorei(alignment_, 4); }

  private:
    GLenum alignment_;
};

}  // namespace

void Texture::write(std::span<const std::byte> texels, int layer) {
    record_.makeVisible(GL_TEXTURE_UPDATE_BARRIER_BIT);
    const Transfer transfer = transferOf(spec_.format);
    const TightRows rows(GL_UNPACK_ALIGNMENT);
    if (spec_.layers > 0) {
        glTextureSubImage3D(name(), 0, 0, 0, layer, spec_.width_px, spec_.height_px, 1, transfer.format,
                            transfer.type, texels.data());
    } else {
        glTextureSubImage2D(name(), 0, 0, 0, spec_.width_px, spec_.height_px, transfer.format, transfer.type,
                            texels.data());
    }
}

void Texture::read(std::span<std::byte> texels, int layer) const {
    record_.makeVisible(GL_TEXTURE_UPDATE_BARRIER_BIT);
    const Transfer transfer = transferOf(spec_.format);
    const TightRows rows(GL_PACK_ALIGNMENT);
    glGetTextureSubImage(name(), 0, 0, 0, layer, spec_.width_px, spec_.height_px, 1, transfer.format,
                         transfer.type, GLsizei(texels.size()), texels.data());
}

}  // namespace penumbra::gl
