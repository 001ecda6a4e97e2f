// SPDX-License-Identifier: Apache-2.0
// What the library keeps for a visibility buffer; hosts see penumbra::VisibilityBuffer alone.
#pragma once

#include <memory>

#include "penumbra/technique.h"
#include "src/device/device_internals.h"
#include "src/gl/texture.h"

namespace penumbra {

struct VisibilityBuffer::Internals {
    std::shared_ptr<Device::Internals> device;
    gl::Texture own;   ///< or none, and
    HostTexture host;  ///< the host's
    GLenum format = 0;
    bool colored = false;
    mutable gl::WriteRecord written;

    /// Throws Error::Kind::badArgument where the buffer was moved from.
    static Internals& of(const VisibilityBuffer& buffer) { return buffer.internals(); }

    /// One with a texture of its own, as the public constructor makes it.
    static VisibilityBuffer make(Device::Internals& device, int width_px, int height_px, bool colored);

    /// Techniques write pixel (x, y) to texel (x, y), as imageOf says: anything else needs a copy.
    bool isPlain() const {
        return host.x_px == 0 && host.y_px == 0 && format == GLenum(colored ? GL_RGBA16F : GL_R32F);
    }
};

inline VisibilityBuffer::Internals& internalsOf(const VisibilityBuffer& buffer) {
    return VisibilityBuffer::Internals::of(buffer);
}

}  // namespace penumbra
