// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/candela_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio {
namespace {

/// Angles in files are rounded to this or better.
constexpr double roundedAngle_deg = 0.01;

bool alike(double a_deg, double b_deg) {
    return std::abs(a_deg - b_deg) <= roundedAngle_deg;
}

}  // namespace

std::vector<double> readAngles(NumberStream& numbers, std::string_view what, std::size_t count, double least,
                               double most) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = numbers.next(what);
        if (angle < least || angle > most)
            numbers.fail(
                fmt::format("{} must lie from {:g} to {:g} degrees, not at {:g}", what, least, most, angle));
        if (!angles.empty() && angle <= angles.back())
            numbers.fail(fmt::format("{} of {:g} follows one of {:g}: angles must increase", what, angle,
                                     angles.back()));
        angles.push_back(angle);
    }
    return angles;
}

std::vector<float> readCandela(NumberStream& numbers, std::size_t count, double factor) {
    std::vector<float> candela;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = numbers.next("a candela value");
        if (value < 0) numbers.fail(fmt::format("candela must not be negative: {:g}", value));
        if (value * factor > std::numeric_limits<float>::max())
            numbers.fail(fmt::format("{:g} times the factor {:g} is too many candela", value, factor));
        candela.push_back(float(value * factor));
    }
    return candela;
}

void requireFewValues(const NumberStream& numbers, std::size_t horizontals, std::size_t verticals) {
    if (horizontals * verticals > maxProfileValues)
        numbers.fail(fmt::format("{} x {} candela values are more than the {} that are read", horizontals,
                                 verticals, maxProfileValues));
}

void setPlanes(CandelaGrid& grid, std::vector<double> planes_deg, std::vector<float> values,
               const NumberStream& numbers) {
    const double first = planes_deg.front(), span = planes_deg.back() - first;
    const std::size_t rows = grid.verticals_deg.size();
    grid.firstPlane_deg = first;
    for (double& plane : planes_deg) plane -= first;
    if (planes_deg.size() > 1 && !alike(span, 90) && !alike(span, 180) && !alike(span, 360)) {
        // A whole turn whose last plane, that of 360 degrees, is not repeated.
        double widest = 0;
        for (std::size_t i = 1; i < planes_deg.size(); ++i)
            widest = std::max(widest, planes_deg[i] - planes_deg[i - 1]);
        if (span < 180 || span > 360 || 360 - span > widest + roundedAngle_deg)
            numbers.fail(fmt::format(
                "C planes from {:g} to {:g} are no symmetry that the format knows: one plane, a quarter, a "
                "half or a whole turn",
                first, first + span));
        planes_deg.push_back(360);
        values.insert(values.end(), values.begin(), values.begin() + std::ptrdiff_t(rows));
    } else if (planes_deg.size() > 1) {
        planes_deg.back() = std::round(span / 90) * 90;
        // Half or quarter turns are mirrored at their ends, which must be where a luminaire has its axes.
        if (planes_deg.back() < 360 && !alike(std::remainder(first, 90), 0))
            numbers.fail(fmt::format(
                "C planes from {:g} to {:g} cannot be mirrored: they must begin at a multiple of 90 degrees",
                first, first + span));
        if (planes_deg.back() < 360) grid.firstPlane_deg = std::round(first / 90) * 90;
    }
    grid.horizontals_deg = std::move(planes_deg);
    grid.candela = std::move(values);
}

}  // namespace penumbra::studio
