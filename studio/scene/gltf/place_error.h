// SPDX-License-Identifier: Apache-2.0
// What is wrong in a glTF file, and where.
#pragma once

#include <stdexcept>
#include <string>

#include "studio/scene/json/json_view.h"

namespace penumbra::studio::gltf {

/// What is wrong at one place of a file; loadGltf turns it into an InputError that names the file too.
struct PlaceError : std::runtime_error {
    PlaceError(const std::string& place, const std::string& problem,
               const std::string& remedy = "re-export the file, or check it with gltf-validator");
};

/// A file that is named but is not there, or lies where nothing is read from.
struct MissingFile : PlaceError {
    using PlaceError::PlaceError;
};

/// Places are JSON pointers, as gltf-validator tells them; what is wrong there is a PlaceError.
class PointerPlaces final : public JsonPlaces {
  public:
    std::exception_ptr errorAt(const JsonView& at, const std::string& problem) const override;
    std::string subjectOf(const JsonView& at) const override;
};

}  // namespace penumbra::studio::gltf
