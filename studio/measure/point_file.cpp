// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "studio/errors.h"
#include "studio/measure/point_set.h"
#include "studio/measure/text_lines.h"

namespace penumbra::studio {
namespace {

constexpr std::size_t columnCount = 6;
constexpr std::array<std::string_view, columnCount> columnNames = {"x", "y", "z", "nx", "ny", "nz"};

/// The numbers of a line. Throws InputError "WHERE: ...".
std::array<double, columnCount> parseLine(std::string_view line, const std::string& where) {
    std::array<double, columnCount> numbers{};
    std::size_t column = 0;
    for (std::size_t begin = 0; begin <= line.size(); ++column) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const std::string_view field = trimmedField(line.substr(begin, end - begin));
        begin = end + 1;
        if (column >= columnCount) continue;
        const auto [rest, error] =
            std::from_chars(field.data(), field.data() + field.size(), numbers[column]);
        if (error != std::errc() || rest != field.data() + field.size()) {
            throw InputError(
                fmt::format("{}: '{}' is no number for {}", where, shortened(field), columnNames[column]));
        }
        if (!std::isfinite(numbers[column]))
            throw InputError(fmt::format("{}: {} is not finite", where, columnNames[column]));
    }
    if (column != columnCount) {
        throw InputError(
            fmt::format("{}: {} columns; a point has six, x,y,z,nx,ny,nz in metres", where, column));
    }
    return numbers;
}

bool isHeader(std::string_view line) {
    const std::string_view first = trimmedField(line.substr(0, line.find(',')));
    return first == columnNames[0] || first == "X";
}

}  // namespace

PointSet readPoints(const std::filesystem::path& file, const Scene& scene) {
    TextLines lines(file);
    const glm::dmat4 world = worldFromStated(scene);
    PointSet set;
    bool isFirst = true;
    while (const auto line = lines.next()) {
        if (line->empty() || line->front() == '#') continue;
        if (std::exchange(isFirst, false) && isHeader(*line)) continue;
        const auto [x, y, z, nx, ny, nz] = parseLine(*line, lines.where());
        const glm::dvec3 normal(nx, ny, nz);
        if (!(glm::length(normal) > 0))
            throw InputError(fmt::format("{}: the normal has no length", lines.where()));
        if (set.points.size() == mostPoints) {
            throw InputError(fmt::format("{}: more than {} points; hand them out in several files",
                                         lines.where(), mostPoints));
        }
        set.points.push_back({.posWorld = glm::dvec3(world * glm::dvec4(x, y, z, 1)),
                              .normalWorld = glm::normalize(glm::dmat3(world) * glm::normalize(normal)),
                              .row = set.rows++});
    }
    if (set.points.empty()) {
        throw InputError(
            fmt::format("{}: there is no point in it; a line has x,y,z,nx,ny,nz in metres", file.string()));
    }
    return set;
}

}  // namespace penumbra::studio
