// SPDX-License-Identifier: Apache-2.0
// Meshes that tests of edges share.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "penumbra/math.h"

namespace penumbra {

struct TestMesh {
    std::vector<Vec3> positions;
    std::vector<std::uint32_t> indices;

    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        indices.insert(indices.end(), {a, b, c, a, c, d});
    }
};

/// Closed, wound outwards.
inline TestMesh testBox() {
    TestMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back({(i & 1) ? 1.0f : -1.0f, (i & 2) ? 1.0f : -1.0f, (i & 4) ? 1.0f : -1.0f});
    }
    mesh.quad(0, 4, 6, 2);
    mesh.quad(1, 3, 7, 5);
    mesh.quad(0, 1, 5, 4);
    mesh.quad(2, 6, 7, 3);
    mesh.quad(0, 2, 3, 1);
    mesh.quad(4, 5, 7, 6);
    return mesh;
}

/// A band of `segments` quads around the Y axis, twisted by `halfTurns` half turns; closed to a ring without
/// a seam.
inline TestMesh testBand(std::uint32_t segments, int halfTurns) {
    TestMesh mesh;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * float(i) / float(segments);
        const float twist = 0.5f * float(halfTurns) * angle;
        for (const float side : {-0.4f, 0.4f}) {
            const float radius = 2 + side * std::cos(twist);
            mesh.positions.push_back(
                {radius * std::cos(angle), side * std::sin(twist), radius * std::sin(angle)});
        }
    }
    for (std::uint32_t i = 0; i + 1 < segments; ++i) mesh.quad(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    const std::uint32_t last = 2 * (segments - 1);
    // After an odd number of half turns the band's two sides have changed places.
    halfTurns % 2 == 0 ? mesh.quad(last, last + 1, 1, 0) : mesh.quad(last, last + 1, 0, 1);
    return mesh;
}

inline TestMesh testTorus(std::uint32_t segments, std::uint32_t sides) {
    TestMesh mesh;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const float u = 2 * std::numbers::pi_v<float> * float(i) / float(segments);
        for (std::uint32_t j = 0; j < sides; ++j) {
            const float v = 2 * std::numbers::pi_v<float> * float(j) / float(sides);
            const float radius = 2 + 0.7f * std::cos(v);
            mesh.positions.push_back({radius * std::cos(u), 0.7f * std::sin(v), radius * std::sin(u)});
        }
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t nextI = (i + 1) % segments, nextJ = (j + 1) % sides;
            mesh.quad(i * sides + j, i * sides + nextJ, nextI * sides + nextJ, nextI * sides + j);
        }
    }
    return mesh;
}

/// Triangles between random ones of `vertices` random points: any number of faces an edge, wound at random,
/// some of them degenerate.
inline TestMesh testSoup(unsigned seed, std::uint32_t triangles, std::uint32_t vertices) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    std::uniform_int_distribution<std::uint32_t> vertex(0, vertices - 1);
    TestMesh mesh;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
    }
    for (std::uint32_t i = 0; i < 3 * triangles; ++i) mesh.indices.push_back(vertex(random));
    return mesh;
}

/// The same triangles, each with corners of its own.
inline TestMesh unwelded(const TestMesh& mesh) {
    TestMesh result;
    for (const std::uint32_t index : mesh.indices) {
        result.indices.push_back(std::uint32_t(result.positions.size()));
        result.positions.push_back(mesh.positions[index]);
    }
    return result;
}

}  // namespace penumbra
