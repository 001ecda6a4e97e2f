// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "src/gl/gl.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {

/// A host's own shaders.
class Program {
  public:
    Program(const char* vertex, const char* fragment) : name_(glCreateProgram()) {
        for (const auto& [stage, text] :
             {std::pair{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}) {
            const GLuint shader = glCreateShader(GLenum(stage));
            glShaderSource(shader, 1, &text, nullptr);
            glCompileShader(shader);
            glAttachShader(name_, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(name_);
        GLint linked = 0;
        glGetProgramiv(name_, GL_LINK_STATUS, &linked);
        EXPECT_EQ(linked, GL_TRUE);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program() { glDeleteProgram(name_); }
    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

/// What `call` throws: kind and message. Fails where it throws nothing.
inline std::pair<Error::Kind, std::string> errorOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return {error.kind(), error.what()};
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

/// A context of its own for each test, so that what a host does to it hurts no other test.
class HostTest : public ::testing::Test {
  protected:
    HostTest() { workbench_.emplace(std::nullopt, testProfile()); }
    void TearDown() override {
        workbench_.reset();
        TechniqueTest::workbench().makeCurrent();
    }

    Workbench& workbench() { return *workbench_; }
    Device& device() { return workbench_->device(); }

    /// A scene's frame, ready for techniques.
    ShadowInputs drawScene(PictureSize size = {96, 72}) { return drawScene("two-boxes", size); }
    ShadowInputs drawScene(const char* builtin, PictureSize size) {
        return drawScene(makeBuiltin(builtin), size);
    }
    ShadowInputs drawScene(Scene scene, PictureSize size) {
        scene_ = std::move(scene);
        moment_ = scene_.at(0);
        workbench_->open(scene_);
        const auto hard = workbench_->makeTechnique("hard");
        workbench_->run("hard", *hard, moment_, moment_.cameras.front(), size);
        return workbench_->frame().shadowInputs(moment_.lights.front());
    }

    Scene scene_;
    SceneMoment moment_;

  private:
    std::optional<Workbench> workbench_;
};

}  // namespace penumbra::studio
