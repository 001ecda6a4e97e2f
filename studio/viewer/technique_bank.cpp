// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/technique_bank.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "studio/workbench/any_technique.h"

namespace penumbra::studio::viewer {
namespace {

class Reader final : public ParameterVisitor {
  public:
    void boolean(const ParameterInfo& info, bool& value) override { add(info, value ? "true" : "false"); }
    void integer(const ParameterInfo& info, int& value, Range<int>) override {
        add(info, fmt::format("{}", value));
    }
    void real(const ParameterInfo& info, float& value, Range<float>) override {
        add(info, fmt::format("{}", value));
    }
    void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) override {
        add(info, std::string(names[std::size_t(value)]));
    }
    ParameterValues values;

  private:
    void add(const ParameterInfo& info, std::string text) {
        values.emplace_back(std::string(info.name), std::move(text));
    }
};

}  // namespace

ParameterValues parameterValues(Technique& technique) {
    Reader reader;
    technique.describe(reader);
    return std::move(reader.values);
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
