// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/measure_arguments.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

/// "AxB" or "A-B" with whole numbers from 0; what is too large for an int is the largest one.
std::optional<std::pair<int, int>> parsePair(const std::string& text, char between) {
    std::array<int, 2> values{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto [next, error] = std::from_chars(at, end, values[i]);
        if (error == std::errc::result_out_of_range)
            values[i] = std::numeric_limits<int>::max();
        else if (error != std::errc())
            return std::nullopt;
        const bool isOver = i + 1 == values.size();
        if (values[i] < 0 || (isOver ? next != end : next == end || *next != between)) return std::nullopt;
        at = next + 1;
    }
    return std::pair(values[0], values[1]);
}

PlaneOption parsePlane(const std::string& text) {
    std::array<double, 5> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [next, error] = std::from_chars(at, end, numbers[i]);
        const bool isOver = i + 1 == numbers.size();
        if (error != std::errc() || (isOver ? next != end : next == end || *next != ',')) {
            throw UsageError(
                fmt::format("--plane '{}' is not X,Y,Z,WIDTH,DEPTH in metres, for instance "
                            "--plane=-3,0.75,-2,6,4",
                            text));
        }
        if (!std::isfinite(numbers[i])) throw InputError(fmt::format("--plane: '{}' is not finite", text));
        at = next + 1;
    }
    return {.corner = {numbers[0], numbers[1], numbers[2]}, .width_m = numbers[3], .depth_m = numbers[4]};
}

}  // namespace

void MeasureArguments::addTo(CLI::App& command) {
    scene.addSceneTo(command);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    command.add_option("--time", scene.time_s, "moment of the animation, in seconds")
        ->check(finiteWithin(-infinity, infinity, "seconds"))
        ->capture_default_str();
    command.add_option("--device", scene.device, "index from 'penumbra list devices'");

    CLI::Option* list =
        command.add_option("--points", points, "FILE.csv: x,y,z,nx,ny,nz in metres, a point a line");
    CLI::Option* cells = command.add_option("--grid", grid, "NxM: cells, whose middles are measured");
    CLI::Option* flat = command
                            .add_option("--plane", plane,
                                        "X,Y,Z,WIDTH,DEPTH in metres: a horizontal rectangle from the corner "
                                        "whose coordinates are least (--plane=-3,0.75,-2,6,4)")
                            ->needs(cells)
                            ->excludes(list);
    CLI::Option* node =
        command.add_option("--surface", surface, "NAME: the surface of the nodes of that name")
            ->needs(cells)
            ->excludes(list)
            ->excludes(flat);
    cells->excludes(list);
    list->excludes(flat)->excludes(node);

    command
        .add_option("-t,--technique", technique,
                    "NAME, or NAME:KEY=VALUE with a parameter; one that answers at points")
        ->capture_default_str();
    command.add_option("--set", settings, "KEY=VALUE: a parameter of the technique; may be repeated")
        ->take_all();
    command.add_option("--over", over,
                       "08:00-18:00[/15min]: the sun of --sun at these times of its day, in its zone");
    command.add_option("--rows", rows, "A-B: these rows of the grid, or points of the list, alone");
    command.add_option("--merge", merge, "CSV files of pieces (--rows), put together instead of measuring");
    command.add_flag("--per-light", perLight, "what each light gives, too");
    command.add_option("--timed-runs", timedRuns, "measure so many times more, and say what that costs")
        ->check(CLI::Range(1, 1000));
    command.add_flag("--json", json, "print JSON and not a table");
    command.add_option("--csv", csv, "a row a point");
    command.add_option("-o,--output", plan, "the plan: .png or .svg");
}

PointSet MeasureArguments::where(const Scene& opened, const SceneMoment& moment) const {
    if (!points.empty()) return readPoints(points, opened);
    if (plane.empty() && surface.empty())
        throw UsageError(
            "where? Give --points FILE.csv, or --plane X,Y,Z,WIDTH,DEPTH or --surface NAME with --grid NxM");
    const auto cells = parsePair(grid, 'x');
    if (!cells) throw UsageError(fmt::format("--grid '{}' is not NxM, for instance 20x15", grid));
    if (!plane.empty()) return planeGrid(parsePlane(plane), cells->first, cells->second, opened, moment);
    return surfaceGrid(surface, cells->first, cells->second, opened, moment);
}

std::optional<std::pair<int, int>> MeasureArguments::wantedRows() const {
    if (rows.empty()) return std::nullopt;
    if (const auto pair = parsePair(rows, '-')) return pair;
    throw UsageError(fmt::format("--rows '{}' is not FIRST-LAST, for instance 1-25", rows));
}

}  // namespace penumbra::studio
