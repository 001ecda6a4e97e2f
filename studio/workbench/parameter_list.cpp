// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/parameter_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace penumbra::studio {
namespace {

using Kind = ParameterDescription::Kind;

class Describer final : public ParameterVisitor {
  public:
    void boolean(const ParameterInfo& info, bool& value) override {
        add(info, Kind::boolean, value ? "true" : "false");
    }
    void integer(const ParameterInfo& info, int& value, Range<int> range) override {
        number(info, Kind::integer, value, range);
    }
    void real(const ParameterInfo& info, float& value, Range<float> range) override {
        number(info, Kind::real, value, range);
    }
    void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) override {
        add(info, Kind::choice, std::string(names[std::size_t(value)]))
            .choices.assign(names.begin(), names.end());
    }

    std::vector<ParameterDescription> parameters;

  private:
    ParameterDescription& add(const ParameterInfo& info, Kind kind, std::string value) {
        return parameters.emplace_back(ParameterDescription{.name = std::string(info.name),
                                                            .unit = std::string(info.unit),
                                                            .help = std::string(info.help),
                                                            .kind = kind,
                                                            .value = std::move(value)});
    }
    template <typename T>
    void number(const ParameterInfo& info, Kind kind, T value, Range<T> range) {
        ParameterDescription& added = add(info, kind, fmt::format("{}", value));
        added.min = double(range.min);
        added.max = double(range.max);
    }
};

/// The largest int stands for "no limit", as infinity does.
bool isLimit(const ParameterDescription& parameter, double value) {
    return std::isfinite(value) &&
           (parameter.kind != Kind::integer || std::abs(value) < std::numeric_limits<int>::max());
}

}  // namespace

std::vector<ParameterDescription> describeParameters(Technique& technique) {
    Describer describer;
    technique.describe(describer);
    return std::move(describer.parameters);
}

std::string_view nameOf(ParameterDescription::Kind kind) {
    switch (kind) {
        case Kind::boolean:
            return "boolean";
        case Kind::integer:
            return "integer";
        case Kind::real:
            return "real";
        case Kind::choice:
            return "choice";
    }
    return "";
}

std::string legalValues(const ParameterDescription& parameter) {
    if (parameter.kind == Kind::boolean) return "true or false";
    if (parameter.kind == Kind::choice) return fmt::format("{}", fmt::join(parameter.choices, ", "));
    const bool from = isLimit(parameter, parameter.min), to = isLimit(parameter, parameter.max);
    if (from && to) return fmt::format("{:g} to {:g}", parameter.min, parameter.max);
    if (from) return fmt::format("{:g} or more", parameter.min);
    if (to) return fmt::format("{:g} or less", parameter.max);
    return "any number";
}

}  // namespace penumbra::studio
