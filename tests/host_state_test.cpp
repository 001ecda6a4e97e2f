// SPDX-License-Identifier: Apache-2.0
// Living in somebody else's context: nothing of its state is trusted, and all of it is as before.
#include <array>
#include <optional>
#include <thread>

#include "src/gl/texture.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/gl_state.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

using test::captureState;
using test::differences;
using test::NastyHost;

class StateOfEveryTechnique : public HostTest, public ::testing::WithParamInterface<std::string> {};

std::vector<std::string> catalogNames() {
    std::vector<std::string> names;
    for (const TechniqueInfo& info : techniqueCatalog()) names.emplace_back(info.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Catalog, StateOfEveryTechnique, ::testing::ValuesIn(catalogNames()),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(StateOfEveryTechnique, IsNeitherTrustedNorChanged) {
    class Looker final : public InspectionVisitor {
        void texture(const InspectedTexture&) override {}
    } looker;
    const ShadowInputs inputs = drawScene();
    VisibilityBuffer expected(device(), inputs.view.width_px, inputs.view.height_px);
    VisibilityBuffer seen(device(), inputs.view.width_px, inputs.view.height_px);
    const auto technique = workbench().makeTechnique(GetParam());
    technique->render(inputs, expected);

    {
        const NastyHost host;
        ASSERT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << "the host itself is wrong";
        const auto before = captureState();
        // Everything that a host may call, first times included.
        const auto another = workbench().makeTechnique(GetParam());
        another->render(inputs, seen);
        another->inspect(looker);
        another->statistics();
        EXPECT_EQ(differences(before, captureState()), "");
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }
    EXPECT_EQ(readTexture(seen.texture(), seen.width_px(), seen.height_px(), 1).values,
              readTexture(expected.texture(), seen.width_px(), seen.height_px(), 1).values);
}

TEST_F(HostTest, StateIsRestoredWhenACallFails) {
    ShadowInputs inputs = drawScene();
    const auto technique = workbench().makeTechnique("pcss");
    VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
    inputs.light.radius_m = inputs.light.width_m = -1;
    const NastyHost host;
    const auto before = captureState();
    EXPECT_THROW(technique->render(inputs, out), Error);
    EXPECT_EQ(differences(before, captureState()), "");
}

TEST_F(HostTest, ActiveTransformFeedbackIsRefused) {
    const ShadowInputs inputs = drawScene();
    const auto technique = workbench().makeTechnique("hard");
    VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
    const char* const source = "#version 450\nout vec4 recorded;\nvoid main() { recorded = vec4(1.0); }\n";
    const char* const recorded = "recorded";
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glTransformFeedbackVaryings(program, 1, &recorded, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glUseProgram(program);
    GLuint buffer = 0, vertexArray = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 4096, nullptr, 0);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glCreateVertexArrays(1, &vertexArray);
    glBindVertexArray(vertexArray);
    glBeginTransformFeedback(GL_POINTS);
    ASSERT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    EXPECT_THROW(technique->render(inputs, out), Error);
    glEndTransformFeedback();
    EXPECT_NO_THROW(technique->render(inputs, out));
}

TEST_F(HostTest, OptingOutChangesStateButTrustsNoneOfIt) {
    const ShadowInputs inputs = drawScene();
    VisibilityBuffer expected(device(), inputs.view.width_px, inputs.view.height_px);
    workbench().makeTechnique("pcss")->render(inputs, expected);
    Device careless({.keepHostState = false});
    VisibilityBuffer seen(careless, inputs.view.width_px, inputs.view.height_px);
    {
        const NastyHost host;
        const auto before = captureState();
        makeTechnique(careless, "pcss")->render(inputs, seen);
        EXPECT_NE(differences(before, captureState()), "") << "the flag does nothing";
    }
    EXPECT_EQ(readTexture(seen.texture(), seen.width_px(), seen.height_px(), 1).values,
              readTexture(expected.texture(), seen.width_px(), seen.height_px(), 1).values);
}

TEST_F(HostTest, TheHostsErrorsAreNotTakenForOurs) {
    glEnable(GL_TEXTURE_2D_ARRAY);  // an error that the host does not ask for
    EXPECT_NO_THROW(VisibilityBuffer(device(), 8, 8));
}

/// Two threads, each with a context, a device and a scene of its own, at the same time.
TEST(ContextsTest, TwoRenderAtOnce) {
    const auto picture = [](const char* sceneName, const char* technique) {
        Workbench workbench;
        const Scene scene = makeBuiltin(sceneName);
        const SceneMoment moment = scene.at(0);
        workbench.open(scene);
        const auto made = workbench.makeTechnique(technique);
        for (int frame = 0; frame < 2; ++frame) {
            workbench.run(technique, *made, moment, moment.cameras.front(), {96, 72});
        }
        return workbench.run(technique, *made, moment, moment.cameras.front(), {96, 72})
            .lights.front()
            .visibility.values;
    };
    const auto first = picture("two-boxes", "pcss"), second = picture("primitives", "soft-volumes");
    std::vector<float> firstAtOnce, secondAtOnce;
    std::thread a([&] { firstAtOnce = picture("two-boxes", "pcss"); });
    std::thread b([&] { secondAtOnce = picture("primitives", "soft-volumes"); });
    a.join();
    b.join();
    EXPECT_EQ(firstAtOnce, first);
    EXPECT_EQ(secondAtOnce, second);
    TechniqueTest::workbench().makeCurrent();
}

/// The same calls, interleaved on one thread.
TEST(ContextsTest, TwoTakeTurnsOnOneThread) {
    struct Host {
        Workbench workbench;
        std::unique_ptr<Technique> technique;
        std::vector<float> picture;
    };
    const Scene scene = makeBuiltin("two-boxes");
    const SceneMoment moment = scene.at(0);
    std::array<std::optional<Host>, 2> hosts;
    for (int round = 0; round < 3; ++round) {
        for (std::optional<Host>& host : hosts) {
            if (!host) {
                host.emplace();
                host->workbench.open(scene);
                host->technique = host->workbench.makeTechnique("adaptive");
            }
            host->workbench.makeCurrent();
            host->picture =
                host->workbench.run("adaptive", *host->technique, moment, moment.cameras.front(), {64, 48})
                    .lights.front()
                    .visibility.values;
        }
    }
    EXPECT_EQ(hosts[0]->picture, hosts[1]->picture);
    for (std::optional<Host>& host : hosts) {
        host->workbench.makeCurrent();
        EXPECT_EQ(host->workbench.device().severeMessageCount(), 0);
        host.reset();
    }
    TechniqueTest::workbench().makeCurrent();
}

}  // namespace
}  // namespace penumbra::studio
