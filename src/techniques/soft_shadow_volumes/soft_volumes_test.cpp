// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using SoftVolumesTest = TechniqueTest;

constexpr PictureSize size{240, 180};
const Settings wedges = {{"method", "wedges"}};

double largestDifference(const LightResult& a, const LightResult& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.visibility.values.size(); ++i) {
        largest =
            std::max(largest, std::abs(double(a.visibility.values[i]) - double(b.visibility.values[i])));
    }
    return largest;
}

Scene withIndices(Scene scene, const std::function<void(std::vector<std::uint32_t>&)>& change) {
    for (Mesh& mesh : scene.meshes) change(mesh.indices);
    return scene;
}

/// The half-plane's scene with a sheet of n x n separate triangles for a blocker, each half of its cell: V is
/// a half wherever the light is seen through the sheet alone.
Scene sheetOfConfetti(int n, float size_m) {
    Scene scene = makeBuiltin("half-plane");
    Mesh& mesh = *std::ranges::find(scene.meshes, "half-plane", &Mesh::name);
    mesh = {.name = mesh.name, .material = mesh.material};
    const auto corner = [&](int i, int j) {
        // The mesh stands at x = -10 m.
        return glm::vec3(10 + size_m * (float(i) / float(n) - 0.5f), 0,
                         size_m * (float(j) / float(n) - 0.5f));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (const glm::vec3& p : {corner(i, j), corner(i, j + 1), corner(i + 1, j)}) {
                mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
                mesh.positions.push_back(p);
            }
        }
    }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    return scene;
}

TEST_F(SoftVolumesTest, OverlappingBlockersAreAUnion) {
    const Scene scene = makeBuiltin("overlapping-blockers");
    const VisibilityMetrics metrics = judge(truth(scene, size), render("soft-volumes", scene, size));
    EXPECT_LE(metrics.mae, 0.01);
    EXPECT_LE(metrics.penumbra_rmse, 0.03);
    // Wedges add them up (thesis, section 5).
    EXPECT_GT(judge(truth(scene, size), render("soft-volumes", scene, size, wedges)).penumbra_rmse,
              2 * metrics.penumbra_rmse);
}

TEST_F(SoftVolumesTest, LayersAndWedgesAgreeWhereBothAreRight) {
    // An open sheet, a single silhouette from everywhere on the light: both are the exact area, the one added
    // up in millionths.
    for (const char* name : {"half-plane", "disk-over-ground"}) {
        const Scene scene = makeBuiltin(name);
        const LightResult layers = render("soft-volumes", scene, size);
        EXPECT_LE(shareOfDifferentPixels(layers, render("soft-volumes", scene, size, wedges), 1e-3f), 0.002)
            << name;
    }
}

TEST_F(SoftVolumesTest, MarkingHalfWedgesLeavesOutNothing) {
    // Wherever the eye is, in a wedge too. What differs is the order in which floats add up; a pixel in a
    // thousand may lie on a wedge's own border.
    constexpr PictureSize small{120, 90};
    struct Look {
        glm::vec3 from, at;
    };
    // The second along the penumbra of the lower box's edge, in one of its half wedges.
    for (const Look& look :
         {Look{{3, 3, 5}, {0.2f, 0, -0.3f}}, Look{{1.65f, 0.03f, 0.4f}, {1.65f, 0, -0.6f}}}) {
        const Scene scene = withMoment(makeBuiltin("two-boxes"), [&](SceneMoment& moment) {
            moment.cameras.front().worldFromCamera =
                glm::inverse(glm::lookAt(look.from, look.at, glm::vec3(0, 1, 0)));
        });
        const LightResult unmarked = render("soft-volumes", scene, small, wedges);
        for (const char* counting : {"auto", "z-pass", "z-fail"}) {
            // From within a wedge its front is not seen.
            if (look.from.y < 1 && counting == std::string_view("z-pass")) continue;
            const Settings marked = {{"method", "wedges"}, {"marking", "stencil"}, {"counting", counting}};
            EXPECT_LE(shareOfDifferentPixels(unmarked, render("soft-volumes", scene, small, marked), 1e-4f),
                      0.001)
                << counting;
        }
    }
}

TEST_F(SoftVolumesTest, BytesOfTwelveBitsAddUpToTheFloats) {
    // Each of a few wedges a pixel is rounded to a 4,095th.
    const Scene scene = makeBuiltin("two-boxes");
    const Settings split = {{"method", "wedges"}, {"layer_format", "split"}};
    const LightResult floats = render("soft-volumes", scene, size, wedges);
    const LightResult bytes = render("soft-volumes", scene, size, split);
    EXPECT_LE(shareOfDifferentPixels(floats, bytes, 0.003f), 0);
    EXPECT_GT(shareOfDifferentPixels(floats, bytes, 1e-6f), 0.01) << "are they floats, too?";
}

TEST_F(SoftVolumesTest, CapsCloseOpenMeshesForLayersAndWedges) {
    // Boxes without one of their sides are the boxes again, but for what is seen through the missing side:
    // one that faces the camera is a fifteenth of what the light reaches.
    const auto boxWithout = [](std::ptrdiff_t first) {
        Scene scene = makeBuiltin("two-boxes");
        for (Mesh& mesh : scene.meshes) {
            const auto begin = mesh.indices.begin() + first;
            if (mesh.indices.size() == 36) mesh.indices.erase(begin, begin + 6);
        }
        return scene;
    };
    for (const char* method : {"layers", "wedges"}) {
        const LightResult whole =
            render("soft-volumes", makeBuiltin("two-boxes"), size, {{"method", method}});
        for (std::ptrdiff_t side = 0; side < 36; side += 6) {
            const LightResult capped = render("soft-volumes", boxWithout(side), size,
                                              {{"method", method}, {"open_meshes", "capped"}});
            EXPECT_LE(shareOfDifferentPixels(whole, capped, 0.02f), 0.08) << method << " " << side;
        }
    }
}

TEST_F(SoftVolumesTest, WindingAndDuplicatesAreNothingToIt) {
    const Scene plain = makeBuiltin("two-boxes");
    const Scene flipped = withIndices(plain, [](std::vector<std::uint32_t>& indices) {
        for (std::size_t i = 0; i + 2 < indices.size(); i += 6) std::swap(indices[i], indices[i + 1]);
    });
    const Scene doubled = withIndices(plain, [](std::vector<std::uint32_t>& indices) {
        const std::vector<std::uint32_t> copy = indices;
        indices.insert(indices.end(), copy.begin(), copy.end());
    });
    const LightResult result = render("soft-volumes", plain);
    EXPECT_LE(largestDifference(result, render("soft-volumes", flipped)), 1e-4);
    // Where a blocker covers less than lies between samples, nothing tells that it is there twice.
    EXPECT_LE(largestDifference(result, render("soft-volumes", doubled)), 1.0 / 64);
}

TEST_F(SoftVolumesTest, TilesOfVeryManyEdgesTakeSeveralRounds) {
    // 43,200 edges, nearly all of which a tile in the middle sees: many more than an invocation can go
    // through on llvmpipe, which would leave the rest out.
    constexpr PictureSize few{32, 24};
    const Scene scene = sheetOfConfetti(120, 0.8f);
    const LightResult result = render("soft-volumes", scene, few);
    const VisibilityMetrics metrics = judge(truth(scene, few, 1024), result);
    // 64 points say of a pattern finer than themselves what as many random ones would: 0.06 RMS.
    EXPECT_LE(metrics.mae, 0.06);
    EXPECT_LE(metrics.penumbra_rmse, 0.08);
    // How the work is divided changes nothing.
    EXPECT_EQ(result.visibility.values,
              render("soft-volumes", scene, few, {{"round_work", "3000"}}).visibility.values);
}

TEST_F(SoftVolumesTest, EdgesThatDoNotFitLeaveTheShadowOfTheCenter) {
    constexpr PictureSize few{32, 24};
    // 19,200 edges and the ground's four, where a mebibyte holds 16,384.
    const Scene scene = sheetOfConfetti(80, 0.8f);
    const auto withoutRoom = [](const LightResult& result) {
        const auto& counts = result.statistics.counts;
        const auto found =
            std::ranges::find(counts, "edges without room (shadows are hard)", &Statistic::name);
        return found == counts.end() ? 0 : found->value;
    };
    const LightResult small = render("soft-volumes", scene, few, {{"edge_memory", "1"}});
    EXPECT_EQ(withoutRoom(small), 19'204 - 16'384);
    // The light is over the horizon everywhere, so that nothing but the count at its centre tells.
    EXPECT_EQ(small.visibility.values,
              render("soft-volumes", withLight(scene, shrinkToPoint), few).visibility.values);
    const LightResult large = render("soft-volumes", scene, few, {{"edge_memory", "2"}});
    EXPECT_EQ(withoutRoom(large), 0);
    EXPECT_EQ(large.visibility.values, render("soft-volumes", scene, few).visibility.values);
}

TEST_F(SoftVolumesTest, SmallerVBuffersDoNotBleed) {
    const Scene scene = makeBuiltin("two-boxes");
    const LightResult exact = truth(scene, size, 64);
    const LightResult full = render("soft-volumes", scene, size);
    for (const char* part : {"half", "quarter"}) {
        const LightResult result = render("soft-volumes", scene, size, {{"v_buffer", part}});
        const VisibilityMetrics metrics = judge(exact, result);
        // Of lit pixels; most of those are the blur at contacts, which four pixels of a small picture are
        // wide.
        EXPECT_LE(metrics.false_shadow, 0.02) << part;
        EXPECT_LE(shareOfDifferentPixels(full, result, 0.25f), 0.03) << part;
    }
}

TEST_F(SoftVolumesTest, FrameBudgetChoosesTheVBuffersSize) {
    constexpr PictureSize small{64, 48};
    const Scene scene = makeBuiltin("two-boxes");
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("soft-volumes");
    const auto after = [&](const char* budget_ms) {
        setParameter(*technique, "frame_budget_ms", budget_ms);
        LightResult last;
        // Two steps, each after the times of five frames.
        for (int frame = 0; frame < 13; ++frame) last = render(*technique, scene, small);
        return last.visibility.values;
    };
    const auto ofSize = [&](const char* part) {
        return render("soft-volumes", scene, small, {{"v_buffer", part}}).visibility.values;
    };
    // No machine keeps to the first, and any to the second.
    EXPECT_EQ(after("0.0001"), ofSize("quarter"));
    EXPECT_EQ(after("1e6"), ofSize("full"));
    EXPECT_NE(ofSize("full"), ofSize("quarter"));
}

}  // namespace
}  // namespace penumbra::studio
