// SPDX-License-Identifier: Apache-2.0
// What a model's file leaves open, or its maker did not keep to, and a user says.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Values by name.
template <typename Value>
using NamedValues = std::span<const std::pair<std::string_view, Value>>;

/// The one of this name, if there is one.
template <typename Value>
std::optional<Value> valueNamed(NamedValues<Value> table, std::string_view name) {
    const auto found = std::ranges::find(table, name, &std::pair<std::string_view, Value>::first);
    return found == table.end() ? std::nullopt : std::optional(found->second);
}

template <typename Value>
std::vector<std::string> namesIn(NamedValues<Value> table) {
    std::vector<std::string> names;
    for (const auto& [name, value] : table) names.emplace_back(name);
    return names;
}

/// How a model is to be read; unset: nothing is said of it.
struct ModelReading {
    std::optional<double> unit_m;  ///< the length that its coordinates count; glTF's metre
    std::optional<UpAxis> up;      ///< Y
    std::optional<Glass> glass;    ///< clear

    bool saysNothing() const { return !unit_m && !up && !glass; }
    /// What is said here and, where nothing is, what `other` says.
    ModelReading orElse(const ModelReading& other) const;
};

/// The lengths that a file's coordinates may count, by name: mm, cm, m, in, ft.
NamedValues<double> lengthUnits_m();
std::string_view nameOfUnit(double unit_m);

/// The axes that may point up, by name: y, z.
NamedValues<UpAxis> upAxisNames();
std::string_view nameOfUpAxis(UpAxis up);

/// What may be said of glass, by name: clear, tinted, blocks.
NamedValues<Glass> glassNames();
std::string_view nameOfGlass(Glass glass);

}  // namespace penumbra::studio
