// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/edge_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "src/geometry/test_meshes.h"

namespace penumbra {
namespace {

EdgeTopology edgesOf(const TestMesh& mesh) {
    return findEdges(mesh.positions, mesh.indices);
}

std::size_t edgesWithFaces(const EdgeTopology& topology, std::uint32_t count) {
    return std::size_t(std::ranges::count(topology.edges, count, &EdgeTopology::Edge::faceCount));
}

TEST(EdgeTopologyTest, ClosedMeshesHaveTwoFacesAtEachEdge) {
    const EdgeTopology box = edgesOf(testBox());
    EXPECT_EQ(box.edges.size(), 18u);
    EXPECT_EQ(edgesWithFaces(box, 2), 18u);
    const EdgeTopology torus = edgesOf(testTorus(12, 8));
    EXPECT_EQ(torus.edges.size(), 3u * 12 * 8);
    EXPECT_EQ(edgesWithFaces(torus, 2), torus.edges.size());
}

TEST(EdgeTopologyTest, NeighboursOfAnOrientedSurfaceWalkTheirEdgeInOppositeDirections) {
    const EdgeTopology torus = edgesOf(testTorus(12, 8));
    for (const EdgeTopology::Edge& edge : torus.edges) {
        EXPECT_NE(torus.faces[edge.firstFace] & 1, torus.faces[edge.firstFace + 1] & 1);
    }
    // A Moebius strip cannot be oriented: one rung at least is walked twice in the same direction.
    const EdgeTopology strip = edgesOf(testBand(10, 1));
    const auto disagrees = [&](const EdgeTopology::Edge& edge) {
        return edge.faceCount == 2 &&
               (strip.faces[edge.firstFace] & 1) == (strip.faces[edge.firstFace + 1] & 1);
    };
    EXPECT_EQ(std::ranges::count_if(strip.edges, disagrees), 1);
    EXPECT_EQ(edgesWithFaces(strip, 1), 20u);
}

TEST(EdgeTopologyTest, EqualPositionsAreWelded) {
    const EdgeTopology welded = edgesOf(testBox());
    const EdgeTopology apart = edgesOf(unwelded(testBox()));
    EXPECT_EQ(apart.edges.size(), welded.edges.size());
    EXPECT_EQ(edgesWithFaces(apart, 2), welded.edges.size());

    TestMesh zeros{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}, {0, -1, 0}}, {0, 1, 2, 3, 4, 1}};
    EXPECT_EQ(edgesWithFaces(edgesOf(zeros), 2), 1u) << "0 and -0 are the same place";
}

TEST(EdgeTopologyTest, CollapsedTrianglesHaveNoEdges) {
    TestMesh box = testBox();
    box.indices.insert(box.indices.end(), {0, 0, 1, 2, 3, 2, 5, 5, 5});
    box.positions.push_back(box.positions[0]);
    box.indices.insert(box.indices.end(), {0, 8, 1});
    const EdgeTopology with = edgesOf(box), without = edgesOf(testBox());
    EXPECT_EQ(with.edges.size(), without.edges.size());
    EXPECT_EQ(with.faces, without.faces);
}

TEST(EdgeTopologyTest, AnEdgeMayHaveAnyNumberOfFaces) {
    TestMesh fan{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}}, {0, 1, 2, 0, 1, 3, 1, 0, 4}};
    const EdgeTopology topology = edgesOf(fan);
    ASSERT_EQ(topology.edges.front().faceCount, 3u);
    EXPECT_EQ(topology.faces[0], 0u);
    EXPECT_EQ(topology.faces[1], 2u);
    EXPECT_EQ(topology.faces[2], 5u) << "triangle 2 walks from b to a";
    EXPECT_EQ(edgesWithFaces(topology, 1), 6u);
    EXPECT_TRUE(edgesOf({}).edges.empty());
}

}  // namespace
}  // namespace penumbra
