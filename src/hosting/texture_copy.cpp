// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/texture_copy.h"

#include "src/gl/pass.h"
#include "src/hosting/texture_copy_io.h"

namespace penumbra {

TextureCopy::TextureCopy(Device::Internals& device)
    : plain_(device.shaders, {"src/hosting/texture_copy.comp.glsl"}),
      multisampled_(device.shaders, {"src/hosting/texture_copy.comp.glsl"}, {"MULTISAMPLED"}) {}

void TextureCopy::run(const Source& source, const Target& target, const glm::ivec2& size_px) const {
    gl::Pass(source.multisampled ? multisampled_ : plain_)
        .constants(TextureCopyConstants{.sourceCorner_px = source.corner_px,
                                        .targetCorner_px = target.corner_px,
                                        .size_px = size_px,
                                        .lookedAt = source.multisampled ? source.sample : 0,
                                        .isGray = source.isGray})
        .bind("source", source.texture)
        .bind("target", target.texture)
        .dispatchPixels(size_px.x, size_px.y);
}

}  // namespace penumbra
