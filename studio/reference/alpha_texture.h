// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra::studio {

/// What a texture does outside [0, 1]; the numbers are glTF's (and OpenGL's).
enum class Wrap { repeat = 10497, mirroredRepeat = 33648, clampToEdge = 33071 };

/// A caster's holes, as scene.h's Material, Texture and Picture say it. The pixels are copied.
struct TracedAlphaMask {
    int width_px = 0, height_px = 0;       ///< 0: no texture, its alpha is 1
    std::span<const std::uint8_t> rgba{};  ///< width_px * height_px * 4, row 0 at v = 0
    Wrap wrapS = Wrap::repeat, wrapT = Wrap::repeat;
    bool linearFilter = true;  ///< between texels of the full-size picture: rays know no mipmaps
    float factor = 1;          ///< multiplies the texture's alpha
    float cutoff = 0.5f;       ///< alpha >= cutoff blocks
};

/// The alpha channel of a picture, sampled as a GPU would.
class AlphaTexture {
  public:
    /// Throws InputError if there are fewer pixels than the size says.
    explicit AlphaTexture(const TracedAlphaMask& mask);
    bool blocks(const glm::vec2& uv) const;

  private:
    float texel(int x, int y) const;

    int width_px_, height_px_;
    Wrap wrapS_, wrapT_;
    bool linearFilter_;
    float factor_, cutoff_;
    std::vector<std::uint8_t> alpha_;
};

}  // namespace penumbra::studio
