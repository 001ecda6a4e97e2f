// SPDX-License-Identifier: Apache-2.0
// What something was made from, as bytes: equal keys mean that it would come out equal again, and can be
// kept.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "penumbra/technique.h"

namespace penumbra {

template <typename T>
void appendBytes(std::vector<std::byte>& key, const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    key.insert(key.end(), bytes.begin(), bytes.end());
}

/// The camera and how its depths are to be read; not what is in the textures.
void appendView(std::vector<std::byte>& key, const View& view);

/// Everything but what is in the radiance texture.
void appendLight(std::vector<std::byte>& key, const AreaLight& light);

/// Appends everything that depth maps and receivers follow from, so that equal keys mean equal maps. False
/// where they may change unseen: a mask's texture without a revision.
bool appendInputs(std::vector<std::byte>& key, const ShadowInputs& inputs);

}  // namespace penumbra
