// SPDX-License-Identifier: Apache-2.0
// Stand-ins keep their rims, are as near as they say, and move shadows by no more than they may.
#include "src/techniques/exact_visibility/stand_ins.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/patch_simplifier.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "tests/support/technique_test.h"

namespace penumbra::exact_visibility {
namespace {

using studio::LightResult;
using studio::Settings;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Edges that no other triangle has the other way round.
std::set<Edge> rimOf(std::span<const Triangle> triangles) {
    std::set<Edge> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
    }
    std::set<Edge> rim;
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from})) rim.insert({from, to});
    }
    return rim;
}

float distanceTo(std::span<const Triangle> triangles, std::span<const glm::vec3> at, const glm::vec3& p) {
    float nearest = 1e30f;
    for (const auto& [a, b, c] : triangles)
        nearest = std::min(nearest, distanceToTriangle(p, at[a], at[b], at[c]));
    return nearest;
}

std::vector<Triangle> trianglesOf(const studio::Mesh& mesh) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    return triangles;
}

TEST(PatchSimplifierTest, OfAFlatPatchOnlyTheRimIsLeft) {
    const studio::Mesh mesh = studio::plane(1, 1, 12, 12);
    const std::vector<Triangle> triangles = trianglesOf(mesh);
    PatchSimplifier simplifier(mesh.positions);
    const auto result = simplifier.simplify(triangles, 1e-5f);
    EXPECT_EQ(result.triangles.size(), 4 * 12 - 2);
    EXPECT_LE(result.deviation, 5e-6f);  // rounding
    EXPECT_EQ(rimOf(result.triangles), rimOf(triangles));
}

TEST(PatchSimplifierTest, WhatIsGoneIsAsNearAsItSays) {
    for (const float largest : {0.001f, 0.01f, 0.1f}) {
        studio::Mesh mesh = studio::plane(1, 1, 24, 24);
        for (glm::vec3& p : mesh.positions) p.y = 0.1f * std::sin(9 * p.x) * std::cos(7 * p.z);
        const std::vector<Triangle> triangles = trianglesOf(mesh);
        PatchSimplifier simplifier(mesh.positions);
        const auto result = simplifier.simplify(triangles, largest);
        EXPECT_LT(result.triangles.size(), triangles.size());
        EXPECT_LE(result.deviation, largest);
        EXPECT_EQ(rimOf(result.triangles), rimOf(triangles));
        float farthest = 0;
        for (const glm::vec3& p : mesh.positions)
            farthest = std::max(farthest, distanceTo(result.triangles, mesh.positions, p));
        EXPECT_LE(farthest, result.deviation + 1e-6f);
        // And the other way round.
        for (const auto& [a, b, c] : result.triangles) {
            const glm::vec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0f;
            EXPECT_LE(distanceTo(triangles, mesh.positions, middle), 2 * result.deviation + 1e-6f);
        }
    }
}

TEST(PatchSimplifierTest, WhatIsNoManifoldStays) {
    // Three sheets around an edge, a triangle twice, one that has no area, and one that is none.
    const std::vector<glm::vec3> at = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {2, 0, 0}};
    const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 2}, {0, 1, 5}};
    std::vector<Triangle> given = triangles;
    given.push_back({2, 2, 3});
    PatchSimplifier simplifier(at);
    EXPECT_EQ(simplifier.simplify(given, 10).triangles, triangles);
}

TEST(StandInsTest, OfClosedMeshesHaveTheRimsOfTheirNodes) {
    const studio::Mesh mesh = studio::torus(1, 0.4f, 160, 80);
    std::vector<Vec3> positions;
    for (const glm::vec3& p : mesh.positions) positions.push_back({p.x, p.y, p.z});
    // A vertex where two meet that are one.
    std::vector<TreeBox> boxes(mesh.indices.size() / 3);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) boxes[i / 3].add(mesh.positions[mesh.indices[i]]);
    const TreeShape shape = buildTree(boxes, EXACT_LEAF_TRIANGLES);
    const StandIns standIns = makeStandIns(shape, positions, mesh.indices);
    ASSERT_GT(standIns.list.size(), 20);

    std::map<std::tuple<float, float, float>, std::uint32_t> welded;
    const auto vertex = [&](std::uint32_t i) {
        const glm::vec3& p = mesh.positions[i];
        return welded.try_emplace({p.x, p.y, p.z}, i).first->second;
    };
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) vertex(i);
    for (const StandIn& standIn : standIns.list) {
        std::vector<Triangle> below, coarse;
        for (std::size_t k = standIn.node; k < shape.nodes[standIn.node].skip; ++k) {
            const TreeShape::Node& node = shape.nodes[k];
            for (std::size_t place = node.first; place < node.first + node.count; ++place) {
                const std::size_t i = 3 * std::size_t(shape.order[place]);
                below.push_back(
                    {vertex(mesh.indices[i]), vertex(mesh.indices[i + 1]), vertex(mesh.indices[i + 2])});
            }
        }
        for (std::size_t t = standIn.first; t < standIn.first + standIn.count; ++t) {
            coarse.push_back({vertex(standIns.indices[3 * t]), vertex(standIns.indices[3 * t + 1]),
                              vertex(standIns.indices[3 * t + 2])});
        }
        EXPECT_LE(2 * coarse.size(), below.size());
        EXPECT_EQ(rimOf(coarse), rimOf(below)) << standIn.node;
        for (std::size_t i = 0; i < below.size(); i += 16) {
            const glm::vec3& p = mesh.positions[below[i][0]];
            EXPECT_LE(distanceTo(coarse, mesh.positions, p), standIn.deviation + 1e-6f) << standIn.node;
        }
    }
}

class StandInsInPicturesTest : public studio::TechniqueTest {
  protected:
    static constexpr studio::PictureSize size{96, 72};

    /// A torus of 46,080 triangles over the ground.
    static studio::Scene denseTorus(float height_m) {
        studio::Scene scene = studio::makeBuiltin("torus");
        for (studio::Mesh& mesh : scene.meshes) {
            if (mesh.name != "torus") continue;
            const int material = mesh.material;
            mesh = studio::torus(1, 0.38f, 240, 96);
            mesh.name = "torus";
            mesh.material = material;
        }
        return studio::withMoment(std::move(scene), [height_m](studio::SceneMoment& moment) {
            for (studio::Instance& instance : moment.instances) {
                if (!studio::isGround(instance)) instance.worldFromMesh[3][1] = height_m;
            }
        });
    }

    static double count(const LightResult& result, std::string_view name) {
        return std::ranges::find(result.statistics.counts, name, &Statistic::name)->value;
    }
};

TEST_F(StandInsInPicturesTest, AreOffUnlessAskedFor) {
    EXPECT_EQ(count(render("exact", denseTorus(1.7f), size), "triangles of stand-ins"), 0);
    EXPECT_GT(
        count(render("exact", denseTorus(1.7f), size, {{"stand_ins", "true"}}), "triangles of stand-ins"), 0);
}

TEST_F(StandInsInPicturesTest, MoveEdgesByNoMoreThanTheyMay) {
    bool differs = false;
    for (const float height_m : {0.4f, 1.0f, 1.7f, 2.5f}) {
        const studio::Scene scene = denseTorus(height_m);
        for (const char* samples : {"64", "256", "1024"}) {
            const LightResult full = render("exact", scene, size, {{"samples", samples}});
            const LightResult coarse =
                render("exact", scene, size, {{"samples", samples}, {"stand_ins", "true"}});
            // Four edges of a ring at most cross the light: each a share of it, and a row of samples that it
            // is about to meet.
            const double across = std::sqrt(std::stod(samples));
            const double most = 4 * (EXACT_STAND_IN_SHIFT + 0.5) / across;
            const auto metrics = judge(full, coarse);
            EXPECT_LE(metrics.max, most) << height_m << " m, " << samples;
            EXPECT_LE(metrics.penumbra_rmse, 0.5 * EXACT_STAND_IN_SHIFT / across)
                << height_m << " m, " << samples;
            EXPECT_EQ(metrics.leak, 0) << height_m << " m, " << samples;
            EXPECT_GE(count(coarse, "largest error bound"), count(full, "largest error bound"));
            differs = differs || full.visibility.values != coarse.visibility.values;
        }
    }
    EXPECT_TRUE(differs);
}

TEST_F(StandInsInPicturesTest, RoomAndRoundsChangeNoBit) {
    const studio::Scene scene = denseTorus(1.7f);
    const LightResult plain = render("exact", scene, size, {{"stand_ins", "true"}});
    for (const Settings& settings :
         {Settings{{"tile_candidates", "1"}}, {{"tile_candidates", "7"}, {"round_work", "2000"}}}) {
        Settings all = settings;
        all.emplace_back("stand_ins", "true");
        EXPECT_EQ(plain.visibility.values, render("exact", scene, size, all).visibility.values);
    }
}

TEST_F(StandInsInPicturesTest, OfWhatIsDeformedThereAreNone) {
    const studio::Scene scene = denseTorus(1.7f);
    workbench().open(scene);
    const studio::SceneMoment moment = scene.at(0);
    workbench().scene().update(moment);
    workbench().frame().draw(workbench().scene(), moment, moment.cameras.front(), size.width_px,
                             size.height_px);
    ShadowInputs inputs = workbench().frame().shadowInputs(moment.lights.front());
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    inputs.casters = casters;
    const auto answer = [&](Technique& technique) {
        VisibilityBuffer visibility = workbench().frame().makeVisibility(moment.lights.front());
        technique.render(inputs, visibility);
        return workbench().frame().readVisibility(visibility).values;
    };
    const std::unique_ptr<Technique> exact = workbench().makeTechnique("exact");
    const std::unique_ptr<Technique> coarse = workbench().makeTechnique("exact");
    setParameter(*coarse, "stand_ins", "true");
    const auto full = answer(*exact);
    EXPECT_NE(answer(*coarse), full);

    // The same mesh, deformed once; and one that comes anew in each frame, as others.
    const auto dense = std::ranges::find_if(
        casters, [](const Caster& caster) { return caster.mesh->indices().size() > 3 * leastForStandIns; });
    ASSERT_NE(dense, casters.end());
    const std::vector<Vec3> first(dense->mesh->positions().begin(), dense->mesh->positions().end());
    std::vector<Vec3> positions = first;
    for (Vec3& p : positions) p.y *= 1.01f;
    Mesh deformed(workbench().device(), {.positions = first, .indices = dense->mesh->indices()});
    deformed.deform(positions);
    dense->mesh = &deformed;
    const auto fullDeformed = answer(*exact);
    EXPECT_EQ(answer(*coarse), fullDeformed);
    EXPECT_NE(fullDeformed, full);

    const Mesh again(workbench().device(), {.positions = first, .indices = deformed.indices()});
    dense->mesh = &again;
    EXPECT_EQ(answer(*coarse), full);
}

}  // namespace
}  // namespace penumbra::exact_visibility
