// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class SmoothiesTest : public TechniqueTest {
  public:
    using TechniqueTest::render;
};

const Settings asPublished = {{"inner", "false"}};

/// Looking straight down on a closed-form scene: see scenes_closed_form.cpp.
Scene fromAbove(std::string_view name) {
    return withMoment(makeBuiltin(name),
                      [](SceneMoment& moment) { moment.cameras.erase(moment.cameras.begin()); });
}

/// The ramp of the half-plane scene along x, where the truth is V = clamp(1/2 + x).
struct Ramp {
    std::vector<double> x, v;
};

Ramp rampOf(const Scene& scene, const Settings& settings) {
    constexpr PictureSize size{160, 90};
    const LightResult result = SmoothiesTest::render("smoothies", scene, size, settings);
    Ramp ramp;
    for (int i = 0; i < size.width_px; ++i) {
        ramp.x.push_back(((i + 0.5) / size.width_px - 0.5) * 3.0 * size.width_px / size.height_px);
        ramp.v.push_back(result.visibility.at(i, size.height_px / 2));
    }
    return ramp;
}

double largestError(const Ramp& ramp, const std::function<double(double)>& truth) {
    double largest = 0;
    for (std::size_t i = 0; i < ramp.x.size(); ++i) {
        largest = std::max(largest, std::abs(ramp.v[i] - truth(ramp.x[i])));
    }
    return largest;
}

// A texel of the map spans less than 0.01 m on the ground; bilinear filtering rounds the ramp's corners by as
// much.
constexpr double rampTolerance = 0.02;

TEST_F(SmoothiesTest, InnerHalfMakesTheRampOfAHalfPlane) {
    EXPECT_LE(largestError(rampOf(fromAbove("half-plane"), {}),
                           [](double x) { return std::clamp(0.5 + x, 0.0, 1.0); }),
              rampTolerance);
}

/// In perspective and from below, the light's window is tilted against the edge, which runs past the light's
/// plane.
TEST_F(SmoothiesTest, HalfPlaneIsRightFromBothCameras) {
    for (const Scene& scene : {makeBuiltin("half-plane"), fromAbove("half-plane")}) {
        EXPECT_LE(judge(truth(scene), render("smoothies", scene)).penumbra_rmse, rampTolerance);
    }
}

/// As published, a smoothie starts at the shadow's edge, and equation 1 makes it as wide as half the
/// penumbra.
TEST_F(SmoothiesTest, AsPublishedTheRampLiesOutsideTheEdge) {
    EXPECT_LE(largestError(rampOf(fromAbove("half-plane"), asPublished),
                           [](double x) { return std::clamp(2 * x, 0.0, 1.0); }),
              rampTolerance);
    EXPECT_LE(largestError(rampOf(fromAbove("half-plane"), {{"inner", "false"}, {"falloff", "sinusoidal"}}),
                           [](double x) {
                               return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(2 * x, 0.0, 1.0));
                           }),
              rampTolerance);
}

/// Without equation 1, alpha ignores the receiver: with the blocker half way, a fixed t makes shadows of
/// twice the width, since 1 - b/r = 1/2.
TEST_F(SmoothiesTest, EquationOneScalesAFixedSize) {
    const auto widthOf = [](const char* remap) {
        const Ramp ramp =
            rampOf(fromAbove("half-plane"),
                   {{"inner", "false"}, {"t", "0.25"}, {"remap", remap}, {"falloff", "linear"}});
        return double(std::ranges::count_if(ramp.v, [](double v) { return v > 0.02 && v < 0.98; }));
    };
    EXPECT_GT(widthOf("true"), 10);
    EXPECT_NEAR(widthOf("false") / widthOf("true"), 2, 0.15);
}

/// A distance t at 1 m from the light, times r - b: 2 m.
TEST_F(SmoothiesTest, TIsOfALightFrustumThatTheViewDoesNotChange) {
    constexpr float t = 0.1f;
    for (const float zoom : {0.5f, 1.0f, 4.0f}) {
        Scene scene = withMoment(fromAbove("half-plane"), [&](SceneMoment& moment) {
            *moment.cameras.front().orthographicHeight_m /= zoom;
        });
        Ramp ramp = rampOf(scene, {{"inner", "false"}, {"t", "0.1"}, {"falloff", "linear"}});
        for (double& x : ramp.x) x /= zoom;
        EXPECT_LE(largestError(ramp, [](double x) { return std::clamp(x / (2 * t), 0.0, 1.0); }), 0.06)
            << zoom;
    }
}

/// The paper's lights are points.
TEST_F(SmoothiesTest, TGivesLightsWithoutASizeTheirSmoothies) {
    for (const LightShape shape :
         {LightShape::rect, LightShape::disk, LightShape::sphere, LightShape::distant}) {
        const auto sized = [&](float scale) {
            return withLight(fromAbove("half-plane"), [&](Light& light) {
                shrinkToPoint(light);
                light.shape.shape = shape;
                light.shape.width_m = light.shape.height_m = light.shape.radius_m = light.shape.angle_rad =
                    scale;
            });
        };
        for (const char* falloff : {"light", "linear", "sinusoidal"}) {
            const Settings settings = {{"inner", "false"}, {"t", "0.1"}, {"falloff", falloff}};
            const Ramp point = rampOf(sized(0), settings), nearly = rampOf(sized(1e-4f), settings);
            double largest = 0;
            for (std::size_t i = 0; i < point.v.size(); ++i)
                largest = std::max(largest, std::abs(point.v[i] - nearly.v[i]));
            EXPECT_LE(largest, 0.01) << int(shape) << " " << falloff;
            EXPECT_GT(std::ranges::count_if(point.v, [](double v) { return v > 0.1 && v < 0.9; }), 3)
                << int(shape) << " " << falloff;
        }
    }
}

/// As the paper stores and filters alpha: what the edges tell, but for texels.
TEST_F(SmoothiesTest, StoredAlphaIsTheEdgesAlphaFiltered) {
    const Settings edges = {{"inner", "false"}, {"falloff", "linear"}, {"t", "0.1"}};
    Settings alpha = edges;
    alpha.emplace_back("buffer", "alpha");
    const Scene scene = fromAbove("half-plane");
    const Ramp worked = rampOf(scene, edges), stored = rampOf(scene, alpha);
    double largest = 0;
    for (std::size_t i = 0; i < worked.v.size(); ++i)
        largest = std::max(largest, std::abs(worked.v[i] - stored.v[i]));
    EXPECT_LE(largest, 0.06) << "a texel of some 7 mm of 200";
    EXPECT_GT(largest, 0) << "it is not the same thing";
    for (const char* name : {"primitives", "two-boxes", "columns"}) {
        Settings fine = edges, coarse = alpha;
        fine.emplace_back("map_size", "256");
        coarse.emplace_back("map_size", "256");
        const LightResult a = render("smoothies", makeBuiltin(name), defaultSize, fine);
        const LightResult b = render("smoothies", makeBuiltin(name), defaultSize, coarse);
        EXPECT_LE(shareOfDifferentPixels(a, b, 0.3f), 0.02) << name;
    }
}

/// A pixel brighter than all about it, by more than half.
int pinholes(const Image& visibility) {
    int count = 0;
    for (int y = 1; y + 1 < visibility.height_px; ++y) {
        for (int x = 1; x + 1 < visibility.width_px; ++x) {
            float brightest = 0;
            for (int i = 0; i < 9; ++i) {
                if (i != 4) brightest = std::max(brightest, visibility.at(x + i % 3 - 1, y + i / 3 - 1));
            }
            count += visibility.at(x, y) > brightest + 0.5f;
        }
    }
    return count;
}

TEST_F(SmoothiesTest, SilhouettesHaveNoPinholesAsPublished) {
    for (const char* name : {"primitives", "overlapping-blockers", "moving"}) {
        for (const char* buffer : {"edges", "alpha"}) {
            const LightResult result =
                render("smoothies", makeBuiltin(name), {320, 180}, {{"inner", "false"}, {"buffer", buffer}});
            // One is left, among texels that are all lit: see the README.
            const bool isLeft = std::string_view(name) == "moving" && std::string_view(buffer) == "edges";
            EXPECT_LE(pinholes(result.visibility), isLeft ? 1 : 0) << name << " " << buffer;
        }
    }
}

/// t of 0 is the default: widths come from the light. Next to nothing is another thing, a hard shadow whose
/// border is as wide as what is left of the map's texels; nothing is divided by t.
TEST_F(SmoothiesTest, ASizeOfZeroFollowsTheLightAndATinyOneIsHard) {
    const Scene scene = fromAbove("half-plane");
    EXPECT_EQ(rampOf(scene, {{"t", "0"}}).v, rampOf(scene, {}).v);
    const auto hard = [](double x) { return x < 0 ? 0.0 : 1.0; };
    for (const char* inner : {"true", "false"}) {
        const Ramp ramp = rampOf(scene, {{"t", "1e-30"}, {"inner", inner}});
        for (std::size_t i = 0; i < ramp.x.size(); ++i) {
            if (std::abs(ramp.x[i]) <= rampTolerance) continue;
            EXPECT_EQ(ramp.v[i], hard(ramp.x[i])) << ramp.x[i];
        }
    }
}

/// Disk lights, by the closed form C2.
TEST_F(SmoothiesTest, DiskLightsHaveTheirOwnRamp) {
    const Scene scene = withLight(fromAbove("half-plane"), [](Light& light) {
        light.shape.shape = LightShape::disk;
        light.shape.radius_m = 0.5f;
    });
    EXPECT_LE(largestError(rampOf(scene, {}),
                           [](double x) {
                               const double d = std::clamp(-x / 0.5, -1.0, 1.0);
                               return (std::acos(d) - d * std::sqrt(1 - d * d)) / std::numbers::pi;
                           }),
              rampTolerance);
}

/// 0.06 is what the technique promises; boxes have nothing that bends.
TEST_F(SmoothiesTest, SmallLightsAreNearTheTruth) {
    for (const auto& [name, limit] :
         {std::pair{"primitives", 0.06}, std::pair{"two-boxes", 0.03}, std::pair{"columns", 0.03}}) {
        const Scene scene = makeBuiltin(name);
        const LightResult exact = truth(scene, {240, 180});
        EXPECT_LE(judge(exact, render("smoothies", scene, {240, 180})).penumbra_rmse, limit) << name;
    }
}

/// Figure 8: the umbra of the published method does not shrink.
TEST_F(SmoothiesTest, InnerHalfBeatsThePublishedMethodUnderALargeLight) {
    const Scene scene = makeBuiltin("cylinder");
    const LightResult exact = truth(scene);
    const double published = judge(exact, render("smoothies", scene, defaultSize, asPublished)).penumbra_rmse;
    EXPECT_LE(judge(exact, render("smoothies", scene)).penumbra_rmse, 0.6 * published);
}

/// Figure 7: edges stay smooth where the map is coarse.
TEST_F(SmoothiesTest, CoarseMapsDoNotShow) {
    const Scene scene = fromAbove("half-plane");
    EXPECT_LE(largestError(rampOf(scene, {{"map_size", "64"}}),
                           [](double x) { return std::clamp(0.5 + x, 0.0, 1.0); }),
              0.06);  // a texel spans 0.1 m there
}

TEST_F(SmoothiesTest, EveryCornerOfACubeOfMapsMeets) {
    const Scene scene = makeBuiltin("columns");
    const std::unique_ptr<Technique> smoothies = workbench().makeTechnique("smoothies");
    const LightResult result = render(*smoothies, scene);
    ASSERT_GT(result.statistics.counts.front().value, 1) << "maps";
    const VisibilityMetrics metrics = judge(truth(scene), result);
    EXPECT_LE(metrics.leak, 0.005);
    EXPECT_LE(metrics.false_shadow, 0.005);
}

/// Winding triangles at random, and taking away the faces that the light cannot see, changes no shadow.
TEST_F(SmoothiesTest, BlockersNeedNeitherBeClosedNorOriented) {
    const Scene closed = makeBuiltin("two-boxes");
    const LightResult plain = render("smoothies", closed);
    Scene flipped = closed, open = closed;
    for (Mesh& mesh : flipped.meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 6)
            std::swap(mesh.indices[i], mesh.indices[i + 1]);
    }
    for (Mesh& mesh : open.meshes) {
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i]];
            const glm::vec3 normal =
                glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
            if (normal.y >= -0.5f * glm::length(normal)) {
                kept.insert(kept.end(), {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
            }
        }
        mesh.indices = kept;
    }
    EXPECT_LE(shareOfDifferentPixels(plain, render("smoothies", flipped), 0.05f), 0.005);
    EXPECT_LE(shareOfDifferentPixels(plain, render("smoothies", open), 0.05f), 0.005);
}

TEST_F(SmoothiesTest, MirroredInstancesCastMirroredShadows) {
    const auto scaled = [](float x) {
        return withMoment(makeBuiltin("two-boxes"), [=](SceneMoment& moment) {
            for (Instance& instance : moment.instances) instance.worldFromMesh[0] *= x;
        });
    };
    // The boxes are symmetric: mirrored, they are themselves, wound the other way.
    EXPECT_LE(shareOfDifferentPixels(render("smoothies", scaled(1)), render("smoothies", scaled(-1)), 0.02f),
              0.002);
}

TEST_F(SmoothiesTest, ASizeOfZeroIsTheHardShadow) {
    const Scene scene = withLight(makeBuiltin("primitives"), shrinkToPoint);
    EXPECT_EQ(render("smoothies", scene, defaultSize, {{"map_size", "1024"}}).visibility.values,
              render("hard", scene, defaultSize, {{"map_size", "1024"}}).visibility.values);
}

/// Figure 7, along the edge: where V crosses 1/2 must not follow the texels. The edge lies askew to the map,
/// and its penumbra spans 5 texels, the least that the figure shows.
TEST_F(SmoothiesTest, CoarseMapsDoNotMakeStairs) {
    constexpr double angle_rad = 0.3;
    const Scene scene = withMoment(fromAbove("half-plane"), [](SceneMoment& moment) {
        moment.lights.front().shape.width_m = moment.lights.front().shape.height_m = 0.1f;
        for (Instance& instance : moment.instances) {
            if (!isGround(instance) && instance.worldFromMesh[3].y > 1) {
                const float c = float(std::cos(angle_rad)), s = float(std::sin(angle_rad));
                instance.worldFromMesh[0] = {c, 0, s, 0};
                instance.worldFromMesh[2] = {-s, 0, c, 0};
                instance.worldFromMesh[3] = {-10 * c, 2, -10 * s, 1};
            }
        }
    });
    const auto stairsOf_m = [&](std::string_view name) {
        constexpr PictureSize size{480, 360};
        const Image v = render(name, scene, size, {{"map_size", "256"}}).visibility;
        double squares = 0;
        for (int y = 0; y < size.height_px; ++y) {
            const double posZ = ((y + 0.5) / size.height_px - 0.5) * 3;
            const auto posX = [&](double x) { return ((x + 0.5) / size.width_px - 0.5) * 4; };
            int x = 0;
            while (x + 1 < size.width_px && v.at(x + 1, y) < 0.5f) ++x;
            const double step = v.at(x + 1, y) - v.at(x, y);
            const double crossing = posX(x + (step > 0 ? (0.5 - v.at(x, y)) / step : 0));
            squares += std::pow(crossing * std::cos(angle_rad) + posZ * std::sin(angle_rad), 2);
        }
        return std::sqrt(squares / size.height_px);
    };
    const double stairs_m = stairsOf_m("smoothies"), hard_m = stairsOf_m("hard"), pcf_m = stairsOf_m("pcf");
    RecordProperty("stairs_mm", std::to_string(1e3 * stairs_m) + ", hard " + std::to_string(1e3 * hard_m) +
                                    ", pcf " + std::to_string(1e3 * pcf_m));
    EXPECT_LE(stairs_m, 0.25 * hard_m) << hard_m;
    EXPECT_LE(stairs_m, 0.5 * pcf_m) << pcf_m;
}

/// Silhouettes of coarse meshes jump from edge to edge; shadows must not. Visibility moves anyway: what
/// counts is the part of a step that the truth does not take.
TEST_F(SmoothiesTest, MovesWithoutPopping) {
    const Scene scene = makeBuiltin("moving");
    constexpr PictureSize size{96, 72};
    const auto rendersOf = [&](std::string_view name) {
        const std::unique_ptr<Technique> technique = workbench().makeTechnique(name);
        if (name == "reference")
            setParameter(*technique, "samples", "1024");  // its noise would count as flicker
        std::vector<Image> frames;
        for (int frame = 0; frame <= 4; ++frame) {
            frames.push_back(render(*technique, scene, size, 1.0 + frame / 60.0).visibility);
        }
        return frames;
    };
    const std::vector<Image> exact = rendersOf("reference");
    const auto flickerOf = [&](std::string_view name) {
        const std::vector<Image> frames = rendersOf(name);
        double squares = 0;
        for (std::size_t frame = 1; frame < frames.size(); ++frame) {
            for (std::size_t i = 0; i < frames[frame].values.size(); ++i) {
                const double step = frames[frame].values[i] - frames[frame - 1].values[i];
                const double truthStep = exact[frame].values[i] - exact[frame - 1].values[i];
                squares += std::pow(step - truthStep, 2);
            }
        }
        return std::sqrt(squares / double((frames.size() - 1) * frames[0].values.size()));
    };
    double squares = 0;
    for (std::size_t frame = 1; frame < exact.size(); ++frame) {
        for (std::size_t i = 0; i < exact[frame].values.size(); ++i) {
            squares += std::pow(exact[frame].values[i] - exact[frame - 1].values[i], 2);
        }
    }
    const double own = std::sqrt(squares / double((exact.size() - 1) * exact[0].values.size()));
    const double flicker = flickerOf("smoothies"), flickerOfHard = flickerOf("hard");
    RecordProperty("flicker", std::to_string(flicker) + ", hard " + std::to_string(flickerOfHard) +
                                  ", the truth's own " + std::to_string(own));
    // A hard shadow's border jumps from pixel to pixel.
    EXPECT_LE(flicker, 0.5 * flickerOfHard) << flickerOfHard;
    // What a still picture would miss of the truth's motion.
    EXPECT_LE(flicker, own);
}

}  // namespace
}  // namespace penumbra::studio
