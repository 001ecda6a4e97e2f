// SPDX-License-Identifier: Apache-2.0
// Points without a picture: what techniques answer there, and what they say where they cannot.
#include <algorithm>
#include <cmath>

#include "studio/frame/conversions.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/workbench/reference_inputs.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

/// The built-in half-plane: a square light of a metre, four metres up, half hidden from under the edge of a
/// sheet at two metres: V falls from 1 to 0 over a metre of ground.
class PointsTest : public TechniqueTest {
  protected:
    PointsTest() : scene_(makeBuiltin("half-plane")), moment_(scene_.at(0)) {
        workbench().open(scene_);
        workbench().scene().update(moment_);
    }

    std::vector<float> ask(Technique& technique, const std::vector<Vec3>& positions) const {
        const Points points(workbench().device(), positions,
                            std::vector<Vec3>(positions.size(), Vec3{0, 1, 0}));
        VisibilityBuffer visibility(workbench().device(), points.width_px(), points.height_px());
        technique.render({points.view(), moment_.lights.front().shape, workbench().scene().casters()},
                         visibility);
        return points.read(visibility.texture());
    }
    static std::vector<Vec3> alongTheRamp(int count) {
        std::vector<Vec3> positions;
        for (int i = 0; i < count; ++i)
            positions.push_back({-0.75f + 1.5f * float(i) / float(count), 0, 0.1f});
        return positions;
    }

    Scene scene_;
    SceneMoment moment_;
};

TEST_F(PointsTest, HaveTheClosedFormOfAHalfPlane) {
    const std::vector<Vec3> positions = alongTheRamp(150);
    for (const char* name : {"exact", "auto", "reference"}) {
        const auto technique = workbench().makeTechnique(name);
        EXPECT_TRUE(technique->answersAtPoints());
        const std::vector<float> seen = ask(*technique, positions);
        ASSERT_EQ(seen.size(), positions.size());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const float truth = std::clamp(positions[i].x + 0.5f, 0.0f, 1.0f);
            EXPECT_NEAR(seen[i], truth, 0.03) << name << " at x = " << positions[i].x;
        }
    }
}

TEST_F(PointsTest, AreAnsweredAsIfEachWereAlone) {
    const auto technique = workbench().makeTechnique("exact");
    const std::vector<Vec3> positions = alongTheRamp(100);
    const std::vector<float> together = ask(*technique, positions);
    for (const std::size_t i : {0u, 33u, 50u, 64u, 99u})
        EXPECT_EQ(ask(*technique, {positions[i]}).front(), together[i]) << i;
}

// Most of them see all of the light or nothing, which is found for many at once.
TEST_F(PointsTest, OfAPlanAreAnsweredAsIfEachWereAlone) {
    const auto technique = workbench().makeTechnique("exact");
    std::vector<Vec3> positions;
    constexpr int rows = 24, columns = 32;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            positions.push_back(
                {-1.6f + 0.1f * float(column), 0.3f * float(row % 3), -1.2f + 0.1f * float(row)});
    }
    const std::vector<float> together = ask(*technique, positions);
    EXPECT_GT(std::ranges::count(together, 0.0f), rows * columns / 8);
    EXPECT_GT(std::ranges::count(together, 1.0f), rows * columns / 8);
    for (std::size_t i = 0; i < positions.size(); i += 5)
        EXPECT_EQ(ask(*technique, {positions[i]}).front(), together[i]) << i;
}

TEST_F(PointsTest, ThatAPictureShowsAreAsInThePicture) {
    const Camera& camera = moment_.cameras.front();
    const auto technique = workbench().makeTechnique("exact");
    const TechniqueResult picture = workbench().run("exact", *technique, moment_, camera, {64, 48});
    const ReceiverImage shown = readReceivers(workbench().frame().gbuffer().view());
    std::vector<Vec3> positions;
    std::vector<float> expected;
    for (std::size_t i = 0; i < shown.posWorld.size(); ++i) {
        const glm::vec3& p = shown.posWorld[i];
        // The ground, on which normals point up.
        if (shown.valid[i] == 0 || std::abs(p.y) > 1e-4f || glm::length(p) > 5) continue;
        positions.push_back({p.x, p.y, p.z});
        expected.push_back(picture.lights.front().visibility.values[i]);
    }
    ASSERT_GT(positions.size(), 500u);
    const std::vector<float> seen = ask(*technique, positions);
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_NEAR(seen[i], expected[i], 1.01f / 64) << i;
}

TEST_F(PointsTest, AreRefusedInWordsWhereAPictureIsNeeded) {
    for (const TechniqueInfo& info : techniqueCatalog()) {
        const auto technique = workbench().makeTechnique(info.name);
        if (technique->answersAtPoints()) continue;
        try {
            ask(*technique, {{0, 0, 0}});
            ADD_FAILURE() << info.name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), Error::Kind::badArgument);
            EXPECT_NE(std::string(error.what()).find("needs a picture"), std::string::npos) << error.what();
        }
    }
}

TEST_F(PointsTest, AreChecked) {
    Device& device = workbench().device();
    const std::vector<Vec3> none, up = {{0, 1, 0}}, zero = {{0, 0, 0}}, infinite = {{0, INFINITY, 0}},
                                  two = {{0, 0, 0}, {1, 0, 0}};
    const auto messageFor = [&](const std::vector<Vec3>& positions, const std::vector<Vec3>& normals) {
        try {
            Points(device, positions, normals);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), Error::Kind::badArgument);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(messageFor(zero, up), "");
    EXPECT_NE(messageFor(none, none).find("at least one"), std::string::npos);
    EXPECT_NE(messageFor(two, up).find("one each"), std::string::npos);
    EXPECT_NE(messageFor(infinite, up).find("[0]"), std::string::npos);
    EXPECT_NE(messageFor(zero, zero).find("no length"), std::string::npos);

    const Points points(device, zero, up);
    const VisibilityBuffer other(device, 3, 3);
    EXPECT_THROW(points.read(other.texture()), Error);
    EXPECT_THROW(points.read(points.view().depthTexture, 5), Error);
    View view = points.view();
    view.normalTexture = 0;
    VisibilityBuffer visibility(device, points.width_px(), points.height_px());
    const auto technique = workbench().makeTechnique("exact");
    EXPECT_THROW(technique->render({view, moment_.lights.front().shape, {}}, visibility), Error);
    view = points.view();
    view.depthTexture = other.texture();
    EXPECT_THROW(technique->render({view, moment_.lights.front().shape, {}}, visibility), Error);
}

}  // namespace
}  // namespace penumbra::studio
