// SPDX-License-Identifier: Apache-2.0
// Input at the limits, and what is kept from frame to frame.
#include "src/device/device_internals.h"
#include "src/techniques/light_sampling/light_sampling_test.h"

namespace penumbra::studio {
namespace {

TEST_F(LightSamplingTest, ALightWithoutSizeTakesOneMap) {
    const Scene scene = withLight(makeBuiltin("two-boxes"), shrinkToPoint);
    for (const char* name : {"uniform", "adaptive"}) {
        const LightResult result = render(name, scene, size, small());
        EXPECT_EQ(count(result, "samples"), 1) << name;
        EXPECT_EQ(count(result, "maps"), 1) << name;
    }
}

TEST_F(LightSamplingTest, ACameraThatSeesNoReceiverNeedsNoMaps) {
    const Scene sky = withMoment(makeBuiltin("two-boxes"), [](SceneMoment& moment) {
        glm::mat4& camera = moment.cameras.front().worldFromCamera;
        camera = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 50, 0, 1}};  // straight up
    });
    for (const char* name : {"uniform", "adaptive"}) {
        const LightResult result = render(name, sky, size, small());
        EXPECT_EQ(count(result, "maps"), 0) << name;
        EXPECT_EQ(std::ranges::count(result.visibility.values, 1.0f), size.width_px * size.height_px) << name;
    }
}

TEST_F(LightSamplingTest, SubdivisionStopsAtItsLimits) {
    const Scene scene = makeBuiltin("cylinder");
    EXPECT_EQ(count(render("adaptive", scene, size, with({{"max_samples", "1"}})), "samples"), 1);
    EXPECT_EQ(count(render("adaptive", scene, size, with({{"max_depth", "0"}})), "samples"), 4);
    const LightResult limited = render("adaptive", scene, size, with({{"max_samples", "20"}}));
    EXPECT_LE(count(limited, "samples"), 20);
    EXPECT_EQ(count(limited, "reached the maximum"), 1);
}

TEST_F(LightSamplingTest, NothingToSeeNeedsNoMapsBeyondTheLeast) {
    const Scene lit = withMoment(makeBuiltin("two-boxes"), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.casts = false;
    });
    EXPECT_EQ(count(render("adaptive", lit, size, with({{"min_depth", "0"}})), "samples"), 4);
    EXPECT_EQ(count(render("adaptive", lit, size, small()), "samples"), 9);
    const Scene nothing = withMoment(makeBuiltin("two-boxes"), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.receives = false;
    });
    EXPECT_EQ(count(render("adaptive", nothing, size, small()), "maps"), 0);
}

TEST_F(LightSamplingTest, ALightBehindOrInsideGeometryLeavesItsShadow) {
    const auto lightAt = [](float x, float y, float z) {
        return withLight(makeBuiltin("two-boxes"), [=](Light& light) {
            light.shape.worldFromLight.columns[3] = {x, y, z, 1};
            light.shape.width_m = light.shape.height_m = 0.2f;
        });
    };
    for (const Scene& scene : {lightAt(0, -1, 0), lightAt(0, 0.3f, 0)}) {
        const LightResult exact = truth(scene, size, 64);
        EXPECT_LE(shareOfDifferentPixels(exact, render("adaptive", scene, size, small()), 0.3f), 0.03);
    }
}

TEST_F(LightSamplingTest, MapsLargerThanTheDeviceAllowsAreRefused) {
    int& limit_px = internalsOf(workbench().device()).maxTextureSize_px;
    const int before = limit_px;
    limit_px = 512;
    for (const char* name : {"uniform", "adaptive"}) {
        EXPECT_THROW(render(name, makeBuiltin("two-boxes"), size, {{"map_size", "1024"}}), Error) << name;
    }
    limit_px = before;
}

TEST_F(LightSamplingTest, StaticFramesReuseTheirMapsAndMovingOnesDoNot) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("adaptive");
    setParameter(*technique, "map_size", "128");
    const Scene scene = makeBuiltin("moving");
    const LightResult first = render(*technique, scene, size, 0);
    EXPECT_EQ(count(first, "reused"), 0);
    // The workbench keeps its meshes only within one scene; here they are made anew and equal.
    const LightResult moved = render(*technique, scene, size, 0.5);
    EXPECT_EQ(count(moved, "reused"), 0);
    const LightResult fresh = render("adaptive", scene, size, small(), 0.5);
    EXPECT_EQ(moved.visibility.values, fresh.visibility.values);
    const LightResult again = render(*technique, scene, size, 0.5);
    EXPECT_EQ(again.visibility.values, fresh.visibility.values);
}

TEST_F(LightSamplingTest, TreesGrowAndShrinkToThoseOfAFreshStart) {
    // A technique that has followed the scene and one that has just begun see the same, bit by bit.
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("adaptive");
    setParameter(*technique, "map_size", "128");
    const Scene scene = makeBuiltin("moving");
    double fewest = 1e9, most = 0;
    for (const double time_s : {0.0, 0.4, 2.0, 2.1, 3.0}) {
        const LightResult followed = render(*technique, scene, size, time_s);
        const LightResult fresh = render("adaptive", scene, size, small(), time_s);
        EXPECT_EQ(count(followed, "samples"), count(fresh, "samples")) << time_s;
        EXPECT_EQ(followed.visibility.values, fresh.visibility.values) << time_s;
        fewest = std::min(fewest, count(fresh, "samples"));
        most = std::max(most, count(fresh, "samples"));
    }
    EXPECT_LT(fewest, most);  // else nothing was tested

    // With samples of the deepest level, too, which are found anew each time.
    const std::unique_ptr<Technique> again = workbench().makeTechnique("adaptive");
    setParameter(*again, "map_size", "128");
    setParameter(*again, "reuse", "false");
    constexpr PictureSize larger{320, 180};
    const Scene still = makeBuiltin("primitives");
    const LightResult first = render(*again, still, larger);
    EXPECT_GT(count(first, "samples of level 4"), 0);
    const LightResult second = render(*again, still, larger);
    EXPECT_EQ(first.visibility.values, second.visibility.values);
}

/// A frame's inputs, whose casters a test may change.
class KeptInputsTest : public LightSamplingTest {
  protected:
    /// As the camera sees the scene at a moment; `casters` are those of the last such call.
    ShadowInputs draw(const SceneMoment& moment) {
        workbench().scene().update(moment);
        workbench().frame().draw(workbench().scene(), moment, moment.cameras.front(), size.width_px,
                                 size.height_px);
        return workbench().frame().shadowInputs(moment.lights.front());
    }
    static std::unique_ptr<Technique> make(const Settings& settings) {
        std::unique_ptr<Technique> technique = workbench().makeTechnique("adaptive");
        for (const auto& [key, value] : settings) setParameter(*technique, key, value);
        return technique;
    }
    static Image renderOnce(Technique& technique, const ShadowInputs& inputs, const Light& light) {
        VisibilityBuffer visibility = workbench().frame().makeVisibility(light);
        technique.render(inputs, visibility);
        return workbench().frame().readVisibility(visibility);
    }
    static bool hasReused(const Technique& technique) {
        const auto counts = technique.statistics().counts;
        return std::ranges::find(counts, "reused", &Statistic::name)->value == 1;
    }
};

/// Only a host can tell whether a mask's texels are the same as before.
TEST_F(KeptInputsTest, MapsOfMaskedCastersAreKeptWhileTheMaskIsTheSame) {
    const Scene scene =
        withAlphaMask(makeBuiltin("two-boxes"),
                      {.name = "solid", .width_px = 1, .height_px = 1, .rgba = {255, 255, 255, 255}});
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    ShadowInputs inputs = draw(moment);
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    inputs.casters = casters;
    const std::unique_ptr<Technique> technique = make(small());
    const auto reusesWith = [&](std::uint64_t revision, float cutoff) {
        for (Caster& caster : casters) {
            caster.alphaMask.revision = revision;
            caster.alphaMask.cutoff = cutoff;
        }
        renderOnce(*technique, inputs, moment.lights.front());
        return hasReused(*technique);
    };
    EXPECT_FALSE(reusesWith(5, 0.5f));
    EXPECT_TRUE(reusesWith(5, 0.5f));
    EXPECT_FALSE(reusesWith(6, 0.5f)) << "other texels";
    EXPECT_FALSE(reusesWith(6, 0.4f));
    EXPECT_FALSE(reusesWith(0, 0.4f));
    EXPECT_FALSE(reusesWith(0, 0.4f)) << "unknown texels are never the same";
}

/// Maps show no more than receivers look up, and these can move where no caster does.
TEST_F(KeptInputsTest, MapsThatAreKeptShowReceiversThatHaveMoved) {
    Scene scene = makeBuiltin("two-boxes");
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    SceneMoment elsewhere =
        moment;  // nothing but the ground, raised above the boxes, which shadow nothing there
    std::erase_if(elsewhere.instances, [](const Instance& instance) { return !isGround(instance); });
    for (Instance& instance : elsewhere.instances) instance.worldFromMesh[3].y += 3;
    // All samples, so that the tree is no matter of the receivers.
    const Settings settings = with({{"min_depth", "4"}});
    const std::unique_ptr<Technique> technique = make(settings);
    ShadowInputs inputs = draw(moment);
    const std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    inputs = draw(elsewhere);
    inputs.casters = casters;
    const Image lit = renderOnce(*technique, inputs, moment.lights.front());
    EXPECT_EQ(*std::ranges::min_element(lit.values), 1);

    inputs = draw(moment);
    inputs.casters = casters;
    const Image kept = renderOnce(*technique, inputs, moment.lights.front());
    EXPECT_TRUE(hasReused(*technique));
    EXPECT_EQ(*std::ranges::min_element(kept.values), 0);
    EXPECT_EQ(kept.values, renderOnce(*make(settings), inputs, moment.lights.front()).values);
}

}  // namespace
}  // namespace penumbra::studio
