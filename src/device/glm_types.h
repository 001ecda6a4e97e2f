// SPDX-License-Identifier: Apache-2.0
// The interface's plain types as GLM's, and the precision in which transforms are composed.
#pragma once

#include <glm/glm.hpp>

#include "penumbra/math.h"

namespace penumbra {

inline glm::vec3 toGlm(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Transforms are composed in double precision, so that a chain whose large translations cancel stays exact.
inline glm::dmat4 toGlm(const Mat4& matrix) {
    glm::dmat4 result;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            result[column][row] = matrix.columns[std::size_t(column)][std::size_t(row)];
    }
    return result;
}

}  // namespace penumbra
