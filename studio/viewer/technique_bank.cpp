// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/technique_bank.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "studio/workbench/any_technique.h"
#include "studio/workbench/parameter_list.h"

namespace penumbra::studio::viewer {

ParameterValues parameterValues(Technique& technique) {
    ParameterValues values;
    for (ParameterDescription& parameter : describeParameters(technique)) {
        values.emplace_back(std::move(parameter.name), std::move(parameter.value));
    }
    return values;
}

TechniqueBank::Entry& TechniqueBank::entry(std::string_view name) {
    const auto found = entries_.find(name);
    if (found != entries_.end()) return found->second;
    Entry made{makeAnyTechnique(device_, name), {}};
    made.defaults = parameterValues(*made.technique);
    if (const auto wanted = wanted_.find(name); wanted != wanted_.end()) {
        apply(name, *made.technique, wanted->second);
        wanted_.erase(wanted);
    }
    return entries_.emplace(name, std::move(made)).first->second;
}

void TechniqueBank::apply(std::string_view name, Technique& technique, const ParameterValues& values) {
    for (const auto& [key, value] : values) {
        try {
            setParameter(technique, key, value);
        } catch (const Error& error) {
            spdlog::warn("{}: {}", name, error.what());
        }
    }
}

Technique& TechniqueBank::get(std::string_view name) {
    return *entry(name).technique;
}

ParameterValues TechniqueBank::changes(std::string_view name) {
    Entry& found = entry(name);
    ParameterValues values = parameterValues(*found.technique);
    std::erase_if(values, [&](const auto& value) { return std::ranges::count(found.defaults, value) != 0; });
    return values;
}

void TechniqueBank::set(std::string_view name, const ParameterValues& values) {
    const auto found = entries_.find(name);
    if (found == entries_.end()) {
        wanted_[std::string(name)] = values;
        return;
    }
    apply(name, *found->second.technique, found->second.defaults);
    apply(name, *found->second.technique, values);
}

std::map<std::string, ParameterValues> TechniqueBank::allChanges() {
    std::map<std::string, ParameterValues> all(wanted_.begin(), wanted_.end());
    for (const auto& [name, entry] : entries_) all[name] = changes(name);
    return all;
}

void TechniqueBank::forget() {
    for (auto& [name, values] : allChanges()) wanted_[name] = values;
    entries_.clear();
}

}  // namespace penumbra::studio::viewer
