// SPDX-License-Identifier: Apache-2.0
// What is kept from frame to frame is what would come out anew, whatever has changed and whoever says so.
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "src/gl/texture.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class StillViewTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{64, 48};

    StillViewTest() : technique_(workbench().makeTechnique("exact")) {}

    /// Draws a moment into the textures that every frame has, and says what there is.
    ShadowInputs draw(const SceneMoment& moment) {
        workbench().scene().update(moment);
        workbench().frame().draw(workbench().scene(), moment, moment.cameras.front(), size.width_px,
                                 size.height_px);
        ShadowInputs inputs = workbench().frame().shadowInputs(moment.lights.front());
        casters_.assign(inputs.casters.begin(), inputs.casters.end());
        inputs.casters = casters_;
        return inputs;
    }

    static Image renderWith(Technique& technique, const ShadowInputs& inputs, const Light& light) {
        VisibilityBuffer visibility = workbench().frame().makeVisibility(light);
        technique.render(inputs, visibility);
        return workbench().frame().readVisibility(visibility);
    }

    /// Renders with the technique that keeps its answers and with one that has none. Returns how many tiles
    /// of the former's were looked at.
    double expectAsAnew(const ShadowInputs& inputs, const Light& light, const std::string& what) {
        const std::unique_ptr<Technique> fresh = workbench().makeTechnique("exact");
        const Image anew = renderWith(*fresh, inputs, light);
        EXPECT_EQ(renderWith(*technique_, inputs, light).values, anew.values) << what;
        const std::vector<Statistic> counts = technique_->statistics().counts,
                                     countsAnew = fresh->statistics().counts;
        double looks = -1;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            if (counts[i].name == "tiles looked at") {
                looks = counts[i].value;
            } else if (counts[i].name.ends_with("error bound") || counts[i].name == "penumbra pixels") {
                EXPECT_EQ(counts[i].value, countsAnew[i].value) << what << ": " << counts[i].name;
            }
        }
        return looks;
    }
    /// Until all is kept that can be.
    double settle(const ShadowInputs& inputs, const Light& light) {
        double looks = 0;
        for (int frame = 0; frame < 3; ++frame)
            looks = expectAsAnew(inputs, light, "frame " + std::to_string(frame));
        return looks;
    }

    std::unique_ptr<Technique> technique_;
    std::vector<Caster> casters_;
};

Mat4 moved(Mat4 matrix, float x, float y) {
    matrix.columns[3][0] += x;
    matrix.columns[3][1] += y;
    return matrix;
}

TEST_F(StillViewTest, NothingIsLookedAtAgain) {
    for (const char* name : {"two-boxes", "primitives", "columns"}) {
        const Scene scene = makeBuiltin(name);
        workbench().open(scene);
        const SceneMoment moment = scene.at(0);
        const ShadowInputs inputs = draw(moment);
        EXPECT_GT(expectAsAnew(inputs, moment.lights.front(), name), 0) << name;
        EXPECT_EQ(settle(inputs, moment.lights.front()), 0) << name;
        setParameter(*technique_, "tile_candidates", "3");
        EXPECT_EQ(settle(inputs, moment.lights.front()), 0) << name;
        setParameter(*technique_, "tile_candidates", "512");
    }
}

TEST_F(StillViewTest, WhatTheHostDrawsOverItsPictureIsSeen) {
    const Scene scene = makeBuiltin("two-boxes");
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    const Light& light = moment.lights.front();
    const ShadowInputs inputs = draw(moment);
    const std::vector<Caster> casters = casters_;
    const double all = expectAsAnew(inputs, light, "first");
    settle(inputs, light);
    SceneMoment elsewhere = moment;
    const auto box = std::ranges::find_if_not(elsewhere.instances, isGround);
    ASSERT_NE(box, elsewhere.instances.end());
    box->worldFromMesh[3].x += 0.3f;
    ShadowInputs changed = draw(elsewhere);
    casters_ = casters;
    changed.casters = casters_;
    const double looks = expectAsAnew(changed, light, "another picture of the same casters");
    EXPECT_GT(looks, 0);
    EXPECT_LT(looks, all);
    EXPECT_EQ(settle(changed, light), 0);
    changed.view.normalTexture = 0;
    settle(changed, light);
    ShadowInputs back = draw(moment);
    casters_ = casters;
    back.casters = casters_;
    back.view.normalTexture = 0;
    expectAsAnew(back, light, "normals from neighbours' depths");
}

TEST_F(StillViewTest, CastersThatMoveComeAndGoAreSeen) {
    const Scene scene = makeBuiltin("primitives");
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    const Light& light = moment.lights.front();
    ShadowInputs inputs = draw(moment);
    const double all = expectAsAnew(inputs, light, "first");
    settle(inputs, light);
    const std::vector<Caster> before = casters_;
    double fewest = all;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const std::string which = "caster " + std::to_string(i);
        casters_[i].worldFromMesh = moved(casters_[i].worldFromMesh, 0.05f, 0.02f);
        fewest = std::min(fewest, expectAsAnew(inputs, light, which + " moved"));
        casters_[i].casts = false;
        expectAsAnew(inputs, light, which + " gone");
        casters_[i] = before[i];
        expectAsAnew(inputs, light, which + " back");
    }
    EXPECT_LT(fewest, all);
    casters_.insert(casters_.end(), before.begin(), before.end());
    for (std::size_t i = before.size(); i < casters_.size(); ++i)
        casters_[i].worldFromMesh = moved(casters_[i].worldFromMesh, 0.1f, 0.3f);
    inputs.casters = casters_;
    expectAsAnew(inputs, light, "more casters");
    EXPECT_EQ(settle(inputs, light), 0);
}

TEST_F(StillViewTest, HolesThatMayHaveChangedAreLookedAt) {
    const Scene scene = withAlphaMask(
        makeBuiltin("two-boxes"),
        {.name = "half", .width_px = 2, .height_px = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 100}});
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    const Light& light = moment.lights.front();
    const ShadowInputs inputs = draw(moment);
    const auto with = [&](std::uint64_t revision, float cutoff) {
        for (Caster& caster : casters_) {
            caster.alphaMask.revision = revision;
            caster.alphaMask.cutoff = cutoff;
        }
    };
    with(5, 0.5f);
    EXPECT_EQ(settle(inputs, light), 0);
    with(5, 0.2f);
    EXPECT_GT(expectAsAnew(inputs, light, "another cutoff"), 0);
    EXPECT_EQ(settle(inputs, light), 0);
    with(6, 0.2f);
    EXPECT_GT(expectAsAnew(inputs, light, "other texels"), 0);
    with(0, 0.2f);
    EXPECT_GT(settle(inputs, light), 0) << "unknown texels are never the same";
}

TEST_F(StillViewTest, PicturesOfLightsThatChangeAreSeen) {
    const Scene scene = makeBuiltin("textured-window");
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    const Light& light = moment.lights.front();
    gl::Texture picture({.width_px = 2, .height_px = 1, .format = gl::Format::rgba32f, .label = "picture"});
    const auto write = [&](const std::array<float, 8>& texels) {
        picture.write(std::as_bytes(std::span(texels)));
    };
    ShadowInputs inputs = draw(moment);
    inputs.light.radianceTexture = picture.name();
    write({1, 0.5f, 0.2f, 1, 0.1f, 1, 1, 1});
    settle(inputs, light);
    write({1, 0.5f, 0.2f, 1, 0.1f, 1, 0.5f, 1});
    EXPECT_GT(expectAsAnew(inputs, light, "another picture"), 0);
    settle(inputs, light);
    inputs.light.width_m *= 1.1f;
    settle(inputs, light);
}

TEST_F(StillViewTest, OptionsAndCamerasThatChangeAreSeen) {
    const Scene scene = makeBuiltin("two-boxes");
    workbench().open(scene);
    SceneMoment moment = scene.at(0);
    const Light light = moment.lights.front();
    ShadowInputs inputs = draw(moment);
    settle(inputs, light);
    moment.cameras.front().worldFromCamera[3].x += 0.1f;
    inputs = draw(moment);
    EXPECT_GT(expectAsAnew(inputs, light, "camera"), 0);
    EXPECT_EQ(settle(inputs, light), 0);
    inputs.light.worldFromLight = moved(inputs.light.worldFromLight, 0.1f, 0);
    EXPECT_GT(expectAsAnew(inputs, light, "light"), 0);
    EXPECT_EQ(settle(inputs, light), 0);
    const Image sixtyFour = renderWith(*technique_, inputs, light);
    setParameter(*technique_, "samples", "16");
    EXPECT_NE(renderWith(*technique_, inputs, light).values, sixtyFour.values);
    setParameter(*technique_, "samples", "64");
    EXPECT_EQ(renderWith(*technique_, inputs, light).values, sixtyFour.values);
}

TEST_F(StillViewTest, EachOfSeveralLightsIsKept) {
    const Scene scene = withMoment(makeBuiltin("many-lights"),
                                   [](SceneMoment& moment) { moment.lights[1].castsShadow = false; });
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    draw(moment);
    FrameRenderer& frame = workbench().frame();
    std::vector<VisibilityBuffer> visibilities = frame.makeVisibilities(moment.lights);
    const std::vector<FrameLight> lights = frame.frameLights(moment.lights, visibilities);
    std::vector<double> looks(lights.size());
    const auto render = [&](std::span<const Caster> casters) {
        FrameInputs inputs = frame.frameInputs(lights);
        inputs.casters = casters;
        inputs.answered = [&](std::size_t i) {
            for (const Statistic& count : technique_->statistics().counts) {
                if (count.name == "tiles looked at") looks[i] = count.value;
            }
        };
        technique_->renderLights(inputs);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            ShadowInputs alone = frame.shadowInputs(moment.lights[i]);
            if (moment.lights[i].castsShadow) alone.casters = casters;
            EXPECT_EQ(frame.readVisibility(visibilities[i]).values,
                      renderWith(*workbench().makeTechnique("exact"), alone, moment.lights[i]).values)
                << moment.lights[i].name;
        }
    };
    for (int i = 0; i < 3; ++i) render(casters_);
    EXPECT_EQ(looks, std::vector<double>(lights.size(), 0));
    std::vector<Caster> elsewhere = casters_;
    for (Caster& caster : elsewhere) caster.worldFromMesh = moved(caster.worldFromMesh, 0.2f, 0);
    render(elsewhere);
    EXPECT_GT(looks[0], 0);
}

}  // namespace
}  // namespace penumbra::studio
