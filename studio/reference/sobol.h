// SPDX-License-Identifier: Apache-2.0
// Sample points in the unit square: the first two dimensions of Sobol's sequence, a (0, 2)-sequence, with
// Owen's scrambling, done by hashing as in Brent Burley, "Practical Hash-based Owen Scrambling" (JCGT 9(4),
// 2020).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra::studio {

inline std::uint32_t reverseBits(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00FF00FFu) << 8) | ((x & 0xFF00FF00u) >> 8);
    x = ((x & 0x0F0F0F0Fu) << 4) | ((x & 0xF0F0F0F0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xCCCCCCCCu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xAAAAAAAAu) >> 1);
}

/// Spreads every bit of `x` over all bits of the result.
inline std::uint32_t hashBits(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x21F0AAADu;
    x = (x ^ (x >> 15)) * 0xD35A2D97u;
    return x ^ (x >> 15);
}

/// Owen's scrambling of a number given, and returned, with its bits reversed: each bit is flipped or not,
/// depending on the seed and on the bits below it, as multiplication by an even number depends on lower bits
/// only (Burley, section 3).
inline std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    return x ^ (x * 0x8D22F6E6u);
}

/// The first points of the sequence, from which any number of independent scramblings are made.
class SobolPoints {
  public:
    explicit SobolPoints(int count) {
        for (std::uint32_t i = 0; i < std::uint32_t(count); ++i) {
            // The second dimension's direction numbers v_k follow from v_{k+1} = v_k ^ (v_k >> 1) (Pascal's
            // triangle mod 2).
            std::uint32_t y = 0;
            for (std::uint32_t bits = i, v = 0x80000000u; bits != 0; bits >>= 1, v ^= v >> 1) {
                if (bits & 1) y ^= v;
            }
            yReversed_.push_back(reverseBits(y));
        }
    }
    int count() const { return int(yReversed_.size()); }

    /// Point `index` of the scrambling `seed`, in [0, 1)^2. The first dimension of the sequence is its index,
    /// reversed.
    glm::vec2 scrambled(int index, std::uint32_t seed) const {
        return {fraction(scrambleReversed(std::uint32_t(index), hashBits(seed))),
                fraction(scrambleReversed(yReversed_[std::size_t(index)], hashBits(seed ^ 0x68BC21EBu)))};
    }

  private:
    static float fraction(std::uint32_t reversed) { return float(reverseBits(reversed) >> 8) * 0x1p-24f; }

    std::vector<std::uint32_t> yReversed_;
};

}  // namespace penumbra::studio
