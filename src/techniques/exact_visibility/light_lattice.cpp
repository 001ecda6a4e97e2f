// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/light_lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "src/techniques/exact_visibility/exact_io.h"

namespace penumbra::exact_visibility {
namespace {

constexpr int maxPerLattice = 256;

// Near the golden slope. With 0.26 to 0.42 the shadows of two-boxes, whose edges then run along the rows, had
// three times the error.
constexpr double tilt_rad = 0.6;

/// The lattice with these points of the domain, moved so that its rows and columns begin at 0.
LightLattice cut(const glm::dmat2& latticeFromUv, glm::dvec2 offset, bool disk) {
    LightLattice lattice{.latticeFromUv = latticeFromUv, .offset = offset};
    const int reach = 2 * EXACT_MAX_ROWS;
    glm::ivec2 low(reach), high(-reach);
    std::vector<glm::ivec2> points;
    for (int j = -reach; j < reach; ++j) {
        for (int i = -reach; i < reach; ++i) {
            const glm::dvec2 uv = lattice.uv(i, j);
            if (disk ? glm::dot(uv, uv) >= 1 : std::max(std::abs(uv.x), std::abs(uv.y)) >= 1) continue;
            points.emplace_back(i, j);
            low = glm::min(low, points.back());
            high = glm::max(high, points.back());
        }
    }
    lattice.offset -= glm::dvec2(low);
    if (points.empty() || high.x - low.x >= EXACT_MAX_ROWS || high.y - low.y >= EXACT_MAX_ROWS)
        return lattice;
    lattice.validRows.resize(std::size_t(high.y - low.y + 1));
    for (const glm::ivec2& p : points) lattice.validRows[std::size_t(p.y - low.y)] |= 1u << (p.x - low.x);
    return lattice;
}

std::vector<glm::dvec2> pointsOf(const LightLattice& lattice) {
    std::vector<glm::dvec2> points;
    for (std::size_t j = 0; j < lattice.validRows.size(); ++j) {
        for (int i = 0; i < 32; ++i) {
            if ((lattice.validRows[j] >> i & 1) != 0) points.push_back(lattice.uv(i, int(j)));
        }
    }
    return points;
}

/// The area of the domain, as a share of the whole, with dot(direction, uv) < distance.
double areaBelow(const glm::dvec2& direction, double distance, bool disk) {
    if (disk) {
        const double d = std::clamp(distance, -1.0, 1.0);
        return 1 - (std::acos(d) - d * std::sqrt(1 - d * d)) / glm::pi<double>();
    }
    // The sum of two uniform variables of widths 2 a and 2 b.
    const double a = std::max(std::abs(direction.x), std::abs(direction.y));
    const double b = std::max(std::min(std::abs(direction.x), std::abs(direction.y)), 1e-9);
    const auto ramp2 = [](double x) { return x > 0 ? x * x : 0.0; };
    return (ramp2(distance + a + b) - ramp2(distance + a - b) - ramp2(distance - a + b) +
            ramp2(distance - a - b)) /
           (8 * a * b);
}

/// Mean square error of the share of points on one side of a straight edge, over edges of many directions.
/// Edges along the light's axes and diagonals, which people build, are among them.
double discrepancy(const LightLattice& lattice, bool disk) {
    const std::vector<glm::dvec2> points = pointsOf(lattice);
    std::vector<double> places(points.size());
    constexpr int directions = 24;
    double worst = 0, sum = 0;
    for (int k = 0; k < directions; ++k) {
        const double angle = glm::pi<double>() * k / directions;
        const glm::dvec2 direction(std::cos(angle), std::sin(angle));
        std::ranges::transform(points, places.begin(), [&](const auto& p) { return glm::dot(direction, p); });
        std::ranges::sort(places);
        // Between neighbours the error runs from one value to the other: the mean of both squares stands for
        // it.
        double squares = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double area = areaBelow(direction, places[i], disk);
            const double before = area - double(i) / double(places.size());
            const double after = area - double(i + 1) / double(places.size());
            squares += (before * before + after * after) / 2;
        }
        sum += squares;
        worst = std::max(worst, squares);
    }
    return sum / directions + 0.5 * worst;
}

}  // namespace

glm::dvec2 LightLattice::uv(int i, int j) const {
    return glm::inverse(latticeFromUv) * (glm::dvec2(i, j) - offset);
}

std::vector<LightLattice> makeLightLattices(int samples, bool disk) {
    if (samples <= 1) return {LightLattice{.validRows = {1u}}};
    const int count = (samples + maxPerLattice - 1) / maxPerLattice;
    const int each = (samples + count - 1) / count;
    const double area = disk ? glm::pi<double>() : 4;
    const double scale = std::sqrt(each / area);

    LightLattice best;
    double bestError = std::numeric_limits<double>::infinity();
    constexpr int steps = 16;
    const glm::dmat2 latticeFromUv =
        scale * glm::dmat2(std::cos(tilt_rad), std::sin(tilt_rad), -std::sin(tilt_rad), std::cos(tilt_rad));
    for (int k = 0; k < steps * steps; ++k) {
        const LightLattice lattice =
            cut(latticeFromUv, {(k % steps + 0.5) / steps, (k / steps + 0.5) / steps}, disk);
        int points = 0;
        for (const unsigned row : lattice.validRows) points += std::popcount(row);
        if (points != each) continue;
        const double error = discrepancy(lattice, disk);
        if (error < bestError) bestError = error, best = lattice;
    }
    std::vector<LightLattice> result{best};
    // The others lie in the gaps of the first: a finer lattice together.
    for (const glm::dvec2 shift : {glm::dvec2(0.5, 0.5), glm::dvec2(0.5, 0), glm::dvec2(0, 0.5)}) {
        if (int(result.size()) < count) result.push_back(cut(best.latticeFromUv, best.offset + shift, disk));
    }
    return result;
}

}  // namespace penumbra::exact_visibility
