// SPDX-License-Identifier: Apache-2.0
// The library as a host meets it.
#include <cmath>
#include <thread>

#include "src/device/device_internals.h"
#include "src/gl/texture.h"
#include "studio/frame/conversions.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using LibraryTest = TechniqueTest;

template <typename Call>
Error::Kind kindOfError(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.kind();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

TEST(DeviceTest, NeedsACurrentContext) {
    // A thread of its own has none, whatever other tests have made current here.
    std::thread([] { EXPECT_EQ(kindOfError([] { Device(); }), Error::Kind::noOpenGL); }).join();
}

TEST(HeadlessContextTest, UnknownDeviceIsRefused) {
    EXPECT_THROW(HeadlessContext(1000), NoOpenGLError);
}

TEST(HeadlessContextTest, DevicesAreListed) {
    const std::vector<HeadlessDevice> devices = listHeadlessDevices();
    ASSERT_FALSE(devices.empty());
    for (const HeadlessDevice& device : devices)
        EXPECT_TRUE(device.usable || !device.whyNot.empty()) << device.name;
}

TEST_F(LibraryTest, MeshesAreChecked) {
    const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Vec3> infinite = {{0, 0, 0}, {1, 0, 0}, {0, INFINITY, 0}};
    const std::vector<std::uint32_t> good = {0, 1, 2}, outOfRange = {0, 1, 3}, incomplete = {0, 1};
    const std::vector<Vec2> oneUv = {{0, 0}};
    Device& device = workbench().device();
    const auto kindFor = [&](const penumbra::Mesh::Source& source) {
        return kindOfError([&] { penumbra::Mesh(device, source); });
    };
    EXPECT_EQ(kindFor({.positions = positions, .indices = outOfRange}), Error::Kind::badArgument);
    EXPECT_EQ(kindFor({.positions = positions, .indices = incomplete}), Error::Kind::badArgument);
    EXPECT_EQ(kindFor({.positions = infinite, .indices = good}), Error::Kind::badArgument);
    EXPECT_EQ(kindFor({.positions = positions, .indices = good, .uvs = oneUv}), Error::Kind::badArgument);

    penumbra::Mesh mesh(device, {.positions = positions, .indices = good});
    EXPECT_EQ(mesh.bounds().max.x, 1);
    EXPECT_EQ(mesh.revision(), 0u);
    const std::vector<Vec3> moved = {{0, 0, 0}, {5, 0, 0}, {0, 1, 0}};
    mesh.deform(moved);
    EXPECT_EQ(mesh.bounds().max.x, 5);
    EXPECT_EQ(mesh.revision(), 1u);
    EXPECT_EQ(kindOfError([&] { mesh.deform(infinite); }), Error::Kind::badArgument);
    EXPECT_EQ(mesh.positions()[1].x, 5) << "a refused deformation changes nothing";
}

TEST_F(LibraryTest, VisibilityBufferSizesAreChecked) {
    EXPECT_EQ(kindOfError([] { VisibilityBuffer(workbench().device(), 0, 1); }), Error::Kind::badArgument);
    EXPECT_EQ(kindOfError([] { VisibilityBuffer(workbench().device(), 1, 1 << 20); }),
              Error::Kind::badArgument);
}

TEST_F(LibraryTest, UnknownTechniquesAreRefusedWithTheKnownOnes) {
    try {
        penumbra::makeTechnique(workbench().device(), "harder");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Kind::unknownName);
        EXPECT_NE(std::string(error.what()).find("hard"), std::string::npos);
    }
}

TEST_F(LibraryTest, ParametersAreSetFromText) {
    const auto hard = workbench().makeTechnique("hard");
    setParameter(*hard, "map_size", "512");
    for (const char* bad : {"", "many", "512.5", "-1", "99999999999999999999", "512 "}) {
        EXPECT_EQ(kindOfError([&] { setParameter(*hard, "map_size", bad); }), Error::Kind::badArgument)
            << bad;
    }
    EXPECT_EQ(kindOfError([&] { setParameter(*hard, "mapsize", "512"); }), Error::Kind::unknownName);
}

/// A frame's view, said in every convention that a host may have, must give the same shadows.
class ConventionTest : public TechniqueTest {
  protected:
    Image visibilityOf(const ShadowInputs& inputs, const char* technique = "hard") {
        VisibilityBuffer out(workbench().device(), inputs.view.width_px, inputs.view.height_px);
        workbench().makeTechnique(technique)->render(inputs, out);
        return workbench().frame().readVisibility(out);
    }

    ShadowInputs drawScene() {
        moment_ = scene_.at(0);
        workbench().open(scene_);
        const auto hard = workbench().makeTechnique("hard");
        workbench().run("hard", *hard, moment_, moment_.cameras.front(), defaultSize);
        return workbench().frame().shadowInputs(moment_.lights.front());
    }

    const Scene scene_ = makeBuiltin("primitives");
    SceneMoment moment_;
};

TEST_F(ConventionTest, AllDepthConventionsAgree) {
    ShadowInputs inputs = drawScene();
    const Image expected = visibilityOf(inputs);
    Image depth(inputs.view.width_px, inputs.view.height_px, 1);
    const auto bytes = GLsizei(depth.values.size() * sizeof(float));
    glGetTextureImage(inputs.view.depthTexture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, bytes, depth.values.data());
    const glm::mat4 clipFromView = fromPenumbra(inputs.view.clipFromView);

    for (const bool reversed : {true, false}) {
        for (const auto range : {DepthConvention::Range::zeroToOne, DepthConvention::Range::minusOneToOne}) {
            // Rows of the matrix: z' = w - z where not reversed, then 2 z' - w for a range from -1.
            glm::mat4 rows = glm::transpose(clipFromView);
            if (!reversed) rows[2] = rows[3] - rows[2];
            if (range == DepthConvention::Range::minusOneToOne) rows[2] = 2.0f * rows[2] - rows[3];
            Image converted = depth;
            if (!reversed) {
                for (float& value : converted.values) value = 1 - value;
            }
            const gl::Texture texture({.width_px = depth.width_px,
                                       .height_px = depth.height_px,
                                       .format = gl::Format::depth32f,
                                       .label = "host depth"});
            glTextureSubImage2D(texture.name(), 0, 0, 0, depth.width_px, depth.height_px, GL_DEPTH_COMPONENT,
                                GL_FLOAT, converted.values.data());
            inputs.view.clipFromView = toPenumbra(glm::transpose(rows));
            inputs.view.depth = {.range = range, .reversed = reversed};
            inputs.view.depthTexture = texture.name();
            const Image visibility = visibilityOf(inputs);
            std::size_t different = 0;
            for (std::size_t i = 0; i < visibility.values.size(); ++i) {
                different += visibility.values[i] != expected.values[i];
            }
            // A depth that is not reversed has few bits far away (the near plane is at 1e-4 of the scene):
            // positions there are off by centimetres, which shows at the edges of shadows.
            EXPECT_LE(different, visibility.values.size() * (reversed ? 2 : 40) / 1000)
                << "reversed " << reversed << ", range " << int(range);
        }
    }
}

TEST_F(ConventionTest, NormalsAndReceiverMaskAreOptional) {
    const ShadowInputs inputs = drawScene();
    ShadowInputs without = inputs;
    without.view.normalTexture = 0;
    without.view.receiverTexture = 0;
    for (const char* technique : {"hard", "pcss", "soft-volumes", "exact"}) {
        const Image expected = visibilityOf(inputs, technique), visibility = visibilityOf(without, technique);
        std::size_t different = 0;
        for (std::size_t i = 0; i < visibility.values.size(); ++i) {
            different += std::abs(visibility.values[i] - expected.values[i]) > 0.05f;
        }
        // Normals out of the depth are wrong at the outlines of things, one or two pixels wide.
        EXPECT_LE(different, visibility.values.size() * 3 / 100) << technique;
    }
}

TEST_F(LibraryTest, LayersDrawnAtOnceAndOneByOneAreTheSame) {
    const Scene scene = makeBuiltin("columns");
    const LightResult atOnce = render("hard", scene);
    bool& layered = internalsOf(workbench().device()).layerFromVertexShader;
    if (!layered) GTEST_SKIP() << "this driver draws layers one by one anyway";
    layered = false;
    const LightResult oneByOne = render("hard", scene);
    layered = true;
    EXPECT_EQ(atOnce.visibility.values, oneByOne.visibility.values);
}

TEST_F(LibraryTest, SeveralDevicesLiveSideBySide) {
    const Scene scene = makeBuiltin("two-boxes");
    const LightResult expected = render("hard", scene);
    {
        Workbench other(std::nullopt, testProfile());
        other.open(scene);
        const SceneMoment moment = scene.at(0);
        const auto hard = other.makeTechnique("hard");
        const auto result = other.run("hard", *hard, moment, moment.cameras.front(), defaultSize);
        EXPECT_EQ(result.lights.front().visibility.values, expected.visibility.values);
        EXPECT_EQ(other.device().severeMessageCount(), 0);
    }
    workbench().makeCurrent();
    EXPECT_EQ(render("hard", scene).visibility.values, expected.visibility.values);
}

}  // namespace
}  // namespace penumbra::studio
