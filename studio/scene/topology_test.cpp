// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/gltf/gltf.h"

namespace penumbra::studio {
namespace {

Topology topologyOf(const Mesh& mesh) {
    return analyzeTopology(mesh.positions, mesh.indices);
}

const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

TEST(Topology, NothingIsClosed) {
    const Topology topology = analyzeTopology({}, {});
    EXPECT_EQ(topology.edges, 0u);
    EXPECT_TRUE(topology.closed());
}

TEST(Topology, Box) {
    const Topology topology = topologyOf(box({1, 1, 1}));
    EXPECT_EQ(topology.triangles, 12u);
    EXPECT_EQ(topology.vertices, 24u);
    EXPECT_EQ(topology.weldedVertices, 8u);
    EXPECT_EQ(topology.edges, 18u);
    EXPECT_TRUE(topology.closed());
}

TEST(Topology, TorusHasEulerCharacteristicZero) {
    const Topology topology = topologyOf(torus(1, 0.3f, 20, 10));
    EXPECT_EQ(topology.weldedVertices, 200u);
    EXPECT_EQ(topology.edges, 600u);
    EXPECT_EQ(topology.triangles, 400u);
    EXPECT_TRUE(topology.closed());
}

TEST(Topology, OneTriangleIsAllBoundary) {
    const std::vector<std::uint32_t> indices{0, 1, 2};
    EXPECT_EQ(analyzeTopology(corners, indices).boundaryEdges, 3u);
}

TEST(Topology, TwoTrianglesThatWalkTheirEdgeTheSameWayAreFlipped) {
    const std::vector<std::uint32_t> agreeing{0, 1, 2, 1, 0, 3}, disagreeing{0, 1, 2, 0, 1, 3};
    EXPECT_EQ(analyzeTopology(corners, agreeing).flippedEdges, 0u);
    EXPECT_EQ(analyzeTopology(corners, disagreeing).flippedEdges, 1u);
    EXPECT_EQ(analyzeTopology(corners, disagreeing).boundaryEdges, 4u);
}

TEST(Topology, ThreeTrianglesAtAnEdgeAreNonManifold) {
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 1, 3, 0, 1, 4};
    const Topology topology = analyzeTopology(corners, indices);
    EXPECT_EQ(topology.nonManifoldEdges, 1u);
    EXPECT_EQ(topology.boundaryEdges, 6u);
    EXPECT_EQ(topology.edges, 7u);
    EXPECT_FALSE(topology.closed());
}

TEST(Topology, ADuplicatedTriangleIsFlippedAtEachEdge) {
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 1, 2};
    EXPECT_EQ(analyzeTopology(corners, indices).flippedEdges, 3u);
}

TEST(Topology, DegenerateTrianglesAreDroppedFirst) {
    // The second one collapses by its indices, the third by equal positions; an incomplete triple is nothing.
    std::vector<glm::vec3> positions = corners;
    positions.push_back(positions[1]);
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 0, 1, 1, 5, 2, 0, 1};
    const Topology topology = analyzeTopology(positions, indices);
    EXPECT_EQ(topology.triangles, 3u);
    EXPECT_EQ(topology.degenerateTriangles, 2u);
    EXPECT_EQ(topology.edges, 3u);
    EXPECT_EQ(topology.weldedVertices, 5u);
}

TEST(Topology, MinusZeroIsZeroAndANanIsItself) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec3> positions{{0, 0, 0}, {-0.0f, 0, -0.0f}, {nan, 0, 0}, {nan, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(analyzeTopology(positions, {}).weldedVertices, 3u);
}

// A band of `cells` quads closed with a half turn: one boundary curve, and one seam where the windings
// disagree.
TEST(Topology, MoebiusStrip) {
    constexpr int cells = 16;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < cells; ++i)
        for (float side : {-1.0f, 1.0f}) {
            const float angle = 2 * std::numbers::pi_v<float> * float(i) / cells;
            const float radius = 3 + side * std::cos(angle / 2);
            positions.emplace_back(radius * std::cos(angle), side * std::sin(angle / 2),
                                   radius * std::sin(angle));
        }
    for (std::uint32_t i = 0; i < cells; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1;
        const bool seam = i + 1 == cells;
        const std::uint32_t c = seam ? 1 : a + 2, d = seam ? 0 : b + 2;
        indices.insert(indices.end(), {a, c, b, b, c, d});
    }
    const Topology topology = analyzeTopology(positions, indices);
    EXPECT_EQ(topology.boundaryEdges, std::size_t(2 * cells));
    EXPECT_EQ(topology.nonManifoldEdges, 0u);
    EXPECT_EQ(topology.flippedEdges, 1u);
    EXPECT_EQ(int(topology.weldedVertices) - int(topology.edges) + int(topology.triangles), 0);
}

std::filesystem::path sharedScenes() {
    const char* named = std::getenv("PENUMBRA_SHARED_SCENES");
    return named ? named : PENUMBRA_DEFAULT_SHARED_SCENES;
}

// Numbers of SCENES.md, which were counted by a separate program. Models whose meshes have one primitive
// each.
TEST(Topology, AgreesWithTheSharedScenes) {
    struct Expected {
        std::string file;
        std::size_t triangles, boundary, nonManifold, flipped;
    };
    const std::vector<Expected> models{
        {"models/spot_5k.glb", 5856, 0, 0, 0},
        {"models/bird_flap_morph.glb", 342, 18, 0, 6},
        {"models/cloth_folds.glb", 76832, 784, 0, 0},
        {"models/tori_react_logo.glb", 14592, 0, 0, 0},
    };
    if (!std::filesystem::exists(sharedScenes() / models[0].file))
        GTEST_SKIP() << "no shared scenes in " << sharedScenes();
    for (const Expected& expected : models) {
        SCOPED_TRACE(expected.file);
        Topology sum;
        for (const Mesh& mesh : loadGltf(sharedScenes() / expected.file).meshes) {
            const Topology topology = topologyOf(mesh);
            sum.triangles += topology.triangles;
            sum.boundaryEdges += topology.boundaryEdges;
            sum.nonManifoldEdges += topology.nonManifoldEdges;
            sum.flippedEdges += topology.flippedEdges;
        }
        EXPECT_EQ(sum.triangles, expected.triangles);
        EXPECT_EQ(sum.boundaryEdges, expected.boundary);
        EXPECT_EQ(sum.nonManifoldEdges, expected.nonManifold);
        EXPECT_EQ(sum.flippedEdges, expected.flipped);
    }
}

}  // namespace
}  // namespace penumbra::studio
