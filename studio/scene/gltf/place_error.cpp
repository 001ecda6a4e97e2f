// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/place_error.h"

#include <fmt/format.h>

namespace penumbra::studio::gltf {

PlaceError::PlaceError(const std::string& place, const std::string& problem, const std::string& remedy)
    : std::runtime_error(fmt::format("{}{}{}; {}", place, place.empty() ? "" : ": ", problem, remedy)) {}

std::exception_ptr PointerPlaces::errorAt(const JsonView& at, const std::string& problem) const {
    return std::make_exception_ptr(PlaceError(at.pointer(), problem));
}

std::string PointerPlaces::subjectOf(const JsonView&) const {
    return "";
}

}  // namespace penumbra::studio::gltf
