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

/// What one unit of an offset is, and no less than what floats of the comparison hold.
double offsetUnit(const HostDepths& depths) {
    return std::max(depths.leastDifference, std::exp2(-24.0));
}

}  // namespace

Agreement compare(const HostDepths& depths, const CasterPicture& picture, const Reading& reading) {
    return compareSome(depths, picture, reading, std::nullopt);
}

Agreement compareCaster(const HostDepths& depths, const CasterPicture& picture, const Reading& reading,
                        std::size_t caster) {
    return compareSome(depths, picture, reading, caster);
}

TwoTerms fitTwoTerms(const HostDepths& depths, const CasterPicture& picture, const Reading& reading,
                     SmallDifference kind) {
    constexpr int rounds = 3;  // each without what the one before leaves unexplained
    constexpr std::size_t enough = 64;
    const float background = reading.depth.reversed ? 0.0f : 1.0f;
    const double step = offsetUnit(depths);
    struct Pixel {
        double first, second;  // the terms
        double difference, steepest;
    };
    std::vector<Pixel> pixels;
    forEachPixel(depths, picture, reading.isUpsideDown, [&](int x, int y, float depth) {
        const auto& expected = picture.at(x, y);
        if (depth == background || !shows(expected)) return;
        const Slopes slopes = slopesAt(picture, x, y);
        if (!slopes.isInside) return;
        const double steepest = std::max(std::abs(slopes.x), std::abs(slopes.y));
        const bool isOffset = kind == SmallDifference::offset;
        pixels.push_back({isOffset ? steepest : slopes.x, isOffset ? step : slopes.y,
                          double(depth) - double(expected.depth), steepest});
    });
    TwoTerms result;
    if (pixels.size() < enough) return result;
    const auto unexplained = [&](const Pixel& pixel) {
        return std::abs(pixel.difference - result.first * pixel.first - result.second * pixel.second);
    };
    for (int round = 0; round < rounds; ++round) {
        double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
        // At first what is more than some pixels away is another surface's.
        const double reach_px = round == 0 ? 4 : 0.3;
        for (const Pixel& pixel : pixels) {
            if (unexplained(pixel) > reach_px * pixel.steepest + 64 * step) continue;
            // Each pixel weighs as one of its own steps.
            const double weight = 1 / std::pow(pixel.steepest + step, 2);
            aa += weight * pixel.first * pixel.first;
            ab += weight * pixel.first * pixel.second;
            bb += weight * pixel.second * pixel.second;
            ac += weight * pixel.first * pixel.difference;
            bc += weight * pixel.second * pixel.difference;
        }
        const double determinant = aa * bb - ab * ab;
        if (!(determinant > 1e-12 * aa * bb)) return {};
        result.first = (ac * bb - bc * ab) / determinant;
        result.second = (bc * aa - ac * ab) / determinant;
    }
    // Explained: to a fiftieth of a pixel, to what slopes between pixels differ from those of small
    // triangles, and to what depths are rounded by.
    const double allowed_px = 0.02 + (kind == SmallDifference::offset ? 0.2 * std::abs(result.first) : 0);
    const auto explained = std::ranges::count_if(pixels, [&](const Pixel& pixel) {
        return unexplained(pixel) <= allowed_px * pixel.steepest + tolerance_steps * step;
    });
    result.share = double(explained) / double(pixels.size());
    return result;
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
