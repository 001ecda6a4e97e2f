// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/capping.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "src/geometry/test_meshes.h"

namespace penumbra {
namespace {

std::vector<std::uint32_t> capsOf(const TestMesh& mesh) {
    return capHoles(findEdges(mesh.positions, mesh.indices));
}

TestMesh capped(TestMesh mesh) {
    const std::vector<std::uint32_t> caps = capsOf(mesh);
    mesh.indices.insert(mesh.indices.end(), caps.begin(), caps.end());
    return mesh;
}

/// How many edges are walked more often in one direction than in the other.
std::ptrdiff_t openEdges(const TestMesh& mesh) {
    const EdgeTopology topology = findEdges(mesh.positions, mesh.indices);
    return std::ranges::count_if(topology.edges, [&](const EdgeTopology::Edge& edge) {
        int balance = 0;
        for (std::uint32_t i = 0; i < edge.faceCount; ++i)
            balance += (topology.faces[edge.firstFace + i] & 1) == 0 ? 1 : -1;
        return balance != 0;
    });
}

TEST(CappingTest, ClosedMeshesNeedNoCaps) {
    EXPECT_TRUE(capsOf(testBox()).empty());
    EXPECT_TRUE(capsOf(unwelded(testTorus(12, 8))).empty());
    EXPECT_TRUE(capsOf({}).empty());
}

TEST(CappingTest, AHoleOfNEdgesTakesTwoTrianglesLess) {
    TestMesh box = testBox();
    box.indices.resize(box.indices.size() - 6);  // without one of its six sides
    EXPECT_EQ(capsOf(box).size(), 3u * 2);
    EXPECT_EQ(openEdges(capped(box)), 0);
    // A band around an axis has two holes, of its segments' number of edges.
    EXPECT_EQ(capsOf(testBand(10, 0)).size(), 2 * 3u * (10 - 2));
}

TEST(CappingTest, ASingleTriangleGetsABack) {
    const TestMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}};
    const std::vector<std::uint32_t> caps = capsOf(triangle);
    ASSERT_EQ(caps.size(), 3u);
    EXPECT_EQ(openEdges(capped(triangle)), 0);
}

TEST(CappingTest, AnythingIsClosedAfterwards) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const TestMesh soup = testSoup(seed, 200, 40);
        const std::ptrdiff_t before = openEdges(soup);
        EXPECT_GT(before, 0);
        EXPECT_EQ(openEdges(capped(soup)), 0) << seed;
    }
    // One that cannot be oriented: its seam is walked twice in the same direction.
    EXPECT_EQ(openEdges(capped(testBand(10, 1))), 0);
    // Two holes that touch in a point.
    TestMesh torus = testTorus(12, 8);
    torus.indices.erase(torus.indices.begin() + 30, torus.indices.begin() + 42);
    torus.indices.erase(torus.indices.begin(), torus.indices.begin() + 6);
    EXPECT_EQ(openEdges(capped(torus)), 0);
}

}  // namespace
}  // namespace penumbra
