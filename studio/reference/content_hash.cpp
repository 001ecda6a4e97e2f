// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/content_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace penumbra::studio {

std::string ContentHash::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

void ContentHasher::Delete::operator()(XXH3_state_s* state) const {
    XXH3_freeState(state);
}

ContentHasher::ContentHasher() : state_(XXH3_createState()) {
    if (state_ == nullptr || XXH3_128bits_reset(state_.get()) != XXH_OK) throw std::bad_alloc();
}

void ContentHasher::addBytes(std::span<const std::byte> bytes) {
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

ContentHash ContentHasher::hash() const {
    const XXH128_hash_t digest = XXH3_128bits_digest(state_.get());
    return {digest.high64, digest.low64};
}

}  // namespace penumbra::studio
