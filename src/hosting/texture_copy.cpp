// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/texture_copy.h"

namespace penumbra {

TextureCopy::TextureCopy(Device::Internals& device)
    : plain_(device.shaders, {"src/hosting/texture_copy.comp.glsl"}),
      multisampled_(device.shaders, {"src/hosting/texture_copy.comp.glsl"}, {"MULTISAMPLED"}) {}

void TextureCopy::run(const Source& source, const Target& target, const glm::ivec2& size_px) const {
    (source.multisampled ? multisampled_ : plain_).use();
    glBindTextureUnit(0, source.texture);
    glBindImageTexture(0, target.texture, 0, GL_FALSE, 0, GL_WRITE_ONLY, target.format);
    glUniform4i(0, source.corner_px.x, source.corner_px.y, target.corner_px.x, target.corner_px.y);
    glUniform2i(1, size_px.x, size_px.y);
    glUniform1i(2, source.multisampled ? source.sample : 0);
    gl::dispatchPixels(size_px.x, size_px.y);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace penumbra
