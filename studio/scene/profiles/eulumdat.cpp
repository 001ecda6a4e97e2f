// SPDX-License-Identifier: Apache-2.0
// EULUMDAT (A. W. Stockmar, EULUMDAT - ein Leuchtendatenformat fuer den europaeischen Beleuchtungsplaner,
// 1990; extended 1998): one field a line, in Latin-1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "studio/scene/profiles/candela_checks.h"
#include "studio/scene/profiles/number_stream.h"
#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio {
namespace {

/// Numbers of the lines, counted from 1 as the format's description does.
constexpr std::size_t symmetryLine = 3, planesLine = 4, gammasLine = 6, lengthLine = 16, widthLine = 17,
                      heightLine = 18, factorLine = 24, tiltLine = 25, setsLine = 26;
constexpr std::size_t linesOfSet = 6, lumensInSet = 3, directRatios = 10, heights = 4;
constexpr int maxSets = 20;
constexpr double metresPerMillimetre = 1e-3, maxSize_mm = 1e6;

/// Which of the planes a file has the values of, by the symmetry Isym.
struct Planes {
    std::size_t first, count;
};

class EulumdatReader {
  public:
    EulumdatReader(std::string_view text, const std::string& fileName)
        : fileName_(fileName), lines_(linesOf(text)) {
        profile_.fileName = fileName;
        profile_.version = "EULUMDAT";
        profile_.text = text;
    }

    LightProfile read() {
        const int symmetry = count(symmetryLine, "the symmetry (Isym)", 0, 4);
        const std::size_t planes =
            std::size_t(count(planesLine, "the number of C planes", 1, maxProfileAngles));
        const std::size_t rows =
            std::size_t(count(gammasLine, "the number of gamma angles", 2, maxProfileAngles));
        readOpening();
        const std::size_t sets = readLamps();
        const double factor = number(factorLine, "the conversion factor") * lumens_ / 1000;
        if (factor <= 0) fail(factorLine, "the conversion factor must be positive");
        if (const double tilt = number(tiltLine, "the tilt while measuring"); tilt != 0)
            warn(tiltLine,
                 fmt::format("it was tilted by {:g} degrees while measured; values are taken as they "
                             "stand, for the luminaire that hangs straight",
                             tilt));
        const std::size_t numbersBegin = setsLine + sets * linesOfSet + directRatios;
        NumberStream numbers(fileName_, lines_, numbersBegin, Separators::blanks);
        readGrid(numbers, symmetry, planes, rows, factor);
        return std::move(profile_);
    }

  private:
    [[noreturn]] void fail(std::size_t line, const std::string& problem) const {
        failAt(fileName_, int(line), problem);
    }
    void warn(std::size_t line, const std::string& what) {
        profile_.warnings.push_back(fmt::format("{}:{}: {}", fileName_, line, what));
    }

    double number(std::size_t line, std::string_view what) const {
        if (line > lines_.size())
            fail(std::max<std::size_t>(lines_.size(), 1), fmt::format("the file ends before {}", what));
        const auto value = parseNumber(trimmed(lines_[line - 1]), true);
        if (!value) fail(line, fmt::format("{} must be a number", what));
        return *value;
    }

    int count(std::size_t line, std::string_view what, int least, int most) const {
        const double value = number(line, what);
        if (value != std::floor(value) || value < least || value > most)
            fail(line,
                 fmt::format("{} must be a whole number from {} to {}, not {:g}", what, least, most, value));
        return int(value);
    }

    double size(std::size_t line, std::string_view what) const {
        const double value_mm = number(line, what);
        if (value_mm < 0 || value_mm > maxSize_mm)
            fail(line, fmt::format("{} must be from 0 to {:g} mm, not {:g}", what, maxSize_mm, value_mm));
        return value_mm * metresPerMillimetre;
    }

    /// A width of 0 is a circle's; the length lies along C90.
    void readOpening() {
        const double length_m = size(lengthLine, "the luminous area's length");
        const double width_m = size(widthLine, "the luminous area's width");
        double height_m = 0;
        for (std::size_t i = 0; i < heights; ++i)
            height_m = std::max(height_m, size(heightLine + i, "the luminous area's height"));
        LuminousOpening& opening = profile_.opening;
        if (length_m == 0 && width_m == 0 && height_m == 0) return;
        using Shape = LuminousOpening::Shape;
        opening = {width_m == 0 ? Shape::circle : Shape::rectangle, width_m == 0 ? length_m : width_m,
                   length_m, height_m};
    }

    /// Sets of lamps are alternatives, of which the first is taken. Candela are stated for 1000 lumens of it,
    /// also where a negative number of lamps says that they were measured with the lamps in place.
    std::size_t readLamps() {
        const int sets = count(setsLine, "the number of sets of lamps", 1, maxSets);
        const double lamps = number(setsLine + 1, "the number of lamps");
        lumens_ = number(setsLine + lumensInSet, "the lumens of the set of lamps");
        if (lumens_ <= 0)
            fail(setsLine + lumensInSet, fmt::format("a set of lamps of {:g} lm gives no light", lumens_));
        if (lamps >= 0) profile_.lampLumens = lumens_;
        if (sets > 1)
            warn(setsLine,
                 fmt::format("it has {} sets of lamps, which are alternatives; the first is taken, {:g} lm",
                             sets, lumens_));
        return std::size_t(sets);
    }

    static std::optional<Planes> planesOf(int symmetry, std::size_t planes) {
        switch (symmetry) {
            case 0:
                return Planes{0, planes};
            case 1:
                return Planes{0, 1};
            case 2:
                if (planes % 2 == 0) return Planes{0, planes / 2 + 1};
                break;
            case 3:
                if (planes % 4 == 0) return Planes{3 * planes / 4, planes / 2 + 1};
                break;
            case 4:
                if (planes % 4 == 0) return Planes{0, planes / 4 + 1};
                break;
        }
        return {};
    }

    void readGrid(NumberStream& numbers, int symmetry, std::size_t planes, std::size_t rows, double factor) {
        const auto stated = planesOf(symmetry, planes);
        if (!stated)
            fail(planesLine, fmt::format("{} C planes cannot have the symmetry {} (Isym, line {})", planes,
                                         symmetry, symmetryLine));
        requireFewValues(numbers, stated->count, rows);
        CandelaGrid& grid = profile_.grid;
        const std::vector<double> all = readAngles(numbers, "a C angle", planes, 0, 360);
        grid.verticals_deg = readAngles(numbers, "a gamma angle", rows, 0, 180);
        // Isym 3 runs from C270 over C0 to C90.
        std::vector<double> own;
        for (std::size_t i = 0; i < stated->count; ++i) {
            const std::size_t at = stated->first + i;
            own.push_back(all[at % planes] + 360 * double(at / planes));
        }
        requireEnds(symmetry, own, numbers);
        setPlanes(grid, std::move(own), readCandela(numbers, stated->count * rows, factor), numbers);
        numbers.requireNoMoreNumbers();
    }

    /// That the planes of a symmetry stand where it says.
    static void requireEnds(int symmetry, const std::vector<double>& planes_deg,
                            const NumberStream& numbers) {
        constexpr std::array<std::array<double, 2>, 5> ends{{{0, 0}, {0, 0}, {0, 180}, {270, 450}, {0, 90}}};
        // All around and yet only half of it would be taken for mirrored. (Two planes are the same either
        // way.)
        if (symmetry == 0 && planes_deg.size() > 2 && planes_deg.back() - planes_deg.front() <= 180)
            numbers.fail(fmt::format("without symmetry C planes must go all around, not from {:g} to {:g}",
                                     planes_deg.front(), planes_deg.back()));
        if (symmetry < 2) return;
        const auto [first, last] = ends[std::size_t(symmetry)];
        constexpr double rounded_deg = 0.01;
        if (std::abs(planes_deg.front() - first) > rounded_deg ||
            std::abs(planes_deg.back() - last) > rounded_deg)
            numbers.fail(
                fmt::format("with the symmetry {} C planes must run from {:g} to {:g}, not from {:g} to {:g}",
                            symmetry, first, last, planes_deg.front(), planes_deg.back()));
    }

    const std::string& fileName_;
    std::vector<std::string_view> lines_;
    LightProfile profile_;
    double lumens_ = 0;
};

}  // namespace

LightProfile parseEulumdat(std::string_view text, const std::string& fileName) {
    return EulumdatReader(text, fileName).read();
}

}  // namespace penumbra::studio
