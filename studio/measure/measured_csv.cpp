// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <unordered_map>

#include "studio/errors.h"
#include "studio/measure/measured_files.h"
#include "studio/measure/measured_places.h"
#include "studio/measure/text_lines.h"

namespace penumbra::studio {
namespace {

/// As RFC 4180 has it.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == text.npos) return text;
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"') result += '"';
        result += c == '\n' || c == '\r' ? ' ' : c;
    }
    return result + "\"";
}

std::vector<std::string> fieldsOf(std::string_view line) {
    std::vector<std::string> fields(1);
    bool isQuoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && isQuoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += line[++i];
        } else if (c == '"') {
            isQuoted = !isQuoted;
        } else if (c == ',' && !isQuoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

std::string headerOf(const Measurement& measurement) {
    std::string header = "x,y,z,nx,ny,nz,lux,bound,inside";
    for (const Measurement::OfLight& light : measurement.lights)
        header += "," + quoted("lux of " + light.light);
    if (!measurement.times.empty()) header += ",sun_hours";
    for (const Measurement::OfTime& time : measurement.times) header += ",lux at " + time.moment.clock;
    return header;
}

/// x,y,z,nx,ny,nz
std::string placeText(const StatedPlace& place) {
    const auto& [p, n] = place;
    return fmt::format("{:.12g},{:.12g},{:.12g},{:.9g},{:.9g},{:.9g}", p.x, p.y, p.z, n.x, n.y, n.z);
}

/// The numbers of a point, in the order of the header, to be written or read.
template <typename Of, typename Visit>
void forEachNumber(Of& measurement, std::size_t point, const Visit& visit) {
    for (auto& light : measurement.lights) visit(light.lux[point]);
    if (!measurement.times.empty()) visit(measurement.sunHours[point]);
    for (auto& time : measurement.times) visit(time.lux[point]);
}

/// Reads a row's numbers into a measurement.
class RowReader {
  public:
    RowReader(const std::vector<std::string>& fields, std::size_t first, std::string where)
        : fields_(fields), next_(first), where_(std::move(where)) {}

    void read(float& value) {
        const std::string& field = fields_[next_++];
        if (field.empty()) return;
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
        if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
            throw InputError(fmt::format("{}: '{}' is no number of a measurement", where_, shortened(field)));
    }

  private:
    const std::vector<std::string>& fields_;
    std::size_t next_;
    std::string where_;
};

}  // namespace

std::string toCsv(const Measurement& measurement, const Scene& scene) {
    const StatedPlaces places(scene);
    std::string csv = headerOf(measurement) + "\n";
    for (std::size_t i = 0; i < measurement.set.points.size(); ++i) {
        csv += placeText(places.of(measurement.set.points[i]));
        const bool counts = measurement.counts(i);
        const auto add = [&](float value) {
            csv += ',';
            if (counts) fmt::format_to(std::back_inserter(csv), "{:.9g}", value);
        };
        add(measurement.values[i].lux);
        add(measurement.values[i].bound_lux);
        csv += "," + quoted(measurement.inside[i]);
        forEachNumber(measurement, i, add);
        csv += '\n';
    }
    return csv;
}

void mergeCsv(Measurement& measurement, const Scene& scene, const std::vector<std::filesystem::path>& files) {
    constexpr std::size_t placeFields = 6;
    const StatedPlaces places(scene);
    std::unordered_map<std::string, std::size_t> pointAt;
    for (std::size_t i = 0; i < measurement.set.points.size(); ++i)
        pointAt.emplace(placeText(places.of(measurement.set.points[i])), i);
    const std::string header = headerOf(measurement);
    const std::size_t columns = fieldsOf(header).size();
    std::vector<bool> isThere(measurement.set.points.size());
    for (const std::filesystem::path& file : files) {
        TextLines lines(file);
        if (const auto first = lines.next(); !first || *first != header) {
            throw InputError(
                fmt::format("{}: its columns are not those of this measurement, {}: give the scene and the "
                            "flags that the "
                            "pieces were measured with",
                            lines.where(), header));
        }
        while (const auto line = lines.next()) {
            if (line->empty()) continue;
            const std::vector<std::string> fields = fieldsOf(*line);
            if (fields.size() != columns)
                throw InputError(
                    fmt::format("{}: {} columns and not {}", lines.where(), fields.size(), columns));
            const std::string place =
                fmt::format("{}", fmt::join(fields.begin(), fields.begin() + placeFields, ","));
            const auto found = pointAt.find(place);
            if (found == pointAt.end())
                throw InputError(
                    fmt::format("{}: {} is none of the points of this measurement", lines.where(), place));
            if (isThere[found->second])
                throw InputError(fmt::format("{}: {} is there twice", lines.where(), place));
            isThere[found->second] = true;
            RowReader row(fields, placeFields, lines.where());
            MeasuredValue& value = measurement.values[found->second];
            row.read(value.lux);
            row.read(value.bound_lux);
            RowReader rest(fields, placeFields + 3, lines.where());
            forEachNumber(measurement, found->second, [&](float& number) { rest.read(number); });
        }
    }
    const auto missing = std::ranges::find(isThere, false);
    if (missing == isThere.end()) return;
    throw InputError(
        fmt::format("--merge: {} of {} points are in none of the files, the first of them {}",
                    std::ranges::count(isThere, false), isThere.size(),
                    placeText(places.of(measurement.set.points[std::size_t(missing - isThere.begin())]))));
}

}  // namespace penumbra::studio
