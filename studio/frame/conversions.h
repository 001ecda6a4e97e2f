// SPDX-License-Identifier: Apache-2.0
// GLM's types as the library's plain ones.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "penumbra/math.h"

namespace penumbra::studio {

inline Mat4 toPenumbra(const glm::mat4& matrix) {
    Mat4 result;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            result.columns[std::size_t(column)][std::size_t(row)] = matrix[column][row];
    }
    return result;
}

inline glm::mat4 fromPenumbra(const Mat4& matrix) {
    glm::mat4 result;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            result[column][row] = matrix.columns[std::size_t(column)][std::size_t(row)];
    }
    return result;
}

/// The same memory: both types are three floats in a row.
inline std::span<const Vec3> asPenumbra(std::span<const glm::vec3> values) {
    static_assert(sizeof(Vec3) == sizeof(glm::vec3));
    return {reinterpret_cast<const Vec3*>(values.data()), values.size()};
}

inline std::span<const Vec2> asPenumbra(std::span<const glm::vec2> values) {
    static_assert(sizeof(Vec2) == sizeof(glm::vec2));
    return {reinterpret_cast<const Vec2*>(values.data()), values.size()};
}

}  // namespace penumbra::studio
