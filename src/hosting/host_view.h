// SPDX-License-Identifier: Apache-2.0
// A host's view comes in many forms; techniques know one: single-sampled textures of the picture's size.
#pragma once

#include <array>

#include "penumbra/view.h"
#include "src/gl/framebuffer.h"
#include "src/gl/texture.h"
#include "src/hosting/caster_picture.h"
#include "src/hosting/offset_undoing.h"
#include "src/hosting/smooth_surface.h"
#include "src/hosting/texture_copy.h"

namespace penumbra {

/// Makes a texture of the host's readable with texelFetch while it lives, whatever its sampling parameters
/// say of comparison, stencil, order of channels or missing levels.
class ReadableTexture {
  public:
    explicit ReadableTexture(GLuint texture);
    ReadableTexture(const ReadableTexture&) = delete;
    ReadableTexture& operator=(const ReadableTexture&) = delete;
    ~ReadableTexture();

  private:
    struct Parameter {
        enum class Of { all, singleSamples, compatibilityContexts };
        GLenum name;
        GLint needed;
        Of of = Of::all;  ///< where it exists
        GLint found = 0;
    };
    GLuint texture_;
    std::array<Parameter, 8> parameters_;
};

class HostView {
  public:
    explicit HostView(Device::Internals& device) : device_(device) {}

    /// The view in the form that techniques know, copied only where it has to be. It must pass
    /// `checkFrame`, and its textures be readable. `casters`, of which there may be none, are what tells a
    /// polygon offset's slopes where there are no normals.
    View prepare(const View& view, std::span<const Caster> casters);

  private:
    GLuint copied(GLuint texture, gl::Texture& copy, gl::Format format, const View& view);
    glm::dvec2 samplePlace(const View& view);
    const CasterPainter& paint(std::span<const Caster> casters, const View& view, const Mat4& clipFromView);

    Device::Internals& device_;
    std::optional<TextureCopy> copy_;  ///< most hosts never need it
    std::optional<OffsetUndoing> offsetUndoing_;
    std::optional<CasterPainter> casterPainter_;
    std::optional<SmoothSurface> smoothSurface_;
    gl::Texture depth_, normals_, shadingNormals_, receivers_;
    gl::Handle<gl::deleteFramebuffer> samples_;
};

}  // namespace penumbra
