// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/light_answer.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <span>

#include "src/techniques/exact_visibility/exact_io.h"

namespace penumbra::exact_visibility {

LightAnswer::LightAnswer() : weights(sizeof(ExactWeights), "exact/weights") {
    weights.clear();
}

void LightAnswer::fit(int width_px, int height_px, gl::Format format, int cellsAlong) {
    visibility.fit(
        {.width_px = width_px, .height_px = height_px, .format = format, .label = "exact/kept visibility"});
    errorBound.fit({.width_px = width_px,
                    .height_px = height_px,
                    .format = gl::Format::r16f,
                    .label = "exact/error bound"});
    if (cellsAlong == 1) {
        cells = {};
    } else {
        cells.fit({.width_px = width_px,
                   .height_px = height_px,
                   .layers = cellsAlong * cellsAlong,
                   .format = gl::Format::rg32f,
                   .label = "exact/cells"});
        cells.clear();
    }
    tileCount = std::size_t((width_px + EXACT_TILE - 1) / EXACT_TILE) *
                std::size_t((height_px + EXACT_TILE - 1) / EXACT_TILE);
    tiles.reserve(tileCount * sizeof(TileList), "exact/tiles");
    madeAt.reserve(tileCount * sizeof(std::uint32_t), "exact/kept tiles");
}

std::size_t LightAnswer::size_bytes() const {
    const auto pixels = std::size_t(visibility.width_px()) * std::size_t(visibility.height_px());
    const std::size_t visibility_bytes = visibility.format() == gl::Format::r32f ? 4 : 8, bound_bytes = 2,
                      cell_bytes = 8;
    return pixels * (visibility_bytes + bound_bytes + cell_bytes * std::size_t(cells.layers())) +
           tiles.size_bytes() + madeAt.size_bytes() + weights.size_bytes();
}

TileCounts LightAnswer::countTiles() const {
    std::vector<TileList> lists(tileCount);
    if (tileCount > 0) tiles.read(std::as_writable_bytes(std::span(lists)));
    TileCounts counts;
    for (const TileList& list : lists) {
        const double count = double(list.plain) + double(list.special);
        counts.candidates += count;
        counts.mostCandidates = std::max(counts.mostCandidates, count);
        counts.withCandidates += count > 0 ? 1 : 0;
        counts.full += count > 0 && list.stoppedAt != EXACT_END ? 1 : 0;
    }
    return counts;
}

ErrorBounds LightAnswer::readBounds() const {
    std::vector<std::uint16_t> halves(std::size_t(errorBound.width_px()) *
                                      std::size_t(errorBound.height_px()));
    if (errorBound.name() == 0) halves.clear();
    if (!halves.empty()) errorBound.read(std::as_writable_bytes(std::span(halves)));
    ErrorBounds bounds;
    for (const std::uint16_t half : halves) {
        const double bound = glm::unpackHalf1x16(half);
        bounds.pixels += bound > 0 ? 1 : 0;
        bounds.sum += bound;
        bounds.largest = std::max(bounds.largest, bound);
    }
    return bounds;
}

}  // namespace penumbra::exact_visibility
