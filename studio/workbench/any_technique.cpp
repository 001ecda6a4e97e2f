// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/any_technique.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "studio/workbench/reference_technique.h"

namespace penumbra::studio {
namespace {

constexpr TechniqueInfo referenceInfo{"reference", "ray tracing (Embree): the truth, up to its stated noise",
                                      0.01f};

}  // namespace

std::vector<TechniqueInfo> allTechniques() {
    const std::span<const TechniqueInfo> catalog = techniqueCatalog();
    std::vector<TechniqueInfo> all(catalog.begin(), catalog.end());
    all.push_back(referenceInfo);
    return all;
}

std::string_view defaultTechnique() {
    const bool hasAdaptive =
        std::ranges::find(techniqueCatalog(), "adaptive", &TechniqueInfo::name) != techniqueCatalog().end();
    return hasAdaptive ? "adaptive" : "hard";
}

std::unique_ptr<Technique> makeAnyTechnique(Device& device, std::string_view name) {
    if (name == referenceInfo.name) return std::make_unique<ReferenceTechnique>();
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
