// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "penumbra/technique.h"

namespace penumbra::light_sampling {

template <typename T>
void appendBytes(std::vector<std::byte>& key, const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    key.insert(key.end(), bytes.begin(), bytes.end());
}

/// Appends everything that depth maps and receivers follow from, so that equal keys mean equal maps. False
/// where they may change unseen: a mask's texture without a revision.
bool appendInputs(std::vector<std::byte>& key, const ShadowInputs& inputs);

}  // namespace penumbra::light_sampling
