// SPDX-License-Identifier: Apache-2.0
#include "src/device/host_state.h"

#include <algorithm>

namespace penumbra {
namespace {

struct PixelStore {
    GLenum name;
    GLint standard;
};
constexpr std::array<PixelStore, 16> pixelStores = {{
    {GL_UNPACK_ALIGNMENT, 4},
    {GL_UNPACK_ROW_LENGTH, 0},
    {GL_UNPACK_IMAGE_HEIGHT, 0},
    {GL_UNPACK_SKIP_ROWS, 0},
    {GL_UNPACK_SKIP_PIXELS, 0},
    {GL_UNPACK_SKIP_IMAGES, 0},
    {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_LSB_FIRST, 0},
    {GL_PACK_ALIGNMENT, 4},
    {GL_PACK_ROW_LENGTH, 0},
    {GL_PACK_IMAGE_HEIGHT, 0},
    {GL_PACK_SKIP_ROWS, 0},
    {GL_PACK_SKIP_PIXELS, 0},
    {GL_PACK_SKIP_IMAGES, 0},
    {GL_PACK_SWAP_BYTES, 0},
    {GL_PACK_LSB_FIRST, 0},
}};

/// Of the front and the back: function, reference, mask; what to do where the stencil fails, where the depth
/// does, where both pass; which bits are written.
constexpr std::array<std::array<GLenum, 7>, 2> stencilNames = {{
    {GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_FAIL,
     GL_STENCIL_PASS_DEPTH_PASS, GL_STENCIL_WRITEMASK},
    {GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK, GL_STENCIL_BACK_FAIL,
     GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_PASS, GL_STENCIL_BACK_WRITEMASK},
}};

GLint integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

GLint integer(GLenum name, GLuint index) {
    GLint value = 0;
    glGetIntegeri_v(name, index, &value);
    return value;
}

void enable(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

void enable(GLenum capability, GLuint index, bool on) {
    on ? glEnablei(capability, index) : glDisablei(capability, index);
}

}  // namespace

void setKnownState() {
    gl::beginPass(0, {});
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glPointSize(1);
    setKnownCompatibilityState();
    for (const PixelStore& store : pixelStores) glPixelStorei(store.name, store.standard);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glBindBuffer(GL_QUERY_BUFFER, 0);
    // A sampler object would overrule our textures' own filters.
    glBindSamplers(0, gl::textureUnits, nullptr);
}

HostState::HostState() {
    saveObjects();
    saveRaster();
    saveUnits();
}

HostState::~HostState() {
    restoreUnits();
    restoreRaster();
    restoreObjects();
}

void HostState::saveObjects() {
    program_ = integer(GL_CURRENT_PROGRAM);
    vertexArray_ = integer(GL_VERTEX_ARRAY_BINDING);
    drawFramebuffer_ = integer(GL_DRAW_FRAMEBUFFER_BINDING);
    drawIndirect_ = integer(GL_DRAW_INDIRECT_BUFFER_BINDING);
    dispatchIndirect_ = integer(GL_DISPATCH_INDIRECT_BUFFER_BINDING);
    pixelPack_ = integer(GL_PIXEL_PACK_BUFFER_BINDING);
    pixelUnpack_ = integer(GL_PIXEL_UNPACK_BUFFER_BINDING);
    query_ = integer(GL_QUERY_BUFFER_BINDING);
    storage_ = integer(GL_SHADER_STORAGE_BUFFER_BINDING);
    uniform_ = integer(GL_UNIFORM_BUFFER_BINDING);
    static_assert(pixelStores == penumbra::pixelStores.size());
    for (std::size_t i = 0; i < pixelStores; ++i) pixelStore_[i] = integer(penumbra::pixelStores[i].name);
}

void HostState::restoreObjects() const {
    // One that the host had deleted lived only as long as it was current.
    glUseProgram(glIsProgram(GLuint(program_)) ? GLuint(program_) : 0);
    glBindVertexArray(GLuint(vertexArray_));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(drawFramebuffer_));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, GLuint(drawIndirect_));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, GLuint(dispatchIndirect_));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(pixelPack_));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(pixelUnpack_));
    glBindBuffer(GL_QUERY_BUFFER, GLuint(query_));
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, GLuint(storage_));
    glBindBuffer(GL_UNIFORM_BUFFER, GLuint(uniform_));
    for (std::size_t i = 0; i < pixelStores; ++i)
        glPixelStorei(penumbra::pixelStores[i].name, pixelStore_[i]);
}

void HostState::saveRaster() {
    for (std::size_t i = 0; i < unused_.size(); ++i) unused_[i] = glIsEnabled(gl::unusedCapabilities[i]);
    depthTest_ = glIsEnabled(GL_DEPTH_TEST);
    depthClamp_ = glIsEnabled(GL_DEPTH_CLAMP);
    cull_ = glIsEnabled(GL_CULL_FACE);
    cullFace_ = integer(GL_CULL_FACE_MODE);
    frontFace_ = integer(GL_FRONT_FACE);
    depthFunction_ = integer(GL_DEPTH_FUNC);
    clipOrigin_ = integer(GL_CLIP_ORIGIN);
    clipDepth_ = integer(GL_CLIP_DEPTH_MODE);
    provokingVertex_ = integer(GL_PROVOKING_VERTEX);
    glGetFloatv(GL_POINT_SIZE, &pointSize_);
    glGetIntegerv(GL_POLYGON_MODE, polygonMode_.data());
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
    for (std::size_t face = 0; face < stencil_.size(); ++face) {
        for (std::size_t i = 0; i < stencilNames[face].size(); ++i)
            stencil_[face][i] = integer(stencilNames[face][i]);
    }

    viewportCount_ = std::min(mostViewports, std::size_t(integer(GL_MAX_VIEWPORTS)));
    for (GLuint i = 0; i < viewportCount_; ++i) {
        Viewport& viewport = viewports_[i];
        glGetFloati_v(GL_VIEWPORT, i, viewport.rectangle.data());
        glGetDoublei_v(GL_DEPTH_RANGE, i, viewport.depthRange.data());
        viewport.scissor = glIsEnabledi(GL_SCISSOR_TEST, i);
    }
    drawBufferCount_ = std::min(mostDrawBuffers, std::size_t(integer(GL_MAX_DRAW_BUFFERS)));
    for (GLuint i = 0; i < drawBufferCount_; ++i) {
        DrawBuffer& buffer = drawBuffers_[i];
        glGetBooleani_v(GL_COLOR_WRITEMASK, i, buffer.colorMask.data());
        buffer.blend = glIsEnabledi(GL_BLEND, i);
        buffer.equationRgb = integer(GL_BLEND_EQUATION_RGB, i);
        buffer.equationAlpha = integer(GL_BLEND_EQUATION_ALPHA, i);
        buffer.sourceRgb = integer(GL_BLEND_SRC_RGB, i);
        buffer.sourceAlpha = integer(GL_BLEND_SRC_ALPHA, i);
        buffer.destinationRgb = integer(GL_BLEND_DST_RGB, i);
        buffer.destinationAlpha = integer(GL_BLEND_DST_ALPHA, i);
    }
}

void HostState::restoreRaster() const {
    for (std::size_t i = 0; i < unused_.size(); ++i) enable(gl::unusedCapabilities[i], unused_[i]);
    enable(GL_DEPTH_TEST, depthTest_);
    enable(GL_DEPTH_CLAMP, depthClamp_);
    enable(GL_CULL_FACE, cull_);
    glCullFace(GLenum(cullFace_));
    glFrontFace(GLenum(frontFace_));
    glDepthFunc(GLenum(depthFunction_));
    glClipControl(GLenum(clipOrigin_), GLenum(clipDepth_));
    glProvokingVertex(GLenum(provokingVertex_));
    glPointSize(pointSize_);
    if (isCompatibilityContext()) {
        glPolygonMode(GL_FRONT, GLenum(polygonMode_[0]));
        glPolygonMode(GL_BACK, GLenum(polygonMode_[1]));
    } else {
        glPolygonMode(GL_FRONT_AND_BACK, GLenum(polygonMode_[0]));
    }
    glDepthMask(depthMask_);
    for (const GLenum face : {GL_FRONT, GL_BACK}) {
        const auto& stencil = stencil_[face == GL_FRONT ? 0 : 1];
        glStencilFuncSeparate(face, GLenum(stencil[0]), stencil[1], GLuint(stencil[2]));
        glStencilOpSeparate(face, GLenum(stencil[3]), GLenum(stencil[4]), GLenum(stencil[5]));
        glStencilMaskSeparate(face, GLuint(stencil[6]));
    }

    for (GLuint i = 0; i < viewportCount_; ++i) {
        const Viewport& viewport = viewports_[i];
        glViewportIndexedfv(i, viewport.rectangle.data());
        glDepthRangeIndexed(i, viewport.depthRange[0], viewport.depthRange[1]);
        enable(GL_SCISSOR_TEST, i, viewport.scissor);
    }
    for (GLuint i = 0; i < drawBufferCount_; ++i) {
        const DrawBuffer& buffer = drawBuffers_[i];
        const auto& mask = buffer.colorMask;
        glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
        enable(GL_BLEND, i, buffer.blend);
        glBlendEquationSeparatei(i, GLenum(buffer.equationRgb), GLenum(buffer.equationAlpha));
        glBlendFuncSeparatei(i, GLenum(buffer.sourceRgb), GLenum(buffer.destinationRgb),
                             GLenum(buffer.sourceAlpha), GLenum(buffer.destinationAlpha));
    }
}

void HostState::saveUnits() {
    activeTexture_ = integer(GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < gl::textureUnits; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (std::size_t i = 0; i < gl::textureTargets.size(); ++i) {
            textureUnits_[unit].textures[i] = integer(gl::textureTargets[i].binding);
        }
        textureUnits_[unit].sampler = integer(GL_SAMPLER_BINDING);
    }
    glActiveTexture(GLenum(activeTexture_));
    for (GLuint unit = 0; unit < gl::imageUnits; ++unit) {
        imageUnits_[unit] = {integer(GL_IMAGE_BINDING_NAME, unit),    integer(GL_IMAGE_BINDING_LEVEL, unit),
                             integer(GL_IMAGE_BINDING_LAYERED, unit), integer(GL_IMAGE_BINDING_LAYER, unit),
                             integer(GL_IMAGE_BINDING_ACCESS, unit),  integer(GL_IMAGE_BINDING_FORMAT, unit)};
    }
    const auto saveBlocks = [](auto& blocks, GLenum binding, GLenum start, GLenum size) {
        for (GLuint i = 0; i < blocks.size(); ++i) {
            blocks[i].buffer = integer(binding, i);
            glGetInteger64i_v(start, i, &blocks[i].offset);
            glGetInteger64i_v(size, i, &blocks[i].size);
        }
    };
    saveBlocks(storageBlocks_, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
               GL_SHADER_STORAGE_BUFFER_SIZE);
    saveBlocks(uniformBlocks_, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE);
}

// A texture of ours that the host had bound (Technique::inspect) may be another by now, and its name gone.
void HostState::restoreUnits() const {
    const auto isThere = [](GLint texture) {
        return texture != 0 && glIsTexture(GLuint(texture)) == GL_TRUE;
    };
    for (GLuint unit = 0; unit < gl::textureUnits; ++unit) {
        glBindTextureUnit(unit, 0);  // all targets
        for (const GLint texture : textureUnits_[unit].textures) {
            if (isThere(texture)) glBindTextureUnit(unit, GLuint(texture));
        }
        glBindSampler(unit, GLuint(textureUnits_[unit].sampler));
    }
    glActiveTexture(GLenum(activeTexture_));
    for (GLuint unit = 0; unit < gl::imageUnits; ++unit) {
        const ImageUnit& image = imageUnits_[unit];
        glBindImageTexture(unit, isThere(image.texture) ? GLuint(image.texture) : 0, image.level,
                           GLboolean(image.layered), image.layer, GLenum(image.access), GLenum(image.format));
    }
    const auto restoreBlocks = [](const auto& blocks, GLenum target) {
        for (GLuint i = 0; i < blocks.size(); ++i) {
            const BlockBinding& block = blocks[i];
            if (block.size == 0) {
                glBindBufferBase(target, i, GLuint(block.buffer));
            } else {
                glBindBufferRange(target, i, GLuint(block.buffer), GLintptr(block.offset),
                                  GLsizeiptr(block.size));
            }
        }
    };
    restoreBlocks(storageBlocks_, GL_SHADER_STORAGE_BUFFER);
    restoreBlocks(uniformBlocks_, GL_UNIFORM_BUFFER);
}

}  // namespace penumbra
