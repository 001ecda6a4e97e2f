// SPDX-License-Identifier: Apache-2.0
// IES LM-63, Standard File Format for the Electronic Transfer of Photometric Data (1986, 1991, 1995, 2002,
// 2019).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "studio/scene/profiles/candela_checks.h"
#include "studio/scene/profiles/number_stream.h"
#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio {
namespace {

constexpr double metresPerFoot = 0.3048;
constexpr int maxTiltAngles = 1000;

std::string upper(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return result;
}

/// Finds its way through one file.
class Lm63Reader {
  public:
    Lm63Reader(std::string_view text, const std::string& fileName)
        : fileName_(fileName), text_(text), lines_(linesOf(text)) {
        profile_.fileName = fileName;
        profile_.text = text;
    }

    LightProfile read(const TiltText& tiltText) {
        readVersion();
        const std::size_t tilt = findTilt();
        NumberStream numbers(fileName_, lines_, tilt + 1, Separators::blanksAndCommas);
        readTilt(tilt, numbers, tiltText);
        readCounts(numbers);
        readGrid(numbers);
        return std::move(profile_);
    }

  private:
    void warn(int line, const std::string& what) {
        profile_.warnings.push_back(fmt::format("{}:{}: {}", fileName_, line, what));
    }

    /// The first line says it since 1991. What has none is read as 1986, the only version that needs none.
    void readVersion() {
        const std::string first = lines_.empty() ? "" : upper(trimmed(lines_[0]));
        constexpr std::string_view standard = "LM-63-";
        const std::size_t at = first.find(standard);
        if (first.starts_with("IESNA91")) {
            year_ = 1991;
        } else if (first.starts_with("IES") && at != first.npos) {
            int stated = 0;
            const char* const begin = first.data() + at + standard.size();
            std::from_chars(begin, first.data() + first.size(), stated);
            if (stated < 100) stated += stated < 80 ? 2000 : 1900;
            constexpr std::array<int, 5> known{2019, 2002, 1995, 1991, 1986};
            const auto version = std::ranges::find_if(known, [&](int year) { return year <= stated; });
            year_ = version == known.end() ? known.back() : *version;
            if (year_ != stated)
                warn(1, fmt::format("there is no LM-63-{}; read as LM-63-{}", stated, year_));
        }
        profile_.version = fmt::format("LM-63-{}", year_);
    }

    /// The line that begins with TILT=, not one that speaks of it.
    std::size_t findTilt() const {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const std::string line = upper(trimmed(lines_[i]));
            if (line.starts_with("TILT") && trimmed(std::string_view(line).substr(4)).starts_with('='))
                return i;
        }
        failAt(fileName_, int(std::max<std::size_t>(lines_.size(), 1)),
               "no line begins with TILT=: this is no LM-63 file");
    }

    void readTilt(std::size_t line, NumberStream& numbers, const TiltText& tiltText) {
        const std::string_view text = lines_[line];
        const std::string_view value = trimmed(text.substr(text.find('=') + 1));
        const std::string word = upper(value);
        if (word == "NONE") return;
        if (word == "INCLUDE") return readTiltFactors(numbers);
        if (value.empty())
            failAt(fileName_, int(line + 1), "TILT= must say NONE, INCLUDE or the name of a file");
        const std::string name(value);
        const std::string other = tiltText(name, int(line + 1));
        const std::vector<std::string_view> otherLines = linesOf(other);
        // What stands in another file is in this one from now on.
        const std::size_t begin = std::size_t(text.data() - text_.data());
        profile_.text = fmt::format("{}TILT=INCLUDE\n{}\n{}", text_.substr(0, begin), other,
                                    text_.substr(begin + text.size()));
        NumberStream otherNumbers(name, otherLines, 0, Separators::blanksAndCommas);
        readTiltFactors(otherNumbers);
    }

    void readTiltFactors(NumberStream& numbers) {
        numbers.nextCount("how the lamp lies in the luminaire", 1, 3);
        const int count = numbers.nextCount("the number of tilt angles", 1, maxTiltAngles);
        const std::vector<double> angles = readAngles(numbers, "a tilt angle", std::size_t(count), -180, 180);
        for (const double angle : angles) {
            const double factor = numbers.next("a tilt factor");
            if (factor < 0) numbers.fail(fmt::format("a tilt factor must not be negative: {:g}", factor));
            profile_.tiltFactors.push_back({angle, factor});
        }
        // Candela are those of the luminaire as it hangs; what it loses counts from there.
        hanging_ = profile_.tiltFactor(0);
        if (hanging_ <= 0) numbers.fail("the tilt factor at 0 degrees must be positive");
        for (auto& point : profile_.tiltFactors) point.factor /= hanging_;
    }

    double readFactor(NumberStream& numbers, std::string_view what) {
        const double factor = numbers.next(what);
        if (factor <= 0) numbers.fail(fmt::format("{} must be positive, not {:g}", what, factor));
        return factor;
    }

    void readCounts(NumberStream& numbers) {
        const double lamps = numbers.next("the number of lamps");
        const double lumens = numbers.next("the lumens of a lamp");
        if (lumens >= 0) profile_.lampLumens = std::abs(lamps) * lumens;
        factor_ = hanging_ * readFactor(numbers, "the candela multiplier");
        verticals_ = numbers.nextCount("the number of vertical angles", 2, maxProfileAngles);
        horizontals_ = numbers.nextCount("the number of horizontal angles", 1, maxProfileAngles);
        requireFewValues(numbers, std::size_t(horizontals_), std::size_t(verticals_));
        constexpr std::array types{CandelaGrid::Type::C, CandelaGrid::Type::B, CandelaGrid::Type::A};
        profile_.grid.type =
            types[std::size_t(numbers.nextCount("the type (1: C, 2: B, 3: A)", 1, int(types.size())) - 1)];
        const double metres =
            numbers.nextCount("the unit (1: feet, 2: metres)", 1, 2) == 1 ? metresPerFoot : 1;
        std::array<double, 3> size_m{};  // width, length, height
        for (double& size : size_m) size = metres * readSize(numbers);
        OpeningReading opening = readLm63Opening(year_, size_m[0], size_m[1], size_m[2]);
        profile_.opening = opening.opening;
        if (!opening.warning.empty()) warn(numbers.line(), opening.warning);
        factor_ *= readFactor(numbers, "the ballast factor");
        readSecondFactor(numbers);
        numbers.next("the watts");
    }

    double readSize(NumberStream& numbers) {
        constexpr double largest = 1e4;  // a unit taken for another; nothing that shines is as large
        const double size = numbers.next("the luminous opening's size");
        if (std::abs(size) > largest)
            numbers.fail(fmt::format("a luminous opening cannot be {:g} long", size));
        return size;
    }

    /// 1986 and 1991: the ballast-lamp photometric factor. 1995 and 2002: for future use, 1. 2019: a code for
    /// how the file came about, whose value means no number.
    void readSecondFactor(NumberStream& numbers) {
        if (year_ < 1995) {
            factor_ *= readFactor(numbers, "the ballast-lamp photometric factor");
            return;
        }
        const double value = numbers.next("the number after the ballast factor");
        if (year_ < 2019 && value != 1)
            warn(numbers.line(),
                 fmt::format(
                     "the number after the ballast factor is {:g}, where LM-63-{} has a 1; not applied",
                     value, year_));
    }

    void readGrid(NumberStream& numbers) {
        CandelaGrid& grid = profile_.grid;
        const std::size_t rows = std::size_t(verticals_), columns = std::size_t(horizontals_);
        const bool typeC = grid.type == CandelaGrid::Type::C;
        grid.verticals_deg = readAngles(numbers, "a vertical angle", rows, typeC ? 0 : lowestVertical(),
                                        typeC ? 180 : -lowestVertical());
        std::vector<double> horizontals =
            typeC
                ? readAngles(numbers, "a horizontal angle", columns, -360, 720)
                : readAngles(numbers, "a horizontal angle", columns, lowestHorizontal(), -lowestHorizontal());
        if (!typeC && columns < 2) numbers.fail("types A and B need more than one horizontal angle");
        if (typeC && columns == 1 && horizontals[0] != 0)
            warn(numbers.line(),
                 fmt::format("its only plane stands at {:g} degrees; taken for all of them", horizontals[0]));
        std::vector<float> candela = readCandela(numbers, rows * columns, factor_);
        if (typeC) {
            setPlanes(grid, std::move(horizontals), std::move(candela), numbers);
        } else {
            grid.horizontals_deg = std::move(horizontals);
            grid.candela = std::move(candela);
        }
        numbers.requireNoMoreNumbers();
    }

    /// One angle of types A and B is a latitude, the other turns about the polar axis.
    double lowestVertical() const { return profile_.grid.type == CandelaGrid::Type::A ? -90 : -180; }
    double lowestHorizontal() const { return profile_.grid.type == CandelaGrid::Type::A ? -180 : -90; }

    const std::string& fileName_;
    std::string_view text_;
    std::vector<std::string_view> lines_;
    LightProfile profile_;
    int year_ = 1986;
    double factor_ = 1, hanging_ = 1;
    int verticals_ = 0, horizontals_ = 0;
};

}  // namespace

LightProfile parseLm63(std::string_view text, const std::string& fileName, const TiltText& tiltText) {
    return Lm63Reader(text, fileName).read(tiltText);
}

}  // namespace penumbra::studio
