// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/any_technique.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "studio/workbench/studio_techniques.h"

namespace penumbra::studio {

std::vector<TechniqueInfo> allTechniques() {
    const std::span<const TechniqueInfo> catalog = techniqueCatalog();
    std::vector<TechniqueInfo> all(catalog.begin(), catalog.end());
    for (const StudioTechnique& ours : studioTechniques()) all.push_back(ours.info);
    return all;
}

std::string_view defaultTechnique() {
    return "auto";
}

std::unique_ptr<Technique> makeAnyTechnique(Device& device, std::string_view name) {
    for (const StudioTechnique& ours : studioTechniques()) {
        if (name == ours.info.name) return ours.make();
    }
    if (std::ranges::find(techniqueCatalog(), name, &TechniqueInfo::name) == techniqueCatalog().end()) {
        std::vector<std::string_view> names;
        for (const TechniqueInfo& info : allTechniques()) names.push_back(info.name);
        throw Error(Error::Kind::unknownName,
                    fmt::format("there is no technique '{}'; there are: {}", name, fmt::join(names, ", ")));
    }
    return penumbra::makeTechnique(device, name);
}

void logFromDevice(LogLevel level, std::string_view message) {
    switch (level) {
        case LogLevel::debug:
            spdlog::debug("{}", message);
            break;
        case LogLevel::info:
            spdlog::info("{}", message);
            break;
        case LogLevel::warning:
            spdlog::warn("{}", message);
            break;
        case LogLevel::error:
            spdlog::error("{}", message);
            break;
    }
}

}  // namespace penumbra::studio
