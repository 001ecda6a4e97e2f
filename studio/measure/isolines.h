// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra::studio {

/// Values over a lattice, row by row; a NaN is a place without one.
struct ValueGrid {
    int columns = 0, rows = 0;
    std::vector<double> values;
    double at(int column, int row) const {
        return values[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    }
};

/// A line along which the value is `level`, through places in columns and rows; its ends are equal where it
/// closes.
struct Isoline {
    double level = 0;
    std::vector<glm::dvec2> places;
};

/// All lines of the level: linear between neighbours, not through squares that lack a value.
std::vector<Isoline> isolinesOf(const ValueGrid& grid, double level);

/// Round numbers (1, 2 or 5 times a power of ten apart) strictly between `min` and `max`, about `count` of
/// them; none where both are equal or not finite.
std::vector<double> roundLevels(double min, double max, int count);

}  // namespace penumbra::studio
