// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/info_profile.h"

#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "studio/errors.h"
#include "studio/json_text.h"
#include "studio/scene/profiles/number_stream.h"
#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::ordered_json;

struct Direction {
    double gamma_deg, c_deg;
};

Direction parseDirection(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto gamma = parseNumber(text.substr(0, comma), false);
    const auto c = comma == text.npos ? std::nullopt : parseNumber(text.substr(comma + 1), false);
    if (!gamma || !c || *gamma < 0 || *gamma > 180)
        throw UsageError(fmt::format(
            "--candela '{}' is not GAMMA,C in degrees, GAMMA from 0 (down) to 180, for instance 45,90",
            text));
    return {*gamma, *c};
}

char typeLetter(CandelaGrid::Type type) {
    return type == CandelaGrid::Type::A ? 'A' : type == CandelaGrid::Type::B ? 'B' : 'C';
}

/// By the planes of type C; types A and B have none, and name the axes.
Json openingJson(const LightProfile& profile) {
    const LuminousOpening& opening = profile.opening;
    Json json = {{"shape", opening.name()}};
    if (opening.shape == LuminousOpening::Shape::point) return json;
    const bool round = opening.x_m == opening.y_m && (opening.shape == LuminousOpening::Shape::circle ||
                                                      opening.shape == LuminousOpening::Shape::sphere);
    const bool planes = profile.grid.type == CandelaGrid::Type::C;
    if (round) {
        json["diameter_m"] = opening.x_m;
    } else {
        json[planes ? "along_C0_m" : "along_X_m"] = opening.x_m;
        json[planes ? "along_C90_m" : "along_Y_m"] = opening.y_m;
    }
    json["height_m"] = opening.z_m;
    return json;
}

std::string openingText(const LuminousOpening& opening) {
    if (opening.shape == LuminousOpening::Shape::point) return opening.name();
    return fmt::format("{}, {:.4g} m along C0, {:.4g} m along C90, {:.4g} m high", opening.name(),
                       opening.x_m, opening.y_m, opening.z_m);
}

void printText(const LightProfile& profile, const std::vector<Direction>& directions) {
    const CandelaGrid& grid = profile.grid;
    fmt::print("profile     {}\n", profile.fileName);
    fmt::print("version     {}, type {}\n", profile.version, typeLetter(grid.type));
    fmt::print("symmetry    {}\n", grid.symmetry());
    fmt::print("angles      {} vertical, {:g} to {:g}; {} horizontal\n", grid.verticals_deg.size(),
               grid.verticals_deg.front(), grid.verticals_deg.back(), grid.horizontals_deg.size());
    fmt::print("opening     {}\n", openingText(profile.opening));
    fmt::print("candela     {:.6g} at most\n", grid.largest());
    fmt::print("lumens      {:.6g}; of its lamps: {}\n", grid.integral(),
               profile.lampLumens ? fmt::format("{:.6g} stated", *profile.lampLumens)
                                  : std::string("none stated, candela are absolute"));
    for (const Direction& d : directions)
        fmt::print("gamma {:g}, C {:g}: {:.6g} cd\n", d.gamma_deg, d.c_deg,
                   grid.at(directionOf(d.gamma_deg, d.c_deg)));
    for (const std::string& warning : profile.warnings) fmt::print("warning     {}\n", warning);
}

void printJson(const LightProfile& profile, const std::vector<Direction>& directions) {
    const CandelaGrid& grid = profile.grid;
    Json json = {{"file", profile.fileName},
                 {"version", profile.version},
                 {"type", std::string(1, typeLetter(grid.type))},
                 {"symmetry", grid.symmetry()},
                 {"opening", openingJson(profile)},
                 {"max_candela", grid.largest()},
                 {"lumens", grid.integral()},
                 {"lamp_lumens", profile.lampLumens ? Json(*profile.lampLumens) : Json()},
                 {"candela", Json::array()},
                 {"warnings", profile.warnings}};
    for (const Direction& d : directions)
        json["candela"].push_back(
            {{"gamma", d.gamma_deg}, {"c", d.c_deg}, {"cd", grid.at(directionOf(d.gamma_deg, d.c_deg))}});
    std::cout << jsonText(json);
}

}  // namespace

void printProfile(const std::string& file, const std::vector<std::string>& directions, bool json) {
    std::vector<Direction> parsed;
    for (const std::string& text : directions) parsed.push_back(parseDirection(text));
    const LightProfile profile = readProfile(file);
    json ? printJson(profile, parsed) : printText(profile, parsed);
}

}  // namespace penumbra::studio
