// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "studio/frame/frame_renderer.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class ExactVisibilityTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{120, 90};

    static LightResult exact(const Scene& scene, const Settings& settings = {}) {
        return render("exact", scene, size, settings);
    }
};

Scene withMeshes(const char* builtin, const std::function<void(Mesh&)>& change) {
    Scene scene = makeBuiltin(builtin);
    for (Mesh& mesh : scene.meshes) change(mesh);
    return scene;
}

// 0.02 is the error of 64 samples that the issue allows; 512 rays add 0.005 of their own.
TEST_F(ExactVisibilityTest, SixtyFourSamplesAreNearTheReferenceForEveryShapeOfLight) {
    for (const char* name : {"torus", "overlapping-blockers", "disk-and-sphere", "columns"}) {
        const Scene scene = makeBuiltin(name);
        const VisibilityMetrics metrics = judge(truth(scene, size, 512), exact(scene));
        EXPECT_LE(metrics.penumbra_rmse, 0.025) << name;
        EXPECT_EQ(metrics.false_shadow, 0) << name;
    }
    const Scene distant = withLight(makeBuiltin("primitives"), [](Light& light) {
        light.shape.shape = LightShape::distant;
        light.shape.angle_rad = 0.1f;
    });
    EXPECT_LE(judge(truth(distant, size, 512), exact(distant)).penumbra_rmse, 0.025);
}

// In four lattices, of which each adds to the cells.
TEST_F(ExactVisibilityTest, CellsOfARectangleAddUpToAllOfIt) {
    class Cells final : public InspectionVisitor {
      public:
        void texture(const InspectedTexture& inspected) override {
            if (inspected.name == "cells") found = inspected;
        }
        InspectedTexture found;
    } cells;
    const Scene scene = makeBuiltin("textured-window");
    const Scene plain = makeBuiltin("half-plane");
    const auto technique = workbench().makeTechnique("exact");
    setParameter(*technique, "samples", "1024");
    setParameter(*technique, "cells", "3");
    render(*technique, scene, size);
    technique->inspect(cells);
    EXPECT_EQ(cells.found.texture, 0u) << "a textured light has none";

    const LightResult whole = render(*technique, plain, size);
    technique->inspect(cells);
    ASSERT_EQ(cells.found.layers, 9);
    const Image texels = readTexture(cells.found.texture, size.width_px, 9 * size.height_px, 2);
    const std::size_t pixels = whole.visibility.values.size();
    std::size_t counted = 0, uneven = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        float seen = 0, all = 0, least = 1, most = 0;
        for (std::size_t cell = 0; cell < 9; ++cell) {
            // Pictures are read from the top, so that the last layer is the first.
            const float* const weights = &texels.values[2 * ((8 - cell) * pixels + pixel)];
            seen += weights[0];
            all += weights[1];
            if (weights[1] == 0) continue;
            least = std::min(least, weights[0] / weights[1]);
            most = std::max(most, weights[0] / weights[1]);
        }
        if (all == 0) continue;
        ++counted;
        uneven += least == 0 && most == 1 ? 1 : 0;
        EXPECT_NEAR(whole.visibility.values[pixel], seen / all, 1e-6f);
    }
    EXPECT_GT(counted, 200u);
    EXPECT_GT(uneven, 50u) << "an edge hides some cells, and others not";
    EXPECT_EQ(exact(plain, {{"samples", "1024"}}).visibility.values, whole.visibility.values);
}

// Thin and far, thick and close to the blockers, seen from past an end.
TEST_F(ExactVisibilityTest, TubesAreNearTheReference) {
    for (const char* name : {"two-boxes", "primitives", "columns"}) {
        for (const auto& [length_m, radius_m] : {std::pair{2.0f, 0.02f}, {1.0f, 0.4f}, {0.2f, 0.5f}}) {
            const Scene scene =
                withLight(makeBuiltin(name), [&, length = length_m, radius = radius_m](Light& light) {
                    light.shape.shape = LightShape::cylinder;
                    light.shape.length_m = length;
                    light.shape.radius_m = radius;
                });
            const LightResult reference = truth(scene, size, 512);
            const VisibilityMetrics metrics = judge(reference, exact(scene, {{"samples", "256"}}));
            EXPECT_LE(metrics.penumbra_rmse, 0.025) << name << ", " << length_m << " x " << radius_m;
            EXPECT_LE(metrics.false_shadow, 0.001) << name << ", " << length_m << " x " << radius_m;
            const Scene turned = withLight(scene, [](Light& light) {
                auto& columns = light.shape.worldFromLight.columns;
                std::swap(columns[1], columns[2]);
                for (float& value : columns[1]) value = -value;
            });
            EXPECT_LE(shareOfDifferentPixels(exact(scene), exact(turned), 0.04f), 0.002)
                << "turned about its axis";
        }
    }
}

// Cones of more than 60 degrees to the axis are looked at through a cube: a sky, and from inside a sphere.
TEST_F(ExactVisibilityTest, WideConesAreNearTheReference) {
    const auto wide = [](LightShape shape) {
        return withLight(makeBuiltin("two-boxes"), [&](Light& light) {
            light.shape.shape = shape;
            light.shape.angle_rad = 3.0f;
            light.shape.radius_m = 40;
        });
    };
    for (const LightShape shape : {LightShape::distant, LightShape::sphere}) {
        const LightResult result = exact(wide(shape));
        EXPECT_LE(judge(truth(wide(shape), size, 512), result).rmse, 0.03) << int(shape);
    }
}

TEST_F(ExactVisibilityTest, MoreSamplesAreBetter) {
    const Scene scene = makeBuiltin("overlapping-blockers");
    const LightResult reference = truth(scene, size, 2048);
    const auto error = [&](const char* samples) {
        return judge(reference, exact(scene, {{"samples", samples}})).penumbra_rmse;
    };
    // Of lattices the error falls faster than the root of their number: a quarter for 16 times as many at
    // most.
    EXPECT_LT(error("256"), 0.25 * error("16"));
    EXPECT_LE(error("256"), 0.01);
}

TEST_F(ExactVisibilityTest, RoomAndRoundsChangeNoBit) {
    for (const char* name : {"overlapping-blockers", "columns"}) {
        const Scene scene = makeBuiltin(name);
        const LightResult plain = exact(scene);
        EXPECT_EQ(plain.visibility.values, exact(scene, {{"tile_candidates", "1"}}).visibility.values)
            << name;
        EXPECT_EQ(plain.visibility.values,
                  exact(scene, {{"tile_candidates", "7"}, {"round_work", "2000"}}).visibility.values)
            << name;
    }
}

TEST_F(ExactVisibilityTest, WindingOrderDuplicatesAndDegeneratesChangeNoBit) {
    const LightResult plain = exact(makeBuiltin("torus"));
    const Scene flipped = withMeshes("torus", [](Mesh& mesh) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 6)
            std::swap(mesh.indices[i], mesh.indices[i + 1]);
    });
    EXPECT_EQ(plain.visibility.values, exact(flipped).visibility.values);
    const Scene doubled = withMeshes("torus", [](Mesh& mesh) {
        const auto indices = mesh.indices;
        mesh.indices.insert(mesh.indices.end(), indices.begin(), indices.end());
    });
    EXPECT_EQ(plain.visibility.values, exact(doubled).visibility.values);
    const Scene reordered = withMeshes("torus", [](Mesh& mesh) {
        const auto third = std::ptrdiff_t(mesh.indices.size() / 9 * 3);
        std::rotate(mesh.indices.begin(), mesh.indices.begin() + third, mesh.indices.end());
    });
    EXPECT_EQ(plain.visibility.values, exact(reordered).visibility.values);
    const Scene withoutArea = withMeshes("torus", [](Mesh& mesh) {
        for (std::size_t i = 0; i < 300; i += 3) {
            const unsigned a = mesh.indices[i], b = mesh.indices[i + 1];
            mesh.indices.insert(mesh.indices.end(), {a, b, b, a, a, a});
        }
    });
    EXPECT_EQ(plain.visibility.values, exact(withoutArea).visibility.values);
}

// A sheet of 3,200 triangles of all shapes, up to `height_m` high, between the receivers around x = z = 0 and
// the light of half-plane; those that `keep` says.
Scene sheet(float height_m, const std::function<bool(unsigned)>& keep) {
    Scene scene = makeBuiltin("half-plane");
    const auto mesh = std::ranges::find(scene.meshes, "half-plane", &Mesh::name);
    constexpr unsigned n = 40;
    mesh->positions.clear();
    mesh->indices.clear();
    mesh->uvs.clear();
    for (unsigned i = 0; i <= n; ++i) {
        for (unsigned j = 0; j <= n; ++j) {
            // Up to 0.45 of a cell away from a grid of 6 x 6 m; the mesh stands at x = -10 m.
            const auto moved = [&](unsigned k) {
                return (float((i * 7919 + j * 104729 + k * 7877) % 97) / 97 - 0.5f) * 0.9f / n;
            };
            mesh->positions.emplace_back(10 + 6 * (float(i) / n - 0.5f + moved(1)), height_m * n * moved(2),
                                         6 * (float(j) / n - 0.5f + moved(3)));
        }
    }
    mesh->normals.assign(mesh->positions.size(), glm::vec3(0, 1, 0));
    for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < n; ++j) {
            const unsigned a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
            if (keep(2 * (i * n + j))) mesh->indices.insert(mesh->indices.end(), {a, b, c});
            if (keep(2 * (i * n + j) + 1)) mesh->indices.insert(mesh->indices.end(), {c, b, d});
        }
    }
    return scene;
}

// Triangles that share an edge must leave no gap: all of them hide every one of 256 samples.
TEST_F(ExactVisibilityTest, SheetOfTrianglesHasNoHoles) {
    const LightResult result = exact(sheet(0.1f, [](unsigned) { return true; }), {{"samples", "256"}});
    for (int y = size.height_px / 3; y < size.height_px; ++y) {
        for (int x = size.width_px / 4; x < 3 * size.width_px / 4; ++x)
            ASSERT_EQ(result.visibility.at(x, y), 0);
    }
}

// Babinet's principle, and no tolerance: what some triangles of a flat sheet hide the others let through. A
// sample that two triangles hid, or none, would show. 256 samples, so that shares are exact in floating
// point.
TEST_F(ExactVisibilityTest, ComplementaryScreensAddUpToOne) {
    const auto chosen = [](unsigned triangle) { return triangle * 2654435761u >> 31 != 0; };
    const Settings settings = {{"samples", "256"}};
    const LightResult some = exact(sheet(0, chosen), settings);
    const LightResult others = exact(sheet(0, [&](unsigned k) { return !chosen(k); }), settings);
    int between = 0;
    for (int y = size.height_px / 3; y < size.height_px; ++y) {
        for (int x = size.width_px / 4; x < 3 * size.width_px / 4; ++x) {
            const float a = some.visibility.at(x, y), b = others.visibility.at(x, y);
            ASSERT_EQ(a + b, 1) << x << ", " << y;
            between += a > 0.25f && a < 0.75f;
        }
    }
    EXPECT_GT(between, 1000);
}

TEST_F(ExactVisibilityTest, LightOfSizeZeroIsTheReference) {
    for (const char* name : {"primitives", "columns", "cylinder"}) {
        const Scene scene = withLight(makeBuiltin(name), shrinkToPoint);
        // Pixels right on an edge, where rounding decides.
        EXPECT_LE(shareOfDifferentPixels(truth(scene, size), exact(scene), 0.5f), 0.001) << name;
    }
}

TEST_F(ExactVisibilityTest, LightInACasterLightsNothingOutside) {
    const Scene scene = withLight(makeBuiltin("two-boxes"), [](Light& light) {
        auto& place = light.shape.worldFromLight.columns[3];
        place = {0.35f, 0.8f, 0, 1};  // the middle of the lower box
        light.shape.width_m = light.shape.height_m = 0.2f;
        light.shape.twoSided = true;
    });
    EXPECT_EQ(judge(truth(scene, size, 64), exact(scene)).max, 0);
}

// Half of the light is in the box: faces cross its plane, and which samples they hide depends on where they
// end.
TEST_F(ExactVisibilityTest, FacesThroughTheLightAreNearTheReference) {
    for (const LightShape shape : {LightShape::rect, LightShape::sphere}) {
        const Scene scene = withLight(makeBuiltin("two-boxes"), [&](Light& light) {
            auto& place = light.shape.worldFromLight.columns[3];
            place = {0.35f + 0.9f, 0.8f, 0.1f, 1};
            light.shape.shape = shape;
            light.shape.width_m = light.shape.height_m = 0.8f;
            light.shape.radius_m = 0.3f;
            light.shape.twoSided = true;
        });
        const VisibilityMetrics metrics = judge(truth(scene, size, 1024), exact(scene, {{"samples", "256"}}));
        EXPECT_LE(metrics.rmse, 0.03) << int(shape);
    }
}

TEST_F(ExactVisibilityTest, IrradianceWeightIsTheReferences) {
    const Settings settings = {{"weight", "irradiance"}};
    const Scene scene = makeBuiltin("cylinder");
    const LightResult reference =
        render("reference", scene, size, {{"weight", "irradiance"}, {"samples", "1024"}});
    EXPECT_LE(judge(reference, exact(scene, settings)).penumbra_rmse, 0.025);
    // And it is not the same as by area.
    EXPECT_GT(shareOfDifferentPixels(exact(scene), exact(scene, settings), 0.02f), 0.01);
}

TEST_F(ExactVisibilityTest, MovingCastersAreFollowed) {
    const Scene scene = makeBuiltin("moving");
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("exact");
    render(*technique, scene, size, 0);
    const LightResult later = render(*technique, scene, size, 1.3);
    EXPECT_EQ(later.visibility.values, render("exact", scene, size, {}, 1.3).visibility.values);
    const LightResult again = render(*technique, scene, size, 0);
    EXPECT_EQ(again.visibility.values, render("exact", scene, size, {}, 0).visibility.values);
    EXPECT_NE(again.visibility.values, later.visibility.values);
}

const Picture stripes = {
    .name = "stripes", .width_px = 2, .height_px = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 0}};

/// The scene with stripes cut out of every mesh: 2 / `width_m` to the metre.
void cutStripes(Mesh& mesh, float width_m) {
    mesh.uvs.clear();
    for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x / width_m, 0.5f);
}

TEST_F(ExactVisibilityTest, HolesOfAlphaMasksLetLightThrough) {
    const Scene solid = makeBuiltin("two-boxes");
    Scene scene = withAlphaMask(solid, stripes);
    for (Mesh& mesh : scene.meshes) cutStripes(mesh, 0.5f);
    const LightResult reference = truth(scene, size, 512);
    EXPECT_LE(judge(reference, exact(scene)).penumbra_rmse, 0.04);
    EXPECT_GE(shareOfDifferentPixels(reference, truth(solid, size, 64), 0.5f), 0.02);
}

/// Primitives with a mesh of its own for each instance, every third striped and the others whole: by two
/// textures, or by each one's own copy of them.
Scene stripedPrimitives(bool ownTextures) {
    Scene scene = makeBuiltin("primitives");
    const std::vector<Instance> instances = scene.at(0).instances;
    const int firstPicture = int(scene.pictures.size()), firstTexture = int(scene.textures.size());
    scene.pictures.push_back(stripes);
    scene.pictures.push_back({.name = "whole", .width_px = 1, .height_px = 1, .rgba = {255, 255, 255, 255}});
    const int firstMesh = int(scene.meshes.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const int which = i % 3 == 0 ? 0 : 1;
        if (i < 2 || ownTextures) scene.textures.push_back({.picture = firstPicture + which});
        Mesh mesh = scene.meshes[std::size_t(instances[i].mesh)];
        cutStripes(mesh, 0.2f);
        if (!isGround(instances[i])) {
            mesh.material = int(scene.materials.size());
            scene.materials.push_back({.baseColorTexture = firstTexture + (ownTextures ? int(i) : which),
                                       .alpha = Material::Alpha::mask});
        }
        scene.meshes.push_back(std::move(mesh));
    }
    return withMoment(std::move(scene), [firstMesh](SceneMoment& moment) {
        for (std::size_t i = 0; i < moment.instances.size(); ++i)
            moment.instances[i].mesh = firstMesh + int(i);
    });
}

// More alpha textures than can be bound at a time are looked at in turns. In short rounds, with hardly any
// lists and for two lattices besides, so that work stops and goes on everywhere.
TEST_F(ExactVisibilityTest, AnyNumberOfAlphaTexturesIsLookedAt) {
    const Scene one = stripedPrimitives(false), many = stripedPrimitives(true);
    ASSERT_GT(many.textures.size(), 8u);
    const PictureSize small{48, 36};
    const auto values = [&](const Scene& scene, const Settings& settings) {
        return render("exact", scene, small, settings).visibility.values;
    };
    EXPECT_EQ(values(one, {}), values(many, {}));
    EXPECT_NE(values(one, {}), values(makeBuiltin("primitives"), {}));
    const Settings settings = {{"samples", "300"}, {"tile_candidates", "3"}, {"round_work", "8000"}};
    EXPECT_EQ(values(one, settings), values(many, settings));
}

// Half the share of neighbouring samples that differ in what they see: not a bound in the strict sense, but
// no pixel of these scenes, which have no details smaller than a cell, is further from the truth.
TEST_F(ExactVisibilityTest, ErrorBoundHolds) {
    for (const char* name : {"disk-over-ground", "columns"}) {
        const Scene scene = makeBuiltin(name);
        const LightResult result = exact(scene);
        const VisibilityMetrics metrics = judge(truth(scene, size, 1024), result);
        const auto statistic = [&](std::string_view wanted) {
            return std::ranges::find(result.statistics.counts, wanted, &Statistic::name)->value;
        };
        EXPECT_GE(statistic("largest error bound"), metrics.max) << name;
        EXPECT_GE(statistic("mean error bound"), metrics.penumbra_rmse) << name;
        EXPECT_LE(statistic("mean error bound"), 0.15) << name;  // useless if it were 1
        EXPECT_GT(statistic("memory"), 0);
    }
}

}  // namespace
}  // namespace penumbra::studio
