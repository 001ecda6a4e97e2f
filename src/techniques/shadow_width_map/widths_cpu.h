// SPDX-License-Identifier: Apache-2.0
// Shadow widths on the CPU: as published, and exactly.
#pragma once

#include <span>
#include <vector>

namespace penumbra {

/// Kirsch and Döllner 2003, section 4, "Generating Shadow Widths": sweeps over the left, right, top and
/// bottom neighbours until nothing changes any more, which for these four takes one sweep each way. `blocked`
/// is a square map of size_px * size_px texels; the result is in [0, 1], the distance by such steps to the
/// nearest texel that is not blocked, `difference` a step, at most 1.
std::vector<float> sweepShadowWidths(std::span<const bool> blocked, int size_px, float difference);

/// The Euclidean distance in texels from the middle of each square cell of cell_px * cell_px texels to the
/// silhouette: to the middle of the nearest side between a texel that is blocked and one that is not;
/// infinity where there is none. Cells begin at texel 0; the last ones may reach over the map's end. In
/// doubles, by Felzenszwalb and Huttenlocher 2012.
std::vector<float> exactShadowWidths(std::span<const bool> blocked, int size_px, int cell_px = 1);

}  // namespace penumbra
