// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "studio/measure/point_set.h"

namespace penumbra::studio {

/// A point as it was stated: in the file's axes, in metres.
struct StatedPlace {
    glm::dvec3 position, normal;
};

class StatedPlaces {
  public:
    explicit StatedPlaces(const Scene& scene) : statedFromWorld_(glm::inverse(worldFromStated(scene))) {}

    StatedPlace of(const MeasuringPoint& point) const {
        return {rounded(glm::dvec3(statedFromWorld_ * glm::dvec4(point.posWorld, 1))),
                rounded(glm::dmat3(statedFromWorld_) * point.normalWorld)};
    }

  private:
    /// To nanometres, without what matrices have left of zeros.
    static glm::dvec3 rounded(const glm::dvec3& v) {
        constexpr double nanometres = 1e9;
        return glm::round(v * nanometres) / nanometres + 0.0;
    }

    glm::dmat4 statedFromWorld_;
};

}  // namespace penumbra::studio
