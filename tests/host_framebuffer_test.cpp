// SPDX-License-Identifier: Apache-2.0
// Hosts that have a framebuffer and no more.
#include <array>
#include <cmath>
#include <cstdint>

#include "penumbra/framebuffer.h"
#include "src/gl/texture.h"
#include "studio/frame/conversions.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

/// A host's framebuffer, in textures or in renderbuffers.
class Target {
  public:
    Target(GLenum depthFormat, bool inTextures, int samples, int width_px, int height_px) {
        const bool packed = depthFormat == GL_DEPTH24_STENCIL8 || depthFormat == GL_DEPTH32F_STENCIL8;
        const GLenum point = packed ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
        glCreateFramebuffers(1, &framebuffer_);
        glCreateRenderbuffers(1, &color_);
        glNamedRenderbufferStorageMultisample(color_, samples, GL_RGBA8, width_px, height_px);
        glNamedFramebufferRenderbuffer(framebuffer_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
        if (inTextures) {
            glCreateTextures(samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &texture_);
            if (samples > 0) {
                glTextureStorage2DMultisample(texture_, samples, depthFormat, width_px, height_px, GL_TRUE);
            } else {
                glTextureStorage2D(texture_, 1, depthFormat, width_px, height_px);
            }
            glNamedFramebufferTexture(framebuffer_, point, texture_, 0);
        } else {
            glCreateRenderbuffers(1, &depth_);
            glNamedRenderbufferStorageMultisample(depth_, samples, depthFormat, width_px, height_px);
            glNamedFramebufferRenderbuffer(framebuffer_, point, GL_RENDERBUFFER, depth_);
        }
        EXPECT_EQ(glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER),
                  GLenum(GL_FRAMEBUFFER_COMPLETE));
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    ~Target() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &color_);
        glDeleteRenderbuffers(1, &depth_);
        glDeleteTextures(1, &texture_);
    }
    GLuint name() const { return framebuffer_; }

    /// The depths that a texture shows, in every sample, from (x_px, y_px).
    void fill(GLuint depthTexture, int x_px, int y_px, const View& view) const {
        const Program program(
            "#version 450\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,"
            " gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); }\n",
            "#version 450\nlayout(binding = 0) uniform sampler2D depths;\n"
            "layout(location = 0) uniform ivec2 corner;\n"
            "void main() { gl_FragDepth = texelFetch(depths, ivec2(gl_FragCoord.xy) - corner, 0).r; }\n");
        GLuint vertexArray = 0;
        glCreateVertexArrays(1, &vertexArray);
        glBindVertexArray(vertexArray);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
        glViewport(x_px, y_px, view.width_px, view.height_px);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
        glDepthMask(GL_TRUE);
        glUseProgram(program.name());
        glUniform2i(0, x_px, y_px);
        glBindTextureUnit(0, depthTexture);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
        glDeleteVertexArrays(1, &vertexArray);
    }

  private:
    GLuint framebuffer_ = 0, color_ = 0, depth_ = 0, texture_ = 0;
};

class HostsFramebuffer : public HostTest {
  protected:
    Image visibility(const ShadowInputs& inputs) {
        VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
        workbench().makeTechnique("hard")->render(inputs, out);
        return workbench().frame().readVisibility(out);
    }
};

TEST_F(HostsFramebuffer, GivesItsDepthsInEveryForm) {
    ShadowInputs inputs = drawScene();
    inputs.view.normalTexture = inputs.view.receiverTexture = 0;
    const Image expected = visibility(inputs);
    HostFramebuffer copier(device());
    for (const GLenum format : {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32,
                                GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8}) {
        const bool isFloat = format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH32F_STENCIL8;
        for (const bool inTextures : {false, true}) {
            for (const int samples : {0, 4}) {
                const Target target(format, inTextures, samples, 110, 80);
                target.fill(inputs.view.depthTexture, 7, 3, inputs.view);
                ShadowInputs copied = inputs;
                copied.view.x_px = 7;
                copied.view.y_px = 3;
                copied.view.sample = samples > 0 ? 2 : 0;
                copier.copyDepth(target.name(), copied.view);
                EXPECT_EQ(copied.view.samplePlace.has_value(), samples > 0);
                // All samples of this host's have the depth of the pixel's centre.
                if (samples > 0) copied.view.samplePlace = Vec2{0.5f, 0.5f};
                const Image seen = visibility(copied);
                double difference = 0;
                for (std::size_t i = 0; i < seen.values.size(); ++i)
                    difference += std::abs(seen.values[i] - expected.values[i]) / double(seen.values.size());
                // Reversed depths of 16 bits tell little far away.
                EXPECT_LE(difference, isFloat                          ? 0
                                      : format == GL_DEPTH_COMPONENT16 ? 0.1
                                                                       : 0.01)
                    << "format " << format << ", " << samples << " samples";
            }
        }
    }
    EXPECT_EQ(device().severeMessageCount(), 0);
}

TEST_F(HostsFramebuffer, WithoutDepthsIsRefused) {
    const ShadowInputs inputs = drawScene();
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    HostFramebuffer copier(device());
    View view = inputs.view;
    const auto refused = [&](GLuint name) {
        const auto [kind, message] = errorOf([&] { copier.copyDepth(name, view); });
        EXPECT_EQ(kind, Error::Kind::badArgument);
        return message;
    };
    EXPECT_NE(refused(framebuffer).find("has no depths"), std::string::npos);
    EXPECT_NE(refused(54321).find("none of the current context"), std::string::npos);
    const Target target(GL_DEPTH_COMPONENT24, true, 4, 100, 80);
    view.sample = 4;
    EXPECT_NE(refused(target.name()).find("no sample 4"), std::string::npos);
    view.sample = 0;
    view.width_px = 0;
    EXPECT_NE(refused(target.name()).find("width_px"), std::string::npos);
}

TEST_F(HostsFramebuffer, IsMultipliedByTheVisibility) {
    const ShadowInputs inputs = drawScene();
    VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
    workbench().makeTechnique("pcss")->render(inputs, out);
    const Image seen = workbench().frame().readVisibility(out);
    const Target target(GL_DEPTH_COMPONENT24, false, 0, 110, 80);
    const std::array<float, 4> before = {200 / 255.0f, 100 / 255.0f, 50 / 255.0f, 128 / 255.0f};
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, before.data());
    View view = inputs.view;
    view.x_px = 7;
    view.y_px = 3;
    constexpr float leastLit = 0.25f;
    HostFramebuffer(device()).multiply(target.name(), view, out, leastLit);
    std::vector<std::uint8_t> pixels(110 * 80 * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
    glReadPixels(0, 0, 110, 80, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    int wrong = 0;
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 110; ++x) {
            const int column = x - 7, row = y - 3;
            const bool inside = column >= 0 && column < view.width_px && row >= 0 && row < view.height_px;
            const float factor =
                inside ? leastLit + (1 - leastLit) * seen.at(column, view.height_px - 1 - row) : 1;
            for (std::size_t channel = 0; channel < 4; ++channel) {
                const float wanted = 255 * before[channel] * (channel == 3 ? 1 : factor);
                wrong += std::abs(float(pixels[4 * std::size_t(110 * y + x) + channel]) - wanted) > 1.01f;
            }
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(errorOf([&] { HostFramebuffer(device()).multiply(target.name(), view, out, 2); }).first,
              Error::Kind::badArgument);
}

TEST_F(HostsFramebuffer, IsMultipliedInTheColoursOfATexturedLight) {
    constexpr int size_px = 8;
    constexpr float leastLit = 0.2f;
    const std::array<float, 4> seen = {1, 0.5f, 0, 0}, before = {0.8f, 0.8f, 0.8f, 0.6f};
    const gl::Texture visibility({.width_px = size_px,
                                  .height_px = size_px,
                                  .format = gl::Format::rgba16f,
                                  .label = "host's visibility"});
    glClearTexImage(visibility.name(), 0, GL_RGBA, GL_FLOAT, seen.data());
    const VisibilityBuffer out(
        device(), VisibilityBuffer::HostTexture{visibility.name(), 0, 0, size_px, size_px}, true);
    const Target target(GL_DEPTH_COMPONENT24, false, 0, size_px, size_px);
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, before.data());
    View view;
    view.width_px = view.height_px = size_px;
    HostFramebuffer(device()).multiply(target.name(), view, out, leastLit);
    std::array<std::uint8_t, 4> pixel{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
    glReadPixels(3, 5, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const float factor = channel == 3 ? 1 : leastLit + (1 - leastLit) * seen[channel];
        EXPECT_NEAR(pixel[channel], 255 * before[channel] * factor, 1.01) << "channel " << channel;
    }
}

}  // namespace
}  // namespace penumbra::studio
