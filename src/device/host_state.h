// SPDX-License-Identifier: Apache-2.0
// Living in somebody else's context: nothing of its state is trusted, everything is put back. The list of
// what that is, for people to read, is in docs/manual/state.md; tests/host_state_test.cpp proves it.
#pragma once

#include <array>

#include "src/device/compatibility_state.h"
#include "src/gl/program_interface.h"
#include "src/gl/raster_state.h"
#include "src/gl/texture_target.h"

namespace penumbra {

/// The state in which the library's own code starts: OpenGL's defaults wherever `gl::beginPass` does not
/// state what a pass wants.
void setKnownState();

/// Remembers, at construction, all the state that the library may change; puts it back when destroyed.
class HostState {
  public:
    HostState();
    HostState(const HostState&) = delete;
    HostState& operator=(const HostState&) = delete;
    ~HostState();

  private:
    static constexpr std::size_t mostViewports = 16;
    static constexpr std::size_t mostDrawBuffers = 8;
    static constexpr std::size_t pixelStores = 16;

    struct Viewport {
        std::array<GLfloat, 4> rectangle;
        std::array<GLdouble, 2> depthRange;
        bool scissor;
    };
    struct DrawBuffer {
        std::array<GLboolean, 4> colorMask;
        bool blend;
        GLint equationRgb, equationAlpha, sourceRgb, sourceAlpha, destinationRgb, destinationAlpha;
    };
    struct TextureUnit {
        std::array<GLint, gl::textureTargets.size()> textures;
        GLint sampler;
    };
    struct ImageUnit {
        GLint texture, level, layered, layer, access, format;
    };
    struct BlockBinding {
        GLint buffer;
        GLint64 offset, size;
    };

    void saveObjects();
    void saveRaster();
    void saveUnits();
    void restoreObjects() const;
    void restoreRaster() const;
    void restoreUnits() const;

    CompatibilityState compatibility_;

    GLint program_, vertexArray_, drawFramebuffer_;
    GLint drawIndirect_, dispatchIndirect_, pixelPack_, pixelUnpack_, query_, storage_, uniform_;
    std::array<GLint, pixelStores> pixelStore_;

    std::array<bool, gl::unusedCapabilities.size()> unused_;
    bool depthTest_, depthClamp_, cull_;
    GLint cullFace_, frontFace_, depthFunction_, clipOrigin_, clipDepth_, provokingVertex_;
    std::array<GLint, 2> polygonMode_;  // compatibility contexts tell front and back apart
    GLfloat pointSize_;
    GLboolean depthMask_;
    std::array<std::array<GLint, 7>, 2> stencil_;  // front and back
    std::size_t viewportCount_, drawBufferCount_;
    std::array<Viewport, mostViewports> viewports_;
    std::array<DrawBuffer, mostDrawBuffers> drawBuffers_;

    GLint activeTexture_;
    std::array<TextureUnit, gl::textureUnits> textureUnits_;
    std::array<ImageUnit, gl::imageUnits> imageUnits_;
    std::array<BlockBinding, gl::storageBlocks> storageBlocks_;
    std::array<BlockBinding, gl::uniformBlocks> uniformBlocks_;
};

}  // namespace penumbra
