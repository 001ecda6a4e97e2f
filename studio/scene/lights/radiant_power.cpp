// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/radiant_power.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <numbers>
#include <string>

namespace penumbra::studio {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Of monochromatic light of 555 nm: what Blender's own exporter to glTF counts.
constexpr float lumensPerWatt = 683;

/// "Blender 4.2" as 4.
int blenderMajor(const JsonView& program) {
    const std::string text = program.asName();
    constexpr std::string_view name = "blender";
    const bool isBlender = text.size() >= name.size() &&
                           std::equal(name.begin(), name.end(), text.begin(), [](char known, char given) {
                               return known == char(std::tolower(static_cast<unsigned char>(given)));
                           });
    const std::size_t number = text.find_first_of("0123456789");
    int major = 0;
    if (number != text.npos) std::from_chars(text.data() + number, text.data() + text.size(), major);
    if (!isBlender || major < 1)
        program.fail(
            fmt::format("watts are known of Blender, with its version, for instance 'Blender 4.2', "
                        "not of '{}': state an 'intensity' instead",
                        text));
    return major;
}

}  // namespace

bool statesWatts(const JsonView& light) {
    return light.has("watts") || light.has("program");
}

Emission readWatts(const JsonView& light, const AreaLight& shape) {
    for (const std::string_view key : {"intensity", "normalize"})
        if (const auto value = light.find(key))
            value->fail(fmt::format("'{}' and 'watts' say the same: keep one of them", key));
    if (!light.has("watts")) light.fail("a 'program' without 'watts' says nothing");
    if (!light.has("program"))
        light.fail(
            "'watts' need the 'program' that they were made with, and its version: a rectangle of P watts "
            "shines P / (pi A) in Blender since 4.0 and P / (4 A) before");
    const float watts = light.number("watts", 0, atLeastZero);
    const int major = blenderMajor(light.at("program"));
    if (shape.shape == LightShape::sphere) {
        const float intensity_cd = lumensPerWatt * watts / (4 * pi);
        if (shape.radius_m == 0) return {Emission::Unit::candela, glm::vec3(intensity_cd)};
        return {Emission::Unit::nits, glm::vec3(intensity_cd / (pi * shape.radius_m * shape.radius_m))};
    }
    const float area_m2 = shape.shape == LightShape::rect ? shape.width_m * shape.height_m
                                                          : pi * shape.radius_m * shape.radius_m;
    if (!(area_m2 > 0)) light.at("watts").fail("'watts' of a flat light without an area shine nowhere");
    constexpr int mended = 4;
    const float steradians = major < mended ? 4 : pi;
    return {Emission::Unit::nits, glm::vec3(lumensPerWatt * watts / (steradians * area_m2))};
}

}  // namespace penumbra::studio
