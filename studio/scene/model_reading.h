// SPDX-License-Identifier: Apache-2.0
// What a model's file leaves open, or its maker did not keep to, and a user says.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "studio/scene/scene.h"

namespace penumbra::studio {

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
std::span<const std::pair<std::string_view, double>> lengthUnits_m();
std::string_view nameOfUnit(double unit_m);

/// The axes that may point up, by name: y, z.
std::span<const std::pair<std::string_view, UpAxis>> upAxisNames();
std::string_view nameOfUpAxis(UpAxis up);

/// What may be said of glass, by name: clear, tinted, blocks.
std::span<const std::pair<std::string_view, Glass>> glassNames();
std::string_view nameOfGlass(Glass glass);

}  // namespace penumbra::studio
