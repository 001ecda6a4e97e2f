// SPDX-License-Identifier: Apache-2.0
// Plain value types for the interface, so that a host need not share a maths library with Penumbra.
#pragma once

#include <array>

namespace penumbra {

struct Vec2 {
    float x = 0, y = 0;
    bool operator==(const Vec2&) const = default;
};

struct Vec3 {
    float x = 0, y = 0, z = 0;
    bool operator==(const Vec3&) const = default;
};

/// A 4x4 matrix for column vectors, stored column by column as OpenGL does: element (row, column) is
/// `columns[column][row]`. Matrices are named target from source: `clipFromView * viewFromWorld`.
struct Mat4 {
    std::array<std::array<float, 4>, 4> columns{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    bool operator==(const Mat4&) const = default;
};

}  // namespace penumbra
