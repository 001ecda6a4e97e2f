// SPDX-License-Identifier: Apache-2.0
// From what a technique gets, on the device, to what the reference gets, on the CPU.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "penumbra/technique.h"
#include "studio/reference/reference.h"

namespace penumbra::studio {

/// The surface points of a view, read back from its depth, normals (which it must have) and receiver mask, or
/// the points that it holds in place of a picture.
/// Waits for the device.
ReceiverImage readReceivers(const View& view);

/// Casters with everything that rays need, independent of the device and of the scene they come from, so that
/// another thread may use them.
class CasterCopies {
  public:
    /// Copies what is drawn, whether it casts or not; reads alpha masks back, which waits for the device.
    explicit CasterCopies(std::span<const Caster> casters);

    ReferenceScene makeScene() const;

  private:
    struct Copy {
        std::vector<glm::vec3> positions;
        std::vector<std::uint32_t> indices;
        std::vector<glm::vec2> uvs;
        std::vector<std::uint8_t> maskRgba;
        TracedCaster traced;  ///< its spans are set by makeScene
    };
    std::vector<Copy> copies_;
};

/// A light's texture, linear; nullopt for 0. Waits for the device.
std::optional<RadianceTexture> readRadianceTexture(std::uint32_t texture);

/// Puts visibility (rows from the top) into the buffer, which has its size and channels.
void writeVisibility(const Image& image, const VisibilityBuffer& out);

}  // namespace penumbra::studio
