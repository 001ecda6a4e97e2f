// SPDX-License-Identifier: Apache-2.0
// What the library keeps for a visibility buffer; hosts see penumbra::VisibilityBuffer alone.
#pragma once

#include <memory>

#include "penumbra/technique.h"
#include "src/gl/texture.h"

namespace penumbra {

struct VisibilityBuffer::Internals {
    Device::Internals* device = nullptr;
    gl::Texture own;   ///< or none, and
    HostTexture host;  ///< the host's
    GLenum format = 0;
    bool colored = false;
    mutable gl::WriteRecord written;

    /// Techniques write pixel (x, y) to texel (x, y), as bindVisibility says: anything else needs a copy.
    bool isPlain() const {
        return host.x_px == 0 && host.y_px == 0 && format == GLenum(colored ? GL_RGBA16F : GL_R32F);
    }
};

}  // namespace penumbra
