// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "studio/reference/reference.h"

namespace penumbra::studio {

/// A name for everything that a trace depends on.
ContentHash traceKey(const ReferenceScene& scene, const ReceiverImage& receivers, const AreaLight& light,
                     const RadianceTexture* texture, const ReferenceOptions& options);

/// Traces kept on disk, one file each. Never stands in the way: a folder that cannot be written to disables
/// it, and a damaged file is removed, both with a warning in the log. Several processes may share a folder.
class ReferenceCache {
  public:
    /// $XDG_CACHE_HOME/penumbra, else ~/.cache/penumbra; empty where neither variable is set.
    static std::filesystem::path defaultFolder();

    /// An empty folder name disables the cache. The oldest files go when all together exceed `limit_bytes`.
    explicit ReferenceCache(std::filesystem::path folder = defaultFolder(),
                            std::uint64_t limit_bytes = std::uint64_t(2) << 30);

    /// The trace of that name as it was stored, bit for bit.
    std::optional<ReferenceResult> find(const ContentHash& key) const;
    void store(const ContentHash& key, const ReferenceResult& result);

    /// What `scene.trace` would return, from the cache if it is there.
    ReferenceResult trace(const ReferenceScene& scene, const ReceiverImage& receivers, const AreaLight& light,
                          const RadianceTexture* texture, const ReferenceOptions& options = {});

  private:
    std::filesystem::path fileOf(const ContentHash& key) const;
    void removeOldest() const;

    std::filesystem::path folder_;  // empty: disabled
    std::uint64_t limit_bytes_;
};

}  // namespace penumbra::studio
