// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>

struct XXH3_state_s;

namespace penumbra::studio {

/// 128 bits that name some content (XXH3). Not cryptographic: it tells pictures apart, it withstands no
/// attack.
struct ContentHash {
    std::uint64_t high = 0, low = 0;
    bool operator==(const ContentHash&) const = default;
    std::string hex() const;  ///< 32 lower-case digits
};

/// Hashes what is added, in order. Arrays count with their length, so that {1} {2, 3} differs from {1, 2}
/// {3}.
class ContentHasher {
  public:
    ContentHasher();
    void addBytes(std::span<const std::byte> bytes);

    template <typename T>
    requires std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>
    void add(T value) { addBytes(std::as_bytes(std::span(&value, 1))); }

    template <std::ranges::contiguous_range Range>
    void addArray(const Range& values) {
        add(std::uint64_t(std::ranges::size(values)));
        addBytes(std::as_bytes(std::span(std::ranges::data(values), std::ranges::size(values))));
    }

    ContentHash hash() const;

  private:
    struct Delete {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, Delete> state_;
};

}  // namespace penumbra::studio
