// SPDX-License-Identifier: Apache-2.0
// Shadow widths on the CPU: as published, and exactly.
#pragma once

#include <span>
#include <vector>

namespace penumbra::shadow_width_map {

/// Kirsch and Döllner 2003, section 4, "Generating Shadow Widths": sweeps over the left, right, top and
/// bottom neighbours until nothing changes any more, which for these four takes one sweep each way. `blocked`
/// is a square map of size_px * size_px texels; the result is in [0, 1], the distance by such steps to the
/// nearest texel that is not blocked, `difference` a step, at most 1.
std::vector<float> sweepShadowWidths(std::span<const bool> blocked, int size_px, float difference);

/// A silhouette as the exact mode keeps it: in each square cell of cell_px * cell_px texels one short
/// straight piece, through the middles of the sides between blocked texels and others around the blocked one
/// with such a side that is nearest to the cell's middle; rounded as edge_cells.glsl packs it. Places in
/// texels from the map's corner.
struct SilhouettePiece {
    double middleX_px, middleY_px;
    double normalX, normalY;    ///< towards what is not blocked
    double siteX_px, siteY_px;  ///< the middle, kept inside the cell
};
std::vector<SilhouettePiece> silhouettePieces(std::span<const bool> blocked, int size_px, int cell_px);

/// The distance in texels from the middle of each cell to a piece: of the pieces whose sites are nearest
/// along each column of cells, the one whose site is nearest. Infinity where there is none. Cells begin at
/// texel 0; the last ones may reach over the map's end. By a search through all of them, in doubles: what the
/// device's separable transform finds in O(1) a cell.
std::vector<float> exactShadowWidths(std::span<const bool> blocked, int size_px, int cell_px);

}  // namespace penumbra::shadow_width_map
