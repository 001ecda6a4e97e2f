// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/mesh_kit.h"

#include <gtest/gtest.h>

#include <numbers>

#include "studio/scene/topology.h"

namespace penumbra::studio {
namespace {

constexpr double pi = std::numbers::pi;

/// Of a closed mesh that winds counter-clockwise seen from outside (divergence theorem).
double volume_m3(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

double area_m2(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

Topology topologyOf(const Mesh& mesh) {
    return analyzeTopology(mesh.positions, mesh.indices);
}

struct Solid {
    std::string name;
    Mesh mesh;
    std::size_t triangles;
    int eulerCharacteristic;  ///< 2 for a ball, 0 for a ring
    double volume_m3, tolerance_m3;
};

// Prisms and cones over an n-gon have exactly its area; spheres and tori come near from below.
TEST(MeshKit, SolidsAreClosedOutwardAndOfTheRightVolume) {
    const double polygon = 0.5 * 48 * std::sin(2 * pi / 48);
    const std::vector<Solid> solids{
        {"box", box({1, 2, 3}), 12, 2, 6, 1e-5},
        {"room", room({1, 2, 3}), 12, 2, -6, 1e-5},
        {"sphere", sphere(1, 96, 48), 2 * 96 * 47, 2, 4 * pi / 3, 0.02},
        {"torus", torus(1, 0.4f, 96, 48), 2 * 96 * 48, 0, 2 * pi * pi * 0.16, 0.02},
        {"cylinder", cylinder(1, 2, 48), 4 * 48, 2, 2 * polygon, 1e-5},
        {"cone", cone(1, 3, 48), 2 * 48, 2, polygon, 1e-5},
    };
    for (const Solid& solid : solids) {
        SCOPED_TRACE(solid.name);
        const Topology topology = topologyOf(solid.mesh);
        EXPECT_EQ(topology.triangles, solid.triangles);
        EXPECT_TRUE(topology.closed());
        EXPECT_EQ(topology.flippedEdges, 0u);
        EXPECT_EQ(topology.degenerateTriangles, 0u);
        EXPECT_EQ(int(topology.weldedVertices) - int(topology.edges) + int(topology.triangles),
                  solid.eulerCharacteristic);
        EXPECT_NEAR(volume_m3(solid.mesh), solid.volume_m3, solid.tolerance_m3);
    }
}

TEST(MeshKit, SheetsHaveTheirBorderAndArea) {
    EXPECT_EQ(topologyOf(plane(2, 3, 4, 5)).boundaryEdges, 18u);
    EXPECT_NEAR(area_m2(plane(2, 3, 4, 5)), 6, 1e-5);
    EXPECT_EQ(topologyOf(disk(1, 512)).boundaryEdges, 512u);
    EXPECT_NEAR(area_m2(disk(1, 512)) / pi, 1 - 2 * pi * pi / (3 * 512 * 512), 1e-6);
    EXPECT_EQ(topologyOf(cylinder(1, 2, 48, Ends::open)).boundaryEdges, 96u);
    EXPECT_EQ(topologyOf(flag(1, 0.1f, 1, 8)).boundaryEdges, 32u);
}

TEST(MeshKit, FlagIsATravellingWave) {
    const float size_m = 2, amplitude_m = 0.3f, waves = 1.5f;
    const Mesh mesh = flag(size_m, amplitude_m, waves, 16);
    for (double phase : {0.0, 0.7, 2.0, 4.5})
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const double x = mesh.positions[i].x;
            const double z = std::cos(phase) * mesh.morphTargets[0].positionDeltas[i].z +
                             std::sin(phase) * mesh.morphTargets[1].positionDeltas[i].z;
            EXPECT_NEAR(z, amplitude_m * x / size_m * std::sin(2 * pi * waves * x / size_m - phase), 1e-5);
        }
}

}  // namespace
}  // namespace penumbra::studio
