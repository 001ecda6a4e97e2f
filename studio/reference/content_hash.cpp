// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/content_hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace penumbra::studio {
namespace {

// Odd multipliers with bits spread evenly; any such do.
constexpr std::uint64_t multiplierA = 0x87C37B91114253D5u, multiplierB = 0x4CF5AD432745937Fu;

/// Every bit of the input reaches every bit of the result (two rounds of xor-shift and multiply).
std::uint64_t avalanche(std::uint64_t x) {
    x = (x ^ (x >> 32)) * multiplierA;
    x = (x ^ (x >> 29)) * multiplierB;
    return x ^ (x >> 32);
}

}  // namespace

std::string ContentHash::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

// Each step is a bijection of the state for a given word and of the word for a given state: two contents that
// differ in one word never collide there, and the two lanes multiply differently.
void ContentHasher::mix(std::uint64_t word) {
    a_ = std::rotl(a_ ^ (word * multiplierA), 31) * multiplierB;
    b_ = std::rotl(b_ + word, 27) * multiplierA + a_;
}

void ContentHasher::addBytes(std::span<const std::byte> bytes) {
    while (bytes.size() >= 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), 8);
        mix(word);
        bytes = bytes.subspan(8);
    }
    if (bytes.empty()) return;
    std::uint64_t rest = std::uint64_t(bytes.size()) << 56;
    std::memcpy(&rest, bytes.data(), bytes.size());
    mix(rest);
}

ContentHash ContentHasher::hash() const {
    return {avalanche(a_ ^ std::rotl(b_, 17)), avalanche(b_ + multiplierB)};
}

}  // namespace penumbra::studio
