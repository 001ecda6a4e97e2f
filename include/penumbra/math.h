// SPDX-License-Identifier: Apache-2.0
// Plain value types for the interface, so that a host need not share a maths library with Penumbra.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

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

    /// From 16 numbers in memory, column after column: what GLM, Qt, OpenSceneGraph (`Matrix::ptr()`), Coin3D
    /// (`SbMat`) and OpenGL itself have there.
    template <std::floating_point T>
    static constexpr Mat4 fromColumns(const T* numbers) {
        Mat4 made;
        for (std::size_t i = 0; i < 16; ++i) made.columns[i / 4][i % 4] = float(numbers[i]);
        return made;
    }
    /// Row after row: VTK (`vtkMatrix4x4::GetData()`), OGRE, Direct3D's books.
    template <std::floating_point T>
    static constexpr Mat4 fromRows(const T* numbers) {
        Mat4 made;
        for (std::size_t i = 0; i < 16; ++i) made.columns[i % 4][i / 4] = float(numbers[i]);
        return made;
    }
};

/// A point of the world near what is seen, such as the eye, for worlds so large that floats cannot hold their
/// matrices (a globe in metres). Give *all* matrices of a call through the same one: they are then relative
/// to that point, put together in double precision, and nothing of the world's size is left in them.
struct WorldOrigin {
    double x = 0, y = 0, z = 0;

    /// worldFromMesh and worldFromLight, out of 16 doubles, column after column.
    constexpr Mat4 worldFrom(const double* columns) const {
        Mat4 made = Mat4::fromColumns(columns);
        made.columns[3] = {float(columns[12] - x), float(columns[13] - y), float(columns[14] - z), 1};
        return made;
    }
    /// viewFromWorld, likewise.
    constexpr Mat4 fromWorld(const double* columns) const {
        Mat4 made = Mat4::fromColumns(columns);
        for (std::size_t row = 0; row < 3; ++row) {
            made.columns[3][row] =
                float(columns[row] * x + columns[4 + row] * y + columns[8 + row] * z + columns[12 + row]);
        }
        return made;
    }
};

}  // namespace penumbra
