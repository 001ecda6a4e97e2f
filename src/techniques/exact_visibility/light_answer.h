// SPDX-License-Identifier: Apache-2.0
// The last answer for a light, and what it was made from: what could not have changed since is not looked for
// again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/gl/buffer.h"
#include "src/gl/texture.h"

namespace penumbra::exact_visibility {

/// What candidates there are.
struct TileCounts {
    double candidates = 0, withCandidates = 0, mostCandidates = 0, full = 0;
};
struct ErrorBounds {
    double pixels = 0;  ///< with a bound above 0
    double sum = 0, largest = 0;
};

struct LightAnswer {
    std::vector<std::byte> key;        ///< of the light and the options; empty: there is no answer
    std::uint64_t casterRevision = 0;  ///< CasterSoup's
    gl::Texture visibility;            ///< of tiles that `madeAt` names
    gl::Texture errorBound;            ///< of all
    gl::Texture cells;   ///< of a rectangle, a layer each, where they were asked for (cells.glsl)
    gl::Buffer tiles;    ///< a TileList each
    gl::Buffer madeAt;   ///< their revisions, plus 1; 0: there is no answer
    gl::Buffer weights;  ///< of a textured light's samples, and when they changed
    std::size_t tileCount = 0;

    LightAnswer();
    /// `cellsAlong` cells along each side of the light; none where it is 1.
    void fit(int width_px, int height_px, gl::Format format, int cellsAlong);
    std::size_t size_bytes() const;
    /// These wait for the device.
    TileCounts countTiles() const;
    ErrorBounds readBounds() const;
};

}  // namespace penumbra::exact_visibility
