// SPDX-License-Identifier: Apache-2.0
// Marching squares (after Lorensen and Cline 1987, in the plane); squares with two opposite corners above are
// cut as their mean says.
#include "studio/measure/isolines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace penumbra::studio {
namespace {

/// A side of a square: from a lattice place along columns (0) or rows (1).
struct Side {
    int column = 0, row = 0, along = 0;
    auto operator<=>(const Side&) const = default;
};

using Segment = std::array<Side, 2>;

/// Between its two places, where the level is.
glm::dvec2 placeOn(const Side& side, const ValueGrid& grid, double level) {
    const int column = side.column + (side.along == 0), row = side.row + (side.along == 1);
    const double from = grid.at(side.column, side.row), to = grid.at(column, row);
    const double share = (level - from) / (to - from);
    return glm::mix(glm::dvec2(side.column, side.row), glm::dvec2(column, row), share);
}

void addSegments(const ValueGrid& grid, int column, int row, double level, std::vector<Segment>& segments) {
    const std::array<double, 4> corners = {grid.at(column, row), grid.at(column + 1, row),
                                           grid.at(column + 1, row + 1), grid.at(column, row + 1)};
    if (std::ranges::any_of(corners, [](double value) { return !std::isfinite(value); })) return;
    const std::array<Side, 4> sides = {Side{column, row, 0}, Side{column + 1, row, 1},
                                       Side{column, row + 1, 0}, Side{column, row, 1}};
    // Sides where the corners at both ends differ, in turn around the square.
    std::vector<Side> cut;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if ((corners[i] > level) != (corners[(i + 1) % 4] > level)) cut.push_back(sides[i]);
    }
    if (cut.size() == 2) segments.push_back({cut[0], cut[1]});
    if (cut.size() < 4) return;
    const double mean = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    // The corner between sides 3 and 0 is alone where the middle is on the other side than it.
    const bool isFirstAlone = (corners[0] > level) != (mean > level);
    segments.push_back({cut[0], cut[isFirstAlone ? 3 : 1]});
    segments.push_back({cut[2], cut[isFirstAlone ? 1 : 3]});
}

/// Joins segments that share a side.
class Chains {
  public:
    explicit Chains(const std::vector<Segment>& segments) : segments_(segments), used_(segments.size()) {
        for (std::size_t i = 0; i < segments.size(); ++i) {
            for (const Side& side : segments[i]) at_[side].push_back(i);
        }
    }

    std::optional<std::vector<Side>> next() {
        while (first_ < segments_.size() && used_[first_]) ++first_;
        if (first_ == segments_.size()) return std::nullopt;
        used_[first_] = true;
        std::vector<Side> chain = {segments_[first_][0], segments_[first_][1]};
        extend(chain);
        std::ranges::reverse(chain);
        extend(chain);
        return chain;
    }

  private:
    void extend(std::vector<Side>& chain) {
        for (bool grows = true; grows;) {
            grows = false;
            for (const std::size_t i : at_[chain.back()]) {
                if (used_[i]) continue;
                used_[i] = true;
                chain.push_back(segments_[i][0] == chain.back() ? segments_[i][1] : segments_[i][0]);
                grows = true;
                break;
            }
        }
    }

    const std::vector<Segment>& segments_;
    std::vector<bool> used_;
    std::map<Side, std::vector<std::size_t>> at_;
    std::size_t first_ = 0;
};

}  // namespace

std::vector<Isoline> isolinesOf(const ValueGrid& grid, double level) {
    std::vector<Segment> segments;
    for (int row = 0; row + 1 < grid.rows; ++row) {
        for (int column = 0; column + 1 < grid.columns; ++column)
            addSegments(grid, column, row, level, segments);
    }
    std::vector<Isoline> lines;
    Chains chains(segments);
    while (const auto chain = chains.next()) {
        Isoline& line = lines.emplace_back();
        line.level = level;
        for (const Side& side : *chain) line.places.push_back(placeOn(side, grid, level));
    }
    return lines;
}

std::vector<double> roundLevels(double min, double max, int count) {
    std::vector<double> levels;
    if (!(max > min) || !std::isfinite(max - min)) return levels;
    const double wanted = (max - min) / count;
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double digit = wanted / decade;
    const double step = decade * (digit > 5 ? 10 : digit > 2 ? 5 : digit > 1 ? 2 : 1);
    for (double i = std::floor(min / step) + 1; i * step < max; ++i) levels.push_back(i * step);
    return levels;
}

}  // namespace penumbra::studio
