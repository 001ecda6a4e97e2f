// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/model_reading.h"

#include <array>

namespace penumbra::studio {
namespace {

template <typename Value>
using Named = std::pair<std::string_view, Value>;

template <typename Value>
std::string_view nameIn(NamedValues<Value> table, Value value) {
    return std::ranges::find(table, value, &Named<Value>::second)->first;
}

}  // namespace

ModelReading ModelReading::orElse(const ModelReading& other) const {
    return {.unit_m = unit_m ? unit_m : other.unit_m,
            .up = up ? up : other.up,
            .glass = glass ? glass : other.glass};
}

NamedValues<double> lengthUnits_m() {
    static constexpr std::array<Named<double>, 5> units = {
        {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"in", 0.0254}, {"ft", 0.3048}}};
    return units;
}

std::string_view nameOfUnit(double unit_m) {
    return nameIn(lengthUnits_m(), unit_m);
}

NamedValues<UpAxis> upAxisNames() {
    static constexpr std::array<Named<UpAxis>, 2> names = {{{"y", UpAxis::y}, {"z", UpAxis::z}}};
    return names;
}

std::string_view nameOfUpAxis(UpAxis up) {
    return nameIn(upAxisNames(), up);
}

NamedValues<Glass> glassNames() {
    static constexpr std::array<Named<Glass>, 3> names = {
        {{"clear", Glass::clear}, {"tinted", Glass::tinted}, {"blocks", Glass::blocks}}};
    return names;
}

std::string_view nameOfGlass(Glass glass) {
    return nameIn(glassNames(), glass);
}

}  // namespace penumbra::studio
