// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace penumbra::studio::gltf {

/// v at unit length; `otherwise` where v is zero or not finite. In double, where no square of a float
/// overflows.
inline glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length) : otherwise;
}

}  // namespace penumbra::studio::gltf
