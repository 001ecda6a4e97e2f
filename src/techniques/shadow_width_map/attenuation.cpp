// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/attenuation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "penumbra/device.h"

namespace penumbra::shadow_width_map {
namespace {

/// So that the ratio 1, where the published curve has its kink, is an entry.
constexpr int tableEntries = 257;
constexpr int gridSteps = 64;
/// Rounding of a few operations in single precision; nobody sees less.
constexpr float tolerance = 1e-4f;
/// A continuous function whose whole fall happened between two neighbouring ratios of the grid could not be
/// told from one that jumps; a fall of more than this is called a jump if it does not get smaller on a grid
/// 64 times finer.
constexpr float jump = 0.25f;

void require(bool condition, const char* property, float sd, float sw) {
    if (condition) return;
    throw Error(Error::Kind::badArgument, "the attenuation function lacks property " + std::string(property) +
                                              " (at sd = " + std::to_string(sd) +
                                              ", sw = " + std::to_string(sw) + ")");
}

/// Halves the interval around a large fall until it is either shared by both halves or as narrow as floats
/// can tell.
bool jumps(const AttenuationFunction& attenuation, float low, float high) {
    for (int i = 0; i < 16; ++i) {
        const float middle = 0.5f * (low + high);
        const float first = attenuation(1, low) - attenuation(1, middle);
        const float second = attenuation(1, middle) - attenuation(1, high);
        if (std::max(first, second) <= jump) return false;
        (first > second ? high : low) = middle;
    }
    return true;
}

}  // namespace

float linearAttenuation(float sd, float sw) {
    return sd == 0 ? 1 : std::clamp(1 - sw / sd, 0.0f, 1.0f);
}

float smoothAttenuation(float sd, float sw) {
    const float t = linearAttenuation(sd, sw);
    return t * t * (3 - 2 * t);
}

std::vector<float> tabulateAttenuation(const AttenuationFunction& attenuation) {
    for (int i = 1; i <= gridSteps; ++i) {
        const float ratio = attenuationTableEnd * float(i) / gridSteps;
        const float value = attenuation(1, ratio);
        require(std::isfinite(value) && value >= 0 && value <= 1, "0: a value lies between 0 and 1", 1,
                ratio);
        require(std::abs(attenuation(0, ratio) - 1) <= tolerance,
                "1: I(0, sw) = 1, no blocker is nearer the light", 0, ratio);
        require(std::abs(attenuation(ratio, 0) - 1) <= tolerance,
                "1: I(sd, 0) = 1, the shadow's border is lit", ratio, 0);
        for (const float scale : {0.125f, 3.0f, 64.0f}) {
            require(std::abs(attenuation(scale, scale * ratio) - value) <= tolerance,
                    "2: I depends on sw / sd alone", scale, scale * ratio);
        }
        const float before = attenuation(1, attenuationTableEnd * float(i - 1) / gridSteps);
        require(before > value || (before == 0 && value == 0), "3: I falls strictly with sw until it is 0", 1,
                ratio);
        require(before - value <= jump ||
                    !jumps(attenuation, attenuationTableEnd * float(i - 1) / gridSteps, ratio),
                "4: I is continuous", 1, ratio);
        const float nearer = attenuation(0.5f, ratio), farther = attenuation(2, ratio);
        require(nearer < farther || (nearer == 0 && farther == 0),
                "5: I rises with sd until it is no longer 0", 0.5f, ratio);
    }
    std::vector<float> table(tableEntries);
    for (int i = 0; i < tableEntries; ++i)
        table[std::size_t(i)] = attenuation(1, attenuationTableEnd * float(i) / (tableEntries - 1));
    return table;
}

float umbraBegins(std::span<const float> table) {
    const auto dark = std::ranges::find(table, 0.0f);
    const auto entry = std::min(dark - table.begin(), std::ptrdiff_t(table.size()) - 1);
    return attenuationTableEnd * float(entry) / float(table.size() - 1);
}

}  // namespace penumbra::shadow_width_map
