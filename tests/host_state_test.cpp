// SPDX-License-Identifier: Apache-2.0
// Living in somebody else's context: nothing of its state is trusted, and all of it is as before.
#include <array>

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

INSTANTIATE_TEST_SUITE_P(Catalog, StateOfEveryTechnique, everyTechnique(), techniqueTestName);

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

TEST_F(HostTest, WhatItBoundOfOursMayGoAway) {
    class Last final : public InspectionVisitor {
      public:
        void texture(const InspectedTexture& inspected) override { name = inspected.texture; }
        std::uint32_t name = 0;
    } bound;
    const auto technique = workbench().makeTechnique("exact");
    for (const int size_px : {1, 100}) {
        const std::vector<Vec3> places(std::size_t(size_px), Vec3{0, 0, 0}),
            normals(places.size(), Vec3{0, 1, 0});
        const Points points(device(), places, normals);
        VisibilityBuffer out(device(), points.width_px(), points.height_px());
        technique->render({.view = points.view(), .light = {}, .casters = {}}, out);
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << size_px;
        technique->inspect(bound);
        glBindTextureUnit(0, bound.name);
        glBindImageTexture(0, bound.name, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R16F);
    }
    glBindTextureUnit(0, 0);
    glBindImageTexture(0, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8);
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

TEST_F(HostTest, WhatCompatibilityContextsCanBeAmidstIsRefused) {
    if (testProfile() == ContextProfile::core) GTEST_SKIP() << "core contexts have none of it";
    const ShadowInputs inputs = drawScene();
    const auto technique = workbench().makeTechnique("hard");
    VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
    const auto messageOf = [&] {
        try {
            technique->render(inputs, out);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("nothing was thrown");
    };
    const GLuint list = glGenLists(1);
    glNewList(list, GL_COMPILE);
    EXPECT_NE(messageOf().find("glEndList"), std::string::npos);
    glEndList();
    std::array<GLuint, 64> selected{};
    glSelectBuffer(GLsizei(selected.size()), selected.data());
    for (const GLenum mode : {GL_SELECT, GL_FEEDBACK}) {
        if (mode == GL_FEEDBACK) {
            static std::array<GLfloat, 64> fedBack;
            glFeedbackBuffer(GLsizei(fedBack.size()), GL_3D, fedBack.data());
        }
        glRenderMode(mode);
        EXPECT_NE(messageOf().find("glRenderMode"), std::string::npos);
        EXPECT_EQ(glRenderMode(GL_RENDER), 0) << "something was drawn";
    }
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    glBegin(GL_TRIANGLES);
    EXPECT_NE(messageOf().find("glEnd"), std::string::npos);
    glEnd();
    EXPECT_NO_THROW(technique->render(inputs, out));
}

TEST_F(HostTest, OptingOutChangesStateButTrustsNoneOfIt) {
    const ShadowInputs inputs = drawScene();
    VisibilityBuffer expected(device(), inputs.view.width_px, inputs.view.height_px);
    workbench().makeTechnique("pcss")->render(inputs, expected);
    Device careless({.keepHostState = false, .shared = &device()});
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

}  // namespace
}  // namespace penumbra::studio
