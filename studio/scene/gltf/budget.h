// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "studio/scene/gltf/place_error.h"

namespace penumbra::studio::gltf {

/// What loading may still allocate. Charged before allocating, so that a small file cannot ask for all
/// memory.
class Budget {
  public:
    explicit Budget(std::uint64_t limit_bytes) : left_bytes_(limit_bytes) {}

    std::uint64_t left_bytes() const { return left_bytes_; }

    /// Throws PlaceError at `place` where `count` elements of `size_bytes` are more than what is left.
    void charge(std::uint64_t count, std::uint64_t size_bytes, const std::string& place) {
        if (count > left_bytes_ / size_bytes)
            throw PlaceError(place, "needs more memory than the budget for loading has left",
                             "raise the memory budget, or simplify the scene");
        left_bytes_ -= count * size_bytes;
    }

  private:
    std::uint64_t left_bytes_;
};

}  // namespace penumbra::studio::gltf
