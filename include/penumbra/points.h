// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "penumbra/technique.h"

namespace penumbra {

/// Surface points in place of a picture: visibility where no camera looks, such as over a plan's grid.
///
///     Points points(device, positions, normals);
///     VisibilityBuffer visibility(device, points.width_px(), points.height_px());
///     technique->render({points.view(), light, casters}, visibility);   // exact, auto
///     std::vector<float> seen = points.read(visibility.texture());      // one a point
///
/// Techniques that cannot answer without a picture say so: Technique::answersAtPoints.
class PENUMBRA_API Points {
  public:
    /// Copies both to the device. Positions: metres, in the world of the light's and the casters' matrices;
    /// normals: one a position, on the side that is lit; of any length but zero. All must be finite. Points
    /// that follow each other are looked at together: it costs less where they lie near each other. Throws
    /// Error::Kind::badArgument where there is no point, more than fit into a texture of the device, or one
    /// that is not as said, which it names by its index.
    Points(Device& device, std::span<const Vec3> positions, std::span<const Vec3> normals);
    Points(Points&&) noexcept;
    Points& operator=(Points&&) noexcept;
    ~Points();

    std::size_t count() const;
    /// Of the view, and of the visibility buffer that `render` needs: room for at least `count` points.
    int width_px() const;
    int height_px() const;

    /// Of the points alone; valid while they live.
    View view() const;

    /// What a texture of the view's size holds of each point, in their order, `channels` (1 to 4) numbers a
    /// point: VisibilityBuffer::texture, or one of the host's own. Waits for the device. Throws
    /// Error::Kind::badArgument for a texture of another size.
    std::vector<float> read(std::uint32_t texture, int channels = 1) const;

    struct Internals;

  private:
    std::unique_ptr<Internals> internals_;
};

}  // namespace penumbra
