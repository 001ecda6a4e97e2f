// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/depth_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace penumbra {
namespace {

/// Depths that lie nearer to each other than this share of what one pixel's step changes are the same.
constexpr double tolerance_px = 0.3;
/// And so are those that differ by a few roundings.
constexpr double tolerance_steps = 8;

bool shows(const CasterPicture::Pixel& pixel) {
    return pixel.caster >= 0;
}

/// Slopes of the expected depth over the picture, a pixel's step; false at the edges of things, where two
/// neighbours are of different casters or bend away from each other.
struct Slopes {
    double x = 0, y = 0;
    bool isInside = false;
};
Slopes slopesAt(const CasterPicture& picture, int x, int y) {
    if (x < 1 || y < 1 || x + 1 >= picture.width_px || y + 1 >= picture.height_px) return {};
    const auto& here = picture.at(x, y);
    for (const auto& neighbor :
         {picture.at(x - 1, y), picture.at(x + 1, y), picture.at(x, y - 1), picture.at(x, y + 1)}) {
        if (neighbor.caster != here.caster) return {};
    }
    const double left = here.depth - picture.at(x - 1, y).depth,
                 right = picture.at(x + 1, y).depth - here.depth;
    const double down = here.depth - picture.at(x, y - 1).depth, up = picture.at(x, y + 1).depth - here.depth;
    Slopes slopes{0.5 * (left + right), 0.5 * (down + up), true};
    // A crease: where one side is twice as steep as the other and more.
    const auto bends = [](double before, double after) {
        return std::abs(after - before) > 0.5 * std::max(std::abs(after), std::abs(before));
    };
    slopes.isInside = !bends(left, right) || !bends(down, up);
    return slopes;
}

template <typename Visit>
void forEachPixel(const HostDepths& depths, const CasterPicture& picture, bool isUpsideDown, Visit visit) {
    for (int y = 0; y < picture.height_px; ++y) {
        const int row = isUpsideDown ? picture.height_px - 1 - y : y;
        for (int x = 0; x < picture.width_px; ++x) {
            visit(x, y, depths.values[std::size_t(row) * std::size_t(picture.width_px) + std::size_t(x)]);
        }
    }
}

Agreement compareSome(const HostDepths& depths, const CasterPicture& picture, const Reading& reading,
                      std::optional<std::size_t> caster) {
    Agreement result;
    const float background = reading.depth.reversed ? 0.0f : 1.0f;
    const double steps = tolerance_steps * depths.leastDifference;
    forEachPixel(depths, picture, reading.isUpsideDown, [&](int x, int y, float depth) {
        const auto& expected = picture.at(x, y);
        const bool hasSurface = depth != background, hasCaster = shows(expected);
        if (!hasSurface && !hasCaster) return;
        if (caster && !(hasCaster && std::size_t(expected.caster) == *caster)) return;
        ++result.surfaces;
        if (hasSurface && hasCaster) {
            const Slopes slopes = slopesAt(picture, x, y);
            const double allowed = tolerance_px * (std::abs(slopes.x) + std::abs(slopes.y)) + steps;
            if (std::abs(double(depth) - double(expected.depth)) <= allowed) {
                ++result.same;
                return;
            }
        }
        // Edges: not where the four neighbours are in the same case.
        bool isEdge = x < 1 || y < 1 || x + 1 >= picture.width_px || y + 1 >= picture.height_px;
        if (!isEdge) {
            for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
                isEdge |= picture.at(x + dx, y + dy).caster != expected.caster;
        }
        if (isEdge) {
            ++result.same;
        } else if (hasSurface && (!hasCaster || (depth > expected.depth) == reading.depth.reversed)) {
            ++result.missing;
        } else {
            ++result.extra;
        }
    });
    return result;
}

/// Solves the normal equations of `Size` unknowns; false where they depend on each other.
template <std::size_t Size>
bool solve(std::array<std::array<double, Size + 1>, Size>& rows) {
    for (std::size_t i = 0; i < Size; ++i) {
        std::size_t best = i;
        for (std::size_t k = i + 1; k < Size; ++k) {
            if (std::abs(rows[k][i]) > std::abs(rows[best][i])) best = k;
        }
        std::swap(rows[i], rows[best]);
        if (!(std::abs(rows[i][i]) > 1e-9)) return false;
        for (std::size_t k = 0; k < Size; ++k) {
            if (k == i) continue;
            const double factor = rows[k][i] / rows[i][i];
            for (std::size_t j = i; j <= Size; ++j) rows[k][j] -= factor * rows[i][j];
        }
    }
    for (std::size_t i = 0; i < Size; ++i) rows[i][Size] /= rows[i][i];
    return true;
}

}  // namespace

Agreement compare(const HostDepths& depths, const CasterPicture& picture, const Reading& reading) {
    return compareSome(depths, picture, reading, std::nullopt);
}

Agreement compareCaster(const HostDepths& depths, const CasterPicture& picture, const Reading& reading,
                        std::size_t caster) {
    return compareSome(depths, picture, reading, caster);
}

SmallDifferences fitSmallDifferences(const HostDepths& depths, const CasterPicture& picture,
                                     const Reading& reading) {
    constexpr std::size_t unknowns = 4;
    constexpr double farthest_px = 4;  // differences larger than such a step are another surface's
    std::array<std::array<double, unknowns + 1>, unknowns> rows{};
    std::array<double, unknowns> scale{};
    std::size_t count = 0;
    const float background = reading.depth.reversed ? 0.0f : 1.0f;
    const double step = depths.leastDifference;
    const auto visitAll = [&](auto use) {
        forEachPixel(depths, picture, reading.isUpsideDown, [&](int x, int y, float depth) {
            const auto& expected = picture.at(x, y);
            if (depth == background || !shows(expected)) return;
            const Slopes slopes = slopesAt(picture, x, y);
            if (!slopes.isInside) return;
            const double difference = double(depth) - double(expected.depth);
            const double steepest = std::max(std::abs(slopes.x), std::abs(slopes.y));
            if (std::abs(difference) > farthest_px * steepest + 64 * step) return;
            use(std::array<double, unknowns>{steepest, step, slopes.x, slopes.y}, difference);
        });
    };
    visitAll([&](const std::array<double, unknowns>& terms, double) {
        ++count;
        for (std::size_t i = 0; i < unknowns; ++i) scale[i] = std::max(scale[i], std::abs(terms[i]));
    });
    SmallDifferences result;
    constexpr std::size_t enough = 64;
    if (count < enough) return result;
    for (double& s : scale) s = s > 0 ? s : 1;
    // In units of the largest, so that no term drowns; each pixel weighs as one of its own steps.
    visitAll([&](const std::array<double, unknowns>& terms, double difference) {
        const double weight = 1 / std::pow(terms[0] + step, 2);
        for (std::size_t i = 0; i < unknowns; ++i) {
            for (std::size_t j = 0; j < unknowns; ++j)
                rows[i][j] += weight * terms[i] * terms[j] * scale[0] * scale[0] / (scale[i] * scale[j]);
            rows[i][unknowns] += weight * terms[i] * difference * scale[0] / scale[i];
        }
    });
    for (auto& row : rows) {
        for (double& value : row) value /= double(count);
    }
    if (!solve<unknowns>(rows)) return result;
    std::array<double, unknowns> values{};
    for (std::size_t i = 0; i < unknowns; ++i) values[i] = rows[i][unknowns] * scale[0] / scale[i];
    return {values[0], values[1], values[2], values[3], true};
}

DepthLine fitDepthLine(const HostDepths& depths, const CasterPicture& picture) {
    std::vector<std::pair<double, double>> points;
    forEachPixel(depths, picture, false, [&](int x, int y, float depth) {
        const auto& expected = picture.at(x, y);
        if (depth != 0 && depth != 1 && shows(expected) && slopesAt(picture, x, y).isInside)
            points.emplace_back(expected.depth, depth);
    });
    DepthLine line;
    constexpr std::size_t enough = 64;
    if (points.size() < enough) return line;
    // Through the medians of the points' lower and upper thirds (Tukey's resistant line): a few casters that
    // are elsewhere do not turn it.
    std::ranges::sort(points);
    const std::size_t third = points.size() / 3;
    const auto medianOf = [](std::span<const std::pair<double, double>> part, auto member) {
        std::vector<double> values;
        for (const auto& point : part) values.push_back(point.*member);
        std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
        return values[values.size() / 2];
    };
    using Point = std::pair<double, double>;
    const std::span<const Point> all(points);
    const double x0 = medianOf(all.first(third), &Point::first),
                 y0 = medianOf(all.first(third), &Point::second);
    const double x1 = medianOf(all.last(third), &Point::first),
                 y1 = medianOf(all.last(third), &Point::second);
    if (x1 <= x0) return line;
    line.slope = (y1 - y0) / (x1 - x0);
    line.offset = y0 - line.slope * x0;
    const double allowed = 0.002 * std::abs(y1 - y0) + tolerance_steps * depths.leastDifference;
    const auto on = std::ranges::count_if(points, [&](const Point& point) {
        return std::abs(line.slope * point.first + line.offset - point.second) <= allowed;
    });
    line.share = double(on) / double(points.size());
    return line;
}

}  // namespace penumbra
