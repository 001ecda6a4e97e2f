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
    return entries_.emplace(name, std::move(made)).first->second;
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
    Entry& found = entry(name);
    const auto apply = [&](const ParameterValues& chosen) {
        for (const auto& [key, value] : chosen) {
            try {
                setParameter(*found.technique, key, value);
            } catch (const Error& error) {
                spdlog::warn("{}: {}", name, error.what());
            }
        }
    };
    apply(found.defaults);
    apply(values);
}

std::map<std::string, ParameterValues> TechniqueBank::allChanges() {
    std::map<std::string, ParameterValues> all;
    for (const auto& [name, entry] : entries_) all[name] = changes(name);
    return all;
}

void TechniqueBank::forget() {
    const std::map<std::string, ParameterValues> kept = allChanges();
    entries_.clear();
    for (const auto& [name, values] : kept) {
        if (!values.empty()) set(name, values);
    }
}

}  // namespace penumbra::studio::viewer
