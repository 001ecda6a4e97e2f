// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/silhouette_extractor.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "src/geometry/test_meshes.h"
#include "tests/support/technique_test.h"

namespace penumbra {
namespace {

struct Found {
    glm::dvec3 a, b;
    int weight;
};

glm::dvec3 toDouble(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Every triangle's every side, summed up in a table; in double precision and light space, unlike what is
/// tested.
std::vector<Found> bruteForce(const TestMesh& mesh, const glm::dmat4& lightFromMesh,
                              const LightPoint& light) {
    std::vector<std::size_t> first(mesh.positions.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (first[i] = 0; mesh.positions[first[i]] != mesh.positions[i];) ++first[i];
    }
    const auto posLight = [&](std::size_t vertex) {
        return glm::dvec3(lightFromMesh * glm::dvec4(toDouble(mesh.positions[vertex]), 1));
    };
    std::map<std::pair<std::size_t, std::size_t>, int> weights;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::size_t corners[3] = {first[mesh.indices[i]], first[mesh.indices[i + 1]],
                                        first[mesh.indices[i + 2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        const glm::dvec3 a = posLight(corners[0]);
        const glm::dvec3 normal = glm::cross(posLight(corners[1]) - a, posLight(corners[2]) - a);
        const int facing = glm::dot(normal, glm::dvec3(light) - light.w * a) > 0 ? 1 : -1;
        for (int side = 0; side < 3; ++side) {
            const std::size_t from = corners[side], to = corners[(side + 1) % 3];
            weights[std::minmax(from, to)] += from < to ? facing : -facing;
        }
    }
    std::vector<Found> found;
    for (const auto& [edge, weight] : weights) {
        if (weight != 0) found.push_back({posLight(edge.first), posLight(edge.second), weight});
    }
    return found;
}

class SilhouetteExtractorTest : public studio::TechniqueTest {
  protected:
    static Mesh upload(const TestMesh& mesh) {
        return Mesh(workbench().device(), {.positions = mesh.positions, .indices = mesh.indices});
    }

    static std::vector<SilhouetteEdge> readList(const SilhouetteExtractor& extractor) {
        std::vector<SilhouetteEdge> list(extractor.countFound());
        if (!list.empty()) extractor.edges().read(std::as_writable_bytes(std::span(list)));
        return list;
    }

    static void expectEqual(const std::vector<SilhouetteEdge>& list, const std::vector<Found>& truth) {
        ASSERT_EQ(list.size(), truth.size());
        for (std::size_t i = 0; i < list.size(); ++i) {
            EXPECT_EQ(list[i].weight, truth[i].weight);
            // Positions are transformed in single precision on the device: a few units in the last place.
            const auto tolerance = [](const glm::dvec3& p) { return 1e-6 * std::max(1.0, glm::length(p)); };
            EXPECT_LT(glm::distance(glm::dvec3(list[i].aLight), truth[i].a), tolerance(truth[i].a));
            EXPECT_LT(glm::distance(glm::dvec3(list[i].bLight), truth[i].b), tolerance(truth[i].b));
        }
    }

    static void expectTheOracles(const TestMesh& mesh, const glm::dmat4& lightFromMesh,
                                 const LightPoint& light) {
        const Mesh uploaded = upload(mesh);
        SilhouetteExtractor extractor(workbench().device());
        extractor.extract(std::vector<SilhouetteSource>{{&uploaded, lightFromMesh}}, light, {});
        expectEqual(readList(extractor), bruteForce(mesh, lightFromMesh, light));
    }
};

const LightPoint somewhere(0.3, 5.1, 0.7, 1);
const LightPoint farAway(0.36, 0.48, 0.8, 0);

TEST_F(SilhouetteExtractorTest, EqualsBruteForceOnMeshesOfEveryKind) {
    const TestMesh zeroArea{{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0, 0, 2}, {1, 0, -2}},
                            {0, 3, 1, 0, 1, 2, 0, 2, 4, 2, 1, 4}};
    const TestMesh threeFaces{{{0, 0, 0}, {0, 1, 0.1f}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}},
                              {0, 1, 2, 0, 1, 3, 1, 0, 4}};
    for (const TestMesh& mesh :
         {testBox(), unwelded(testBox()), testTorus(24, 16), testBand(16, 0), testBand(16, 1),
          testBand(16, 2), threeFaces, zeroArea, testSoup(1, 1, 3), TestMesh{}}) {
        for (const LightPoint& light :
             {somewhere, farAway, LightPoint(0, 0, 0, 1), LightPoint(2, 0.01, 0, 1)}) {
            expectTheOracles(mesh, glm::dmat4(1), light);
        }
    }
}

TEST_F(SilhouetteExtractorTest, EqualsBruteForceOnSoups) {
    for (unsigned seed = 0; seed < 20; ++seed)
        expectTheOracles(testSoup(seed, 300, 60), glm::dmat4(1), somewhere);
}

TEST_F(SilhouetteExtractorTest, EqualsBruteForceUnderMirroredFlatAndCollapsedTransforms) {
    const glm::dmat4 turned =
        glm::rotate(glm::translate(glm::dmat4(1), {0.2, -0.4, 0.1}), 0.7, {0.6, 0.8, 0.0});
    for (const glm::dvec3& scale :
         {glm::dvec3(-1, 1, 1), glm::dvec3(-2, -0.5, -3), glm::dvec3(1e-3, 1e4, 1), glm::dvec3(0, 0, 0)}) {
        expectTheOracles(testSoup(7, 100, 30), glm::scale(turned, scale), farAway);
    }
    // Flattened to the plane y = 0, where its facing is still defined.
    expectTheOracles(testTorus(24, 16), glm::scale(glm::dmat4(1), {1.0, 0.0, 1.0}), somewhere);
}

/// The weighted silhouette is the boundary of a surface, whatever the mesh: as much begins at each vertex as
/// ends.
TEST_F(SilhouetteExtractorTest, WeightsBalanceAtEachVertex) {
    for (const TestMesh& mesh : {testBox(), testBand(16, 1), testSoup(3, 300, 60), testTorus(24, 16)}) {
        const Mesh uploaded = upload(mesh);
        SilhouetteExtractor extractor(workbench().device());
        extractor.extract(std::vector<SilhouetteSource>{{&uploaded, glm::dmat4(1)}}, somewhere, {});
        std::map<std::tuple<float, float, float>, int> balance;
        for (const SilhouetteEdge& edge : readList(extractor)) {
            balance[{edge.aLight.x, edge.aLight.y, edge.aLight.z}] += edge.weight;
            balance[{edge.bLight.x, edge.bLight.y, edge.bLight.z}] -= edge.weight;
        }
        for (const auto& [vertex, sum] : balance) EXPECT_EQ(sum, 0);
    }
}

TEST_F(SilhouetteExtractorTest, ABoxHasSixContourEdgesWithTheSurfaceOnTheirLeft) {
    const Mesh box = upload(testBox());
    SilhouetteExtractor extractor(workbench().device());
    const LightPoint corner(30, 40, 50, 1);
    extractor.extract(std::vector<SilhouetteSource>{{&box, glm::dmat4(1)}}, corner,
                      {.verticesPerEdge = 6, .instances = 3});
    const std::vector<SilhouetteEdge> list = readList(extractor);
    EXPECT_EQ(list.size(), 6u);
    for (const SilhouetteEdge& edge : list) {
        EXPECT_EQ(std::abs(edge.weight), 2);
        // From the light's side, a point of the surface (the box's centre) is to the left of a -> b.
        const glm::dvec3 a(edge.aLight), b(edge.bLight), towardsLight = glm::dvec3(corner) - a;
        EXPECT_GT(edge.weight * glm::dot(glm::cross(b - a, -a), towardsLight), 0);
    }
    SilhouetteCommands commands{};
    extractor.commands().read(std::as_writable_bytes(std::span(&commands, 1)));
    EXPECT_EQ(commands.vertexCount, 36u);
    EXPECT_EQ(commands.instanceCount, 3u);
    EXPECT_EQ(commands.groupsX, 1u);
}

TEST_F(SilhouetteExtractorTest, ListsManyMeshesInTheirOrderAndFollowsDeformation) {
    TestMesh torus = testTorus(64, 32);
    const TestMesh soup = testSoup(5, 900, 90);
    Mesh deforming = upload(torus);
    const Mesh still = upload(soup);
    SilhouetteExtractor extractor(workbench().device());
    const std::vector<SilhouetteSource> sources = {{&still, glm::dmat4(1)}, {&deforming, glm::dmat4(1)}};
    for (const float stretch : {1.0f, 0.3f, 2.0f}) {
        TestMesh moved = torus;
        for (Vec3& p : moved.positions) p = {p.x * stretch, p.y + 0.1f * p.x * p.x, p.z};
        deforming.deform(moved.positions);
        extractor.extract(sources, somewhere, {});
        std::vector<Found> truth = bruteForce(soup, glm::dmat4(1), somewhere);
        const std::size_t ofSoup = truth.size();
        const std::vector<Found> more = bruteForce(moved, glm::dmat4(1), somewhere);
        truth.insert(truth.end(), more.begin(), more.end());
        const std::vector<SilhouetteEdge> list = readList(extractor);
        expectEqual(list, truth);
        for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(list[i].caster, i < ofSoup ? 0u : 1u);
    }
    extractor.extract({}, somewhere, {});
    EXPECT_EQ(extractor.countFound(), 0u);
}

/// Facets that the light sees edge-on, and a light in the plane of a face: one rule on both sides of an edge.
TEST_F(SilhouetteExtractorTest, DecidesFacingAsTheCpuDoesToTheLastBit) {
    const TestMesh torus = testTorus(40, 30);
    const Mesh mesh = upload(torus);
    SilhouetteExtractor extractor(workbench().device());
    for (int i = 0; i < 20; ++i) {
        // Lights in the plane of some triangle, up to rounding.
        const auto corner = [&](std::size_t k) {
            return toDouble(torus.positions[torus.indices[std::size_t(i) * 33 + k]]);
        };
        const LightPoint light(4.0 * corner(0) - 1.7 * corner(1) - 1.3 * corner(2), 1);
        extractor.extract(std::vector<SilhouetteSource>{{&mesh, glm::dmat4(1)}}, light, {});
        std::vector<int> facings(torus.indices.size() / 3);
        extractor.facings().read(std::as_writable_bytes(std::span(facings)));
        for (std::size_t f = 0; f < facings.size(); ++f) {
            std::array<glm::vec3, 3> triangle;
            for (std::size_t k = 0; k < 3; ++k)
                triangle[k] = toDouble(torus.positions[torus.indices[3 * f + k]]);
            EXPECT_EQ(facings[f], isFront(triangle, lightPointInMesh(glm::dmat4(1), light)) ? 1 : -1);
        }
    }
}

}  // namespace
}  // namespace penumbra
