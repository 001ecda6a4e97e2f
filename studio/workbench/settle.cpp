// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/settle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studio/workbench/parameter_list.h"

namespace penumbra::studio {
namespace {

/// Room for three changes, of which there is one in 30 frames at most.
constexpr int framesToSettle = 100;

}  // namespace

bool keepsToATime(Technique& technique) {
    return std::ranges::any_of(describeParameters(technique), [](const ParameterDescription& parameter) {
        if (!parameter.name.ends_with("budget_ms")) return false;
        const double budget_ms = std::stod(parameter.value);
        return budget_ms > 0 && std::isfinite(budget_ms);
    });
}

void settle(Workbench& workbench, const Workbench::TechniqueOf& techniqueOf, const SceneMoment& moment,
            const Camera& camera, PictureSize size) {
    const auto isSettled = [&](const Light& light) { return !keepsToATime(techniqueOf(light)); };
    if (std::ranges::all_of(moment.lights, isSettled)) return;
    for (int frame = 0; frame < framesToSettle; ++frame)
        workbench.run("settling", techniqueOf, moment, camera, size);
}

std::vector<penumbra::Setting> settingsOf(const Statistics::Chosen& chosen) {
    if (chosen.parameter.empty()) return {};
    std::vector<Setting> settings = {{chosen.parameter, chosen.value}};
    const std::span<const Promise> promises = promisesOf(chosen.technique);
    const auto kept = std::ranges::find_if(promises, [&](const Promise& promise) {
        return promise.parameter == chosen.parameter && promise.value == chosen.value;
    });
    if (kept != promises.end()) settings.insert(settings.end(), kept->besides.begin(), kept->besides.end());
    return settings;
}

std::string describe(const Statistics::Chosen& chosen) {
    std::string text(chosen.technique);
    for (const Setting& setting : settingsOf(chosen)) {
        text += fmt::format("{}{} = {}", text.size() == chosen.technique.size() ? " with " : ", ",
                            setting.parameter, setting.value);
    }
    return text;
}

}  // namespace penumbra::studio
