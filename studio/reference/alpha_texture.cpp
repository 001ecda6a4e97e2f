// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/alpha_texture.h"

#include <algorithm>
#include <cmath>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

/// Texel of `index` in a row of `size` (OpenGL 4.5, table 8.20).
int wrapped(int index, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::clampToEdge:
            return std::clamp(index, 0, size - 1);
        case Wrap::mirroredRepeat: {
            const int folded = ((index % (2 * size)) + 2 * size) % (2 * size);
            return folded < size ? folded : 2 * size - 1 - folded;
        }
        case Wrap::repeat:
            break;
    }
    return ((index % size) + size) % size;
}

/// The coordinate in texels, kept within what an int holds; texture coordinates that are not finite count as
/// 0.
float inTexels(float coordinate, int size) {
    const float texels = coordinate * float(size);
    return std::isfinite(texels) ? std::clamp(texels, -1e9f, 1e9f) : 0.0f;
}

}  // namespace

AlphaTexture::AlphaTexture(const TracedAlphaMask& mask)
    : width_px_(std::max(mask.width_px, 0)),
      height_px_(std::max(mask.height_px, 0)),
      wrapS_(mask.wrapS),
      wrapT_(mask.wrapT),
      linearFilter_(mask.linearFilter),
      factor_(mask.factor),
      cutoff_(mask.cutoff),
      alpha_(std::size_t(width_px_) * height_px_) {
    if (mask.rgba.size() < 4 * alpha_.size()) {
        throw InputError("an alpha mask has fewer pixels than its size says; give width * height * 4 bytes");
    }
    for (std::size_t i = 0; i < alpha_.size(); ++i) alpha_[i] = mask.rgba[4 * i + 3];
}

float AlphaTexture::texel(int x, int y) const {
    const int column = wrapped(x, width_px_, wrapS_), row = wrapped(y, height_px_, wrapT_);
    return float(alpha_[std::size_t(row) * width_px_ + column]) / 255.0f;
}

bool AlphaTexture::blocks(const glm::vec2& uv) const {
    if (alpha_.empty()) return factor_ >= cutoff_;
    const float s = inTexels(uv.x, width_px_), t = inTexels(uv.y, height_px_);
    if (!linearFilter_) return factor_ * texel(int(std::floor(s)), int(std::floor(t))) >= cutoff_;
    const float left = std::floor(s - 0.5f), top = std::floor(t - 0.5f);
    const int x = int(left), y = int(top);
    const float right = s - 0.5f - left, below = t - 0.5f - top;
    const float alpha = std::lerp(std::lerp(texel(x, y), texel(x + 1, y), right),
                                  std::lerp(texel(x, y + 1), texel(x + 1, y + 1), right), below);
    return factor_ * alpha >= cutoff_;
}

}  // namespace penumbra::studio
