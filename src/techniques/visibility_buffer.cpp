// SPDX-License-Identifier: Apache-2.0
#include "penumbra/technique.h"
#include "src/device_internals.h"
#include "src/gl/texture.h"

namespace penumbra {

struct VisibilityBuffer::State {
    gl::Texture texture;
    bool colored;
};

VisibilityBuffer::VisibilityBuffer(Device& device, int width_px, int height_px, bool colored) {
    const int limit = device.maxTextureSize_px();
    if (width_px < 1 || height_px < 1 || width_px > limit || height_px > limit) {
        throw Error(Error::Kind::badArgument, "VisibilityBuffer: sizes must lie in 1.." +
                                                  std::to_string(limit) + ", not " +
                                                  std::to_string(width_px) + "x" + std::to_string(height_px));
    }
    state_ = std::make_unique<State>(State{gl::Texture({.width_px = width_px,
                                                        .height_px = height_px,
                                                        .format = GLenum(colored ? GL_RGBA16F : GL_R32F),
                                                        .label = "visibility"}),
                                           colored});
}

VisibilityBuffer::VisibilityBuffer(VisibilityBuffer&&) noexcept = default;
VisibilityBuffer& VisibilityBuffer::operator=(VisibilityBuffer&&) noexcept = default;
VisibilityBuffer::~VisibilityBuffer() = default;

int VisibilityBuffer::width_px() const {
    return state_->texture.width_px();
}
int VisibilityBuffer::height_px() const {
    return state_->texture.height_px();
}
bool VisibilityBuffer::colored() const {
    return state_->colored;
}
std::uint32_t VisibilityBuffer::texture() const {
    return state_->texture.name();
}

}  // namespace penumbra
