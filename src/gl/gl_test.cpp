// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "penumbra/device.h"
#include "src/gl/buffer.h"
#include "src/gl/framebuffer.h"
#include "src/gl/pass.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/gl/shader_library.h"
#include "src/gl/texture.h"
#include "studio/context/headless_context.h"

namespace penumbra::gl {
namespace {

class GlTest : public ::testing::Test {
  protected:
    studio::HeadlessContext context;
};

constexpr std::string_view doubling = R"(#version 450
layout(local_size_x = 1) in;
#include "factor.glsl"
layout(std430) buffer Values { float values[]; };
void main() { values[gl_GlobalInvocationID.x] *= factor; }
)";

ShaderLibrary libraryOf(std::span<const EmbeddedShader> shaders) {
    ShaderLibrary library{std::filesystem::path()};
    library.add(shaders);
    return library;
}

std::array<float, 2> runOn(const Program& program, std::array<float, 2> values) {
    Buffer buffer(std::as_bytes(std::span(values)), "values");
    Pass(program).bind("Values", buffer).dispatch(2);
    buffer.read(std::as_writable_bytes(std::span(values)));
    return values;
}

TEST_F(GlTest, ProgramsIncludeFiles) {
    constexpr std::array<EmbeddedShader, 2> shaders = {EmbeddedShader{"double.comp.glsl", doubling},
                                                       {"factor.glsl", "const float factor = 2.0;\n"}};
    ShaderLibrary library = libraryOf(shaders);
    EXPECT_EQ(runOn(Program(library, {"double.comp.glsl"}), {1, 3}), (std::array<float, 2>{2, 6}));
}

TEST_F(GlTest, ShaderErrorsNameFileAndLine) {
    constexpr std::array<EmbeddedShader, 2> shaders = {
        EmbeddedShader{"double.comp.glsl", doubling},
        {"factor.glsl", "// fine\nconst float factor = nonsense;\n"}};
    ShaderLibrary library = libraryOf(shaders);
    try {
        Program(library, {"double.comp.glsl"});
        FAIL() << "compiled";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Kind::shader);
        EXPECT_NE(std::string(error.what()).find("factor.glsl:2"), std::string::npos) << error.what();
    }
    EXPECT_THROW(Program(library, {"missing.comp.glsl"}), Error);
}

TEST_F(GlTest, LinesAfterAnIncludeKeepTheirNumbers) {
    constexpr std::array<EmbeddedShader, 2> shaders = {
        EmbeddedShader{"broken.comp.glsl",
                       "#version 450\n#include \"factor.glsl\"\nvoid main() { float x = nonsense; }\n"},
        {"factor.glsl", "const float factor = 1.0;\n\n\n\n"}};
    ShaderLibrary library = libraryOf(shaders);
    try {
        Program(library, {"broken.comp.glsl"});
        FAIL() << "compiled";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("broken.comp.glsl:3"), std::string::npos) << error.what();
    }
}

TEST_F(GlTest, ProgramsAskForNoMoreThanEveryDriverHas) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &most);
    if (GLuint(most) <= storageBlocks) GTEST_SKIP() << "this driver refuses such a program itself";
    std::string blocks, sum;
    for (GLuint i = 0; i <= storageBlocks; ++i) {
        const std::string number = std::to_string(i);
        blocks += "layout(std430) buffer Block" + number + " { float value" + number + "; };\n";
        sum += "value" + number + " += 1.0; ";
    }
    const std::string text =
        "#version 450\nlayout(local_size_x = 1) in;\n" + blocks + "void main() { " + sum + "}\n";
    const std::array<EmbeddedShader, 1> shaders = {EmbeddedShader{"nine.comp.glsl", text}};
    ShaderLibrary library = libraryOf(shaders);
    try {
        Program(library, {"nine.comp.glsl"});
        FAIL() << "accepted";
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("nine.comp.glsl: 'Block8'"), std::string::npos)
            << error.what();
    }
}

/// Shader files on disk that can be edited, as DeviceOptions::shaderSourceDirectory allows.
class ReloadTest : public GlTest {
  protected:
    void SetUp() override {
        std::filesystem::create_directories(folder);
        write("double.comp.glsl", doubling);
        write("factor.glsl", "const float factor = 2.0;\n");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    void write(const std::string& name, std::string_view text) { std::ofstream(folder / name) << text; }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("penumbra-shaders-" + std::to_string(::getpid()));
};

TEST_F(ReloadTest, TakesNewSourcesAndKeepsTheLastGoodProgram) {
    ShaderLibrary library(folder);
    const Program program(library, {"double.comp.glsl"});
    EXPECT_EQ(runOn(program, {1, 3})[0], 2);

    write("factor.glsl", "const float factor = 5.0;\n");
    library.reload();
    EXPECT_EQ(runOn(program, {1, 3})[0], 5);

    write("factor.glsl", "const float factor = ;\n");
    EXPECT_THROW(library.reload(), Error);
    EXPECT_EQ(runOn(program, {1, 3})[0], 5);
}

TEST_F(GlTest, ImpossibleTexturesAreRefused) {
    EXPECT_THROW(Texture({.width_px = 16384,
                          .height_px = 16384,
                          .layers = 2048,
                          .format = gl::Format::rgba32f,
                          .label = "t"}),
                 Error);
    // And possible ones are still made.
    EXPECT_NE(Texture({.width_px = 16, .height_px = 16, .format = gl::Format::rgba32f, .label = "t"}).name(),
              0u);
}

TEST_F(GlTest, TexelsOfRowsOfAnyLengthAreTight) {
    Texture texture({.width_px = 3, .height_px = 2, .format = Format::r16f, .label = "odd"});
    const std::array<std::uint16_t, 6> halves = {0x3c00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600};
    texture.write(std::as_bytes(std::span(halves)));
    std::array<std::uint16_t, 6> texels{};
    texture.read(std::as_writable_bytes(std::span(texels)));
    EXPECT_EQ(texels, halves);
}

TEST_F(GlTest, IncompleteFramebuffersAreRefused) {
    const Texture color(
        {.width_px = 8, .height_px = 8, .format = Format(GL_RGB9_E5), .label = "not drawable"});
    Framebuffer framebuffer;
    EXPECT_THROW(framebuffer.fit({&color}, nullptr, "framebuffer"), Error);
}

TEST_F(GlTest, OwnersMoveAndDelete) {
    GLuint name = 0;
    {
        Texture a({.width_px = 4, .height_px = 4, .label = "a"});
        name = a.name();
        Texture b = std::move(a);
        EXPECT_EQ(b.name(), name);
        EXPECT_TRUE(glIsTexture(name));
    }
    EXPECT_FALSE(glIsTexture(name));
}

TEST_F(GlTest, PassTimersReportInOrderWithoutWaiting) {
    PassTimers timers;
    for (int frame = 0; frame < 10; ++frame) {
        const auto first = timers.pass("first");
        const auto second = timers.pass("second");
    }
    glFinish();
    const auto times = timers.latest();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "first");
    EXPECT_EQ(times[1].name, "second");
    EXPECT_GT(times[0].milliseconds, 0);
}

}  // namespace
}  // namespace penumbra::gl
