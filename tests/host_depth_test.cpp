// SPDX-License-Identifier: Apache-2.0
// Depth as hosts have it, drawn as they draw it: not reversed, of every format, and no normals.
#include <algorithm>
#include <array>
#include <cmath>

#include "src/gl/framebuffer.h"
#include "src/gl/texture.h"
#include "studio/frame/conversions.h"
#include "tests/support/host_test.h"
#include "tests/support/random_ground.h"

namespace penumbra::studio {
namespace {

struct DepthForm {
    const char* name;
    GLenum format;
    DepthConvention convention;
};

struct Range {
    double near_m, far_m;
};

class HostDepth : public HostTest {
  protected:
    /// The frame's casters as a host with that depth sees them; without a far plane where it is reversed.
    View drawn(const ShadowInputs& frame, const DepthForm& form, const Range& range,
               bool hasNormals = false) {
        const bool fromZero = form.convention.range == DepthConvention::Range::zeroToOne;
        View view = frame.view;
        glm::mat4 clipFromView = fromPenumbra(view.clipFromView);
        if (form.convention.reversed) {
            clipFromView[2][2] = 0;
            clipFromView[3][2] = float(range.near_m);
        } else {
            const double deep_m = range.far_m - range.near_m;
            clipFromView[2][2] = float((fromZero ? -range.far_m : -(range.far_m + range.near_m)) / deep_m);
            clipFromView[3][2] = float((fromZero ? -1 : -2) * range.far_m * range.near_m / deep_m);
        }
        view.clipFromView = toPenumbra(clipFromView);
        view.depth = form.convention;
        if (!hasNormals) view.normalTexture = view.receiverTexture = 0;
        depth_ = gl::Texture({.width_px = view.width_px,
                              .height_px = view.height_px,
                              .format = form.format,
                              .label = form.name});
        view.depthTexture = depth_.name();
        const gl::Framebuffer framebuffer({}, &depth_, form.name);
        const Program program(
            "#version 450\nlayout(location = 0) uniform mat4 clipFromMesh;\nlayout(location = 0) in vec3 "
            "position;\n"
            "void main() { gl_Position = clipFromMesh * vec4(position, 1.0); }\n",
            "#version 450\nvoid main() {}\n");
        GLuint vertexArray = 0;
        glCreateVertexArrays(1, &vertexArray);
        glEnableVertexArrayAttrib(vertexArray, 0);
        glVertexArrayAttribFormat(vertexArray, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(vertexArray, 0, 0);

        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
        glViewport(0, 0, view.width_px, view.height_px);
        glClipControl(GL_LOWER_LEFT, fromZero ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_SCISSOR_TEST);
        glDepthFunc(form.convention.reversed ? GL_GREATER : GL_LESS);
        glDepthMask(GL_TRUE);
        const float background = form.convention.reversed ? 0.0f : 1.0f;
        glClearBufferfv(GL_DEPTH, 0, &background);
        glUseProgram(program.name());
        glBindVertexArray(vertexArray);
        for (const Caster& caster : frame.casters) {
            const glm::mat4 clipFromMesh(glm::dmat4(clipFromView) *
                                         glm::dmat4(fromPenumbra(view.viewFromWorld)) *
                                         glm::dmat4(fromPenumbra(caster.worldFromMesh)));
            glUniformMatrix4fv(0, 1, GL_FALSE, &clipFromMesh[0][0]);
            glVertexArrayVertexBuffer(vertexArray, 0, caster.mesh->positionBuffer(), 0, 12);
            glVertexArrayElementBuffer(vertexArray, caster.mesh->indexBuffer());
            glDrawElements(GL_TRIANGLES, GLsizei(caster.mesh->indices().size()), GL_UNSIGNED_INT, nullptr);
        }
        glBindVertexArray(0);
        glDeleteVertexArrays(1, &vertexArray);
        return view;
    }

    /// By `exact`, which has no tolerance for a depth that is not what it should be.
    Image visibility(ShadowInputs inputs, const DepthForm& form, const Range& range,
                     bool hasNormals = false) {
        inputs.view = drawn(inputs, form, range, hasNormals);
        VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
        workbench().makeTechnique("exact")->render(inputs, out);
        return workbench().frame().readVisibility(out);
    }

  private:
    gl::Texture depth_;
};

constexpr auto fromZero = DepthConvention::Range::zeroToOne;
constexpr auto fromMinusOne = DepthConvention::Range::minusOneToOne;
constexpr DepthForm best = {"reversed float", GL_DEPTH_COMPONENT32F, {fromZero, true}};
constexpr std::array<DepthForm, 6> usual = {{
    {"24 bits from 0", GL_DEPTH_COMPONENT24, {fromZero, false}},
    {"24 bits from -1", GL_DEPTH_COMPONENT24, {fromMinusOne, false}},
    {"32 bits from 0", GL_DEPTH_COMPONENT32, {fromZero, false}},
    {"32 bits from -1", GL_DEPTH_COMPONENT32, {fromMinusOne, false}},
    {"float from 0", GL_DEPTH_COMPONENT32F, {fromZero, false}},
    {"float from -1", GL_DEPTH_COMPONENT32F, {fromMinusOne, false}},
}};

TEST_F(HostDepth, ThatIsNotReversedMakesNoSpeckles) {
    for (const Range& range : {Range{0.23, 23}, Range{0.02, 20}}) {
        const ShadowInputs inputs = drawScene("primitives", {240, 150});
        const View& view = inputs.view;
        const Image normals = readTexture(view.normalTexture, view.width_px, view.height_px, 3);
        const glm::vec3 towardsLight(fromPenumbra(inputs.light.worldFromLight)[2]);
        const Image expected = visibility(inputs, best, range);
        for (const DepthForm& form : usual) {
            const Image seen = visibility(inputs, form, range);
            int darker = 0, lighter = 0;
            for (std::size_t i = 0; i < seen.values.size(); ++i) {
                // As far as it is seen: where a facet grazes the light, normals out of the depth let even the
                // best depth shadow itself.
                const glm::vec3 normal(normals.values[3 * i], normals.values[3 * i + 1],
                                       normals.values[3 * i + 2]);
                const float arrives = std::max(glm::dot(normal, towardsLight), 0.0f);
                const float difference = arrives * (seen.values[i] - expected.values[i]);
                darker += difference < -0.1f;
                lighter += difference > 0.1f;
            }
            // What is left are outlines, where normals depend on which neighbour a pixel takes for its own.
            EXPECT_LE(darker, 4) << form.name << " from " << range.near_m << " m";
            // And, with the near plane at a 350th of the distance, contacts that the depth no longer tells
            // apart.
            EXPECT_LE(lighter, range.near_m > 0.1 ? 4 : 72) << form.name << " from " << range.near_m << " m";
        }
    }
}

// Whatever its depth: a ground that casts shadows nothing but what a ground that casts nothing does.
TEST_F(HostDepth, OfLargeGroundsShadowsNothing) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const RandomGround ground = makeRandomGround(seed);
        const auto seen = [&](const Scene& scene, const DepthForm& form) {
            const float eye_m = glm::length(glm::vec3(scene.at(0).cameras[0].worldFromCamera[3]));
            return visibility(drawScene(scene, {64, 40}), form, {0.01 * eye_m, 20'000}, true);
        };
        for (const DepthForm& form : {best, usual[0], usual[1], usual[4]}) {
            const Image casting = seen(ground.casting, form), receiving = seen(ground.receiving, form);
            int darker = 0;
            for (std::size_t i = 0; i < casting.values.size(); ++i)
                darker += casting.values[i] < receiving.values[i];
            EXPECT_EQ(darker, 0) << form.name << ", " << ground.description;
        }
    }
}

}  // namespace
}  // namespace penumbra::studio
