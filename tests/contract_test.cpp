// SPDX-License-Identifier: Apache-2.0
// What every technique of the catalog promises. A new one joins by being in the catalog.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "src/catalog.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class Contract : public TechniqueTest, public ::testing::WithParamInterface<std::string> {
  protected:
    std::string_view name() const { return GetParam(); }
    /// For promises that hold with any settings and are tested in many scenes: `uniform` draws 25 maps there
    /// instead of 289.
    Settings quick() const { return name() == "uniform" ? Settings{{"samples", "5"}} : Settings{}; }
};

INSTANTIATE_TEST_SUITE_P(Catalog, Contract, everyTechnique(), techniqueTestName);

Scene withoutCasters(Scene scene) {
    return withMoment(std::move(scene), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.casts = false;
    });
}

void expectInRange(const Image& visibility) {
    for (std::size_t i = 0; i < visibility.values.size(); ++i) {
        const float v = visibility.values[i];
        ASSERT_TRUE(v >= 0 && v <= 1) << "visibility " << v << " at value " << i;
    }
}

void growToTwice(Light& light) {
    light.shape.width_m *= 2;
    light.shape.height_m *= 2;
    light.shape.length_m *= 2;
    light.shape.radius_m *= 2;
    light.shape.angle_rad *= 2;
}

/// Looking straight down on the half-plane scene, where V = clamp(1/2 + x): see scenes_closed_form.cpp.
Scene halfPlaneFromAbove() {
    return withMoment(makeBuiltin("half-plane"),
                      [](SceneMoment& moment) { moment.cameras.erase(moment.cameras.begin()); });
}

double halfPlaneX(int column, PictureSize size) {
    const double width_m = 3.0 * size.width_px / size.height_px;
    return ((column + 0.5) / size.width_px - 0.5) * width_m;
}

TEST_P(Contract, EverythingIsLitWithoutCasters) {
    for (const char* scene : {"primitives", "columns", "many-lights"}) {
        SCOPED_TRACE(scene);
        const Scene empty = withoutCasters(makeBuiltin(scene));
        const LightResult result = render(name(), empty, defaultSize, quick());
        // 1 where the light's centre is above the horizon, 0 where all of it is below. In between the truth
        // is 1 too, but techniques that look from the centre alone cannot know.
        const LightResult ofCenter = truth(withLight(empty, shrinkToPoint), defaultSize, 2);
        // Judged by a light twice as large: of that a good part is above wherever a sliver of the light
        // itself is, and no ray need hit the sliver.
        const LightResult ofLight = truth(withLight(empty, growToTwice), defaultSize, 64);
        for (std::size_t i = 0; i < result.visibility.values.size(); ++i) {
            if (ofCenter.visibility.values[i] == 1) {
                ASSERT_NEAR(result.visibility.values[i], 1, 1e-6) << "value " << i;
            } else if (ofLight.visibility.values[i] == 0 && result.reach.values[i] == 0) {
                // Two rays may both miss what little of the light is above: that nothing arrives must be
                // known, too.
                ASSERT_NEAR(result.visibility.values[i], 0, 1e-6) << "value " << i;
            }
        }
    }
}

TEST_P(Contract, VisibilityLiesBetweenZeroAndOneInEveryBuiltinScene) {
    for (const BuiltinInfo& info : builtinScenes()) {
        SCOPED_TRACE(info.name);
        expectInRange(render(name(), makeBuiltin(info.name), {96, 72}, quick(), 0.7).visibility);
    }
}

TEST_P(Contract, EveryLightShapeAndSideWorks) {
    for (const LightShape shape : {LightShape::rect, LightShape::disk, LightShape::sphere,
                                   LightShape::distant, LightShape::cylinder}) {
        for (const bool twoSided : {false, true}) {
            const Scene scene = withLight(makeBuiltin("two-boxes"), [&](Light& light) {
                light.shape.shape = shape;
                light.shape.length_m = 1.2f;
                light.shape.radius_m = 0.3f;
                light.shape.angle_rad = 0.1f;
                light.shape.twoSided = twoSided;
            });
            expectInRange(render(name(), scene, {64, 48}, quick()).visibility);
        }
    }
}

TEST_P(Contract, SeveralLightsAtOnceGetTheBitsOfEachByItself) {
    const Scene scene = withMoment(makeBuiltin("many-lights"), [](SceneMoment& moment) {
        moment.lights[1].castsShadow = false;
        moment.lights[2].shape.shape = LightShape::cylinder;
        moment.lights[2].shape.length_m = 0.6f;
        moment.lights[2].shape.radius_m = 0.05f;
    });
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const auto make = [&] {
        std::unique_ptr<Technique> technique = workbench().makeTechnique(name());
        for (const auto& [key, value] : quick()) setParameter(*technique, key, value);
        return technique;
    };
    const std::unique_ptr<Technique> together = make();
    const TechniqueResult result =
        workbench().run(name(), *together, moment, moment.cameras.front(), {64, 48});
    for (std::size_t i = 0; i < moment.lights.size(); ++i) {
        const Light& light = moment.lights[i];
        VisibilityBuffer out = workbench().frame().makeVisibility(light);
        make()->render(workbench().frame().shadowInputs(light), out);
        EXPECT_EQ(workbench().frame().readVisibility(out).values, result.lights[i].visibility.values)
            << light.name;
    }
}

TEST_P(Contract, LightOfSizeZeroIsAHardShadow) {
    // What is left is the map's resolution along shadow edges: at most 2 % of the pixels of these small
    // pictures.
    for (const char* builtin : {"primitives", "two-boxes", "torus"}) {
        const Scene scene = withLight(makeBuiltin(builtin), shrinkToPoint);
        EXPECT_LE(shareOfDifferentPixels(truth(scene), render(name(), scene), 0.5f), 0.02) << builtin;
    }
}

Scene withTube(Scene scene, float length_m, float radius_m) {
    return withLight(std::move(scene), [=](Light& light) {
        light.shape.shape = LightShape::cylinder;
        light.shape.length_m = length_m;
        light.shape.radius_m = radius_m;
    });
}

TEST_P(Contract, TubesOfNoSizeAreHardShadows) {
    const Scene sphere = withLight(makeBuiltin("two-boxes"), [](Light& light) {
        light.shape.shape = LightShape::sphere;
        light.shape.radius_m = 0;
    });
    const LightResult hard = render(name(), sphere);
    EXPECT_EQ(render(name(), withTube(sphere, 0, 0)).visibility.values, hard.visibility.values);
    EXPECT_LE(shareOfDifferentPixels(truth(sphere), render(name(), withTube(sphere, 1e-3f, 1e-4f)), 0.5f),
              0.02);
}

TEST_P(Contract, TubesAreLitWithoutCastersAndAlikeHoweverTheyAreTurnedAboutTheirAxis) {
    const Scene tube = withTube(makeBuiltin("two-boxes"), 0.8f, 0.05f);
    const Scene empty = withoutCasters(tube);
    const LightResult lit = render(name(), empty, defaultSize, quick());
    const LightResult ofCenter = truth(withTube(withLight(empty, shrinkToPoint), 0, 0), defaultSize, 2);
    for (std::size_t i = 0; i < lit.visibility.values.size(); ++i) {
        if (ofCenter.visibility.values[i] != 1) continue;
        ASSERT_NEAR(lit.visibility.values[i], 1, 1e-6) << "value " << i;
    }
    const LightResult one = render(name(), tube, defaultSize, quick());
    const LightResult turned = render(name(),
                                      withLight(tube,
                                                [](Light& light) {
                                                    auto& columns = light.shape.worldFromLight.columns;
                                                    std::swap(columns[1], columns[2]);
                                                    for (float& value : columns[1]) value = -value;
                                                }),
                                      defaultSize, quick());
    EXPECT_LE(shareOfDifferentPixels(one, turned, 0.05f), 0.005);
}

TEST_P(Contract, TubesHaveTheRampOfAHalfPlane) {
    // As long as the scene's rect is wide, across the edge: the same ramp along it.
    constexpr PictureSize size{160, 90};
    const Scene scene = withTube(halfPlaneFromAbove(), 1, 0.02f);
    const LightResult result = render(name(), scene, size);
    for (int x = 0; x < size.width_px; ++x) {
        const float visibility = result.visibility.at(x, size.height_px / 2);
        const double posX = halfPlaneX(x, size);
        EXPECT_TRUE(posX > -0.6 || visibility <= 0.05f) << visibility << " at x = " << posX << " m, in umbra";
        EXPECT_TRUE(posX < 0.6 || visibility >= 0.95f) << visibility << " at x = " << posX << " m, lit";
    }
}

TEST_P(Contract, RampOfAHalfPlaneIsAsGoodAsPromised) {
    constexpr PictureSize size{160, 90};
    const LightResult result = render(name(), halfPlaneFromAbove(), size);
    double squares = 0;
    int samples = 0;
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            const double truth = 0.5 + halfPlaneX(x, size);
            if (truth <= 0.01 || truth >= 0.99) continue;
            squares += std::pow(result.visibility.at(x, y) - truth, 2);
            ++samples;
        }
    }
    ASSERT_GT(samples, 1000);
    EXPECT_LE(std::sqrt(squares / samples), rampRmseOf(name()));
}

TEST_P(Contract, UmbraAndLitAreasOfAHalfPlaneAreRight) {
    constexpr PictureSize size{160, 90};
    const LightResult result = render(name(), halfPlaneFromAbove(), size);
    for (int x = 0; x < size.width_px; ++x) {
        // A tenth of a metre clear of the penumbra, which spans one.
        const float visibility = result.visibility.at(x, size.height_px / 2);
        const double posX = halfPlaneX(x, size);
        EXPECT_TRUE(posX > -0.6 || visibility <= 0.05f) << visibility << " at x = " << posX << " m, in umbra";
        EXPECT_TRUE(posX < 0.6 || visibility >= 0.95f) << visibility << " at x = " << posX << " m, lit";
    }
}

TEST_P(Contract, SameInputGivesSameBits) {
    const Scene scene = makeBuiltin("primitives");
    const LightResult first = render(name(), scene);
    EXPECT_EQ(first.visibility.values, render(name(), scene).visibility.values);
}

TEST_P(Contract, PicturesOfAnySizeAgree) {
    const Scene scene = makeBuiltin("two-boxes");
    for (const PictureSize size : {PictureSize{1, 1}, PictureSize{1, 33}, PictureSize{67, 5}}) {
        expectInRange(render(name(), scene, size).visibility);
    }
}

TEST_P(Contract, BackgroundAndNonReceiversAreFullyVisible) {
    const Scene scene = withMoment(makeBuiltin("two-boxes"), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.receives = false;
    });
    const LightResult result = render(name(), scene);
    EXPECT_TRUE(std::ranges::all_of(result.visibility.values, [](float v) { return v == 1; }));
}

TEST_P(Contract, EmptySceneIsFullyVisible) {
    Scene scene = withMoment(makeBuiltin("two-boxes"), [](SceneMoment& moment) { moment.instances.clear(); });
    const LightResult result = render(name(), scene);
    EXPECT_TRUE(std::ranges::all_of(result.visibility.values, [](float v) { return v == 1; }));
}

TEST_P(Contract, ZeroAreaTrianglesChangeNothing) {
    const Scene plain = makeBuiltin("two-boxes");
    Scene degenerate = makeBuiltin("two-boxes");
    for (Mesh& mesh : degenerate.meshes) {
        mesh.indices.insert(mesh.indices.end(), {0, 0, 0, 0, 1, 1, 1, 0, 1});
    }
    EXPECT_EQ(render(name(), plain).visibility.values, render(name(), degenerate).visibility.values);
}

TEST_P(Contract, NastyPlacesStayInRange) {
    const auto placed = [](glm::vec3 posWorld, float size_m) {
        return withLight(makeBuiltin("two-boxes"), [=](Light& light) {
            auto& columns = light.shape.worldFromLight.columns;
            columns[3] = {posWorld.x, posWorld.y, posWorld.z, 1};
            light.shape.width_m = light.shape.height_m = size_m;
        });
    };
    // Inside a box, in the ground's plane, below the ground, larger than the scene, very small, far away.
    for (const auto& [posWorld, size_m] :
         {std::pair{glm::vec3(0, 0.3f, 0), 0.2f}, std::pair{glm::vec3(0.5f, 0, 0.5f), 0.2f},
          std::pair{glm::vec3(0, -1, 0), 0.5f}, std::pair{glm::vec3(0, 3, 0), 50.0f},
          std::pair{glm::vec3(0, 3, 0), 1e-6f}, std::pair{glm::vec3(0, 1e5f, 0), 1.0f}}) {
        SCOPED_TRACE(testing::Message() << "light of " << size_m << " m at y = " << posWorld.y);
        expectInRange(render(name(), placed(posWorld, size_m), {64, 48}, quick()).visibility);
    }
}

TEST_P(Contract, MirroredAndFlattenedInstancesStayInRange) {
    for (const glm::vec3 scale : {glm::vec3(-1, 1, 1), glm::vec3(1, 0, 1), glm::vec3(1e-4f, 1, 1)}) {
        const Scene scene = withMoment(makeBuiltin("primitives"), [&](SceneMoment& moment) {
            for (Instance& instance : moment.instances) {
                for (int i = 0; i < 3; ++i) instance.worldFromMesh[i] *= scale[i];
            }
        });
        expectInRange(render(name(), scene, {64, 48}, quick()).visibility);
    }
}

TEST_P(Contract, ScaledAndShiftedScenesLookTheSame) {
    const auto moved = [](float scale, float shift_m) {
        return withMoment(makeBuiltin("two-boxes"), [=](SceneMoment& moment) {
            const auto move = [=](glm::vec3 p) { return scale * p + shift_m; };
            for (Instance& instance : moment.instances) {
                for (int i = 0; i < 3; ++i) instance.worldFromMesh[i] *= scale;
                instance.worldFromMesh[3] = glm::vec4(move(instance.worldFromMesh[3]), 1);
            }
            for (Camera& camera : moment.cameras) {
                camera.worldFromCamera[3] = glm::vec4(move(camera.worldFromCamera[3]), 1);
            }
            AreaLight& light = moment.lights.front().shape;
            auto& place = light.worldFromLight.columns[3];
            const glm::vec3 posWorld = move({place[0], place[1], place[2]});
            place = {posWorld.x, posWorld.y, posWorld.z, 1};
            light.width_m *= scale;
            light.height_m *= scale;
            moment.bounds = {move(moment.bounds.min), move(moment.bounds.max)};
        });
    };
    const LightResult plain = render(name(), moved(1, 0));
    // Powers of two change no mantissa, yet constants of length (there should be none) would show; a shift by
    // a hundred scene sizes costs seven bits of every coordinate, which moves edges by less than a pixel.
    EXPECT_LE(shareOfDifferentPixels(plain, render(name(), moved(1024, 0)), 0.02f), 0.005);
    EXPECT_LE(shareOfDifferentPixels(plain, render(name(), moved(1.0f / 1024, 0)), 0.02f), 0.005);
    EXPECT_LE(shareOfDifferentPixels(plain, render(name(), moved(1, 300)), 0.1f), 0.02);
}

TEST_P(Contract, BlockersBehindTheLightOrBelowTheReceiverDoNothing) {
    const auto withExtraBox = [](float height_m) {
        return withMoment(makeBuiltin("two-boxes"), [=](SceneMoment& moment) {
            Instance extra = moment.instances.back();
            extra.worldFromMesh[3] = {0, height_m, 0, 1};
            moment.instances.push_back(extra);
        });
    };
    const LightResult plain = render(name(), makeBuiltin("two-boxes"));
    for (const float height_m : {40.0f, -30.0f}) {
        EXPECT_LE(shareOfDifferentPixels(plain, render(name(), withExtraBox(height_m)), 0.1f), 0.01)
            << height_m;
    }
}

/// Collects what describe() says, and tries the ends of every range.
class RangeProbe final : public ParameterVisitor {
  public:
    void boolean(const ParameterInfo& info, bool& value) override {
        see(info);
        value = !value;
    }
    void integer(const ParameterInfo& info, int& value, Range<int> range) override {
        see(info);
        EXPECT_LE(range.min, value) << info.name;
        EXPECT_GE(range.max, value) << info.name;
    }
    void real(const ParameterInfo& info, float& value, Range<float> range) override {
        see(info);
        EXPECT_LE(range.min, value) << info.name;
        EXPECT_GE(range.max, value) << info.name;
    }
    void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) override {
        see(info);
        EXPECT_GE(value, 0);
        EXPECT_LT(std::size_t(value), names.size()) << info.name;
    }
    const std::set<std::string_view>& seen() const { return seen_; }

  private:
    void see(const ParameterInfo& info) {
        EXPECT_TRUE(seen_.insert(info.name).second) << info.name << " is described twice";
        EXPECT_FALSE(info.help.empty()) << info.name << " has no help";
    }
    std::set<std::string_view> seen_;
};

TEST_P(Contract, ParametersAreDescribedOnceAndGuarded) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique(name());
    RangeProbe probe;
    technique->describe(probe);
    EXPECT_THROW(setParameter(*technique, "no_such_parameter", "1"), Error);
    for (const std::string_view parameter : probe.seen()) {
        EXPECT_THROW(setParameter(*technique, parameter, "nan"), Error) << parameter;
        EXPECT_THROW(setParameter(*technique, parameter, ""), Error) << parameter;
    }
}

TEST_P(Contract, StatisticsAndInspectedBuffersAreThere) {
    class Inspector final : public InspectionVisitor {
      public:
        void texture(const InspectedTexture& inspected) override {
            EXPECT_FALSE(inspected.name.empty());
            EXPECT_NE(inspected.texture, 0u) << inspected.name;
            ++count;
        }
        int count = 0;
    };
    const std::unique_ptr<Technique> technique = workbench().makeTechnique(name());
    render(*technique, makeBuiltin("two-boxes"), {64, 48});
    Inspector inspector;
    technique->inspect(inspector);
    EXPECT_GT(inspector.count, 0);
    const Statistics statistics = technique->statistics();
    EXPECT_FALSE(statistics.passes.empty());
    for (const Statistic& count : statistics.counts) EXPECT_TRUE(std::isfinite(count.value)) << count.name;
}

TEST_P(Contract, WrongInputsAreRefused) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique(name());
    const Scene scene = makeBuiltin("two-boxes");
    const auto broken = [&](const std::function<void(AreaLight&)>& change) {
        return withLight(scene, [&](Light& light) { change(light.shape); });
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(render(*technique, broken([](AreaLight& light) { light.width_m = nan; })), Error);
    EXPECT_THROW(render(*technique, broken([](AreaLight& light) { light.height_m = -1; })), Error);
    EXPECT_THROW(render(*technique, broken([](AreaLight& light) { light.worldFromLight.columns[0][0] = 7; })),
                 Error);
    EXPECT_THROW(
        render(*technique, broken([](AreaLight& light) { light.worldFromLight.columns[3][0] = nan; })),
        Error);
    // And works on afterwards.
    expectInRange(render(*technique, scene).visibility);
}

}  // namespace
}  // namespace penumbra::studio
