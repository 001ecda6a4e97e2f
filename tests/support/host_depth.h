// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "src/gl/framebuffer.h"
#include "src/gl/texture.h"
#include "studio/frame/conversions.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {

struct DepthForm {
    const char* name;
    GLenum format;
    DepthConvention convention;
};

struct Planes {
    double near_m, far_m;
};

/// Draws depth as hosts do: not reversed, of every format, and no normals.
class HostDepth : public HostTest {
  protected:
    /// The frame's casters as a host with that depth sees them; without a far plane where it is reversed.
    View drawn(const ShadowInputs& frame, const DepthForm& form, const Planes& range,
               const PolygonOffset& offset, bool hasNormals = false) {
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
                              .format = gl::Format(form.format),
                              .label = form.name});
        view.depthTexture = depth_.name();
        gl::Framebuffer framebuffer;
        framebuffer.fit({}, &depth_, form.name);
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
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(offset.factor, offset.units);
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
        glDisable(GL_POLYGON_OFFSET_FILL);
        glBindVertexArray(0);
        glDeleteVertexArrays(1, &vertexArray);
        return view;
    }

    /// By `exact`, which has no tolerance for a depth that is not what it should be.
    Image visibility(const ShadowInputs& inputs, const DepthForm& form, const Planes& range,
                     bool hasNormals = false) {
        return visibility("exact", inputs, drawn(inputs, form, range, {}, hasNormals));
    }
    Image visibility(const char* technique, ShadowInputs inputs, const View& view) {
        inputs.view = view;
        VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
        workbench().makeTechnique(technique)->render(inputs, out);
        return workbench().frame().readVisibility(out);
    }

  private:
    gl::Texture depth_;
};

inline constexpr auto fromZero = DepthConvention::Range::zeroToOne;
inline constexpr auto fromMinusOne = DepthConvention::Range::minusOneToOne;
inline constexpr DepthForm best = {"reversed float", GL_DEPTH_COMPONENT32F, {fromZero, true}};
inline constexpr std::array<DepthForm, 6> usual = {{
    {"24 bits from 0", GL_DEPTH_COMPONENT24, {fromZero, false}},
    {"24 bits from -1", GL_DEPTH_COMPONENT24, {fromMinusOne, false}},
    {"32 bits from 0", GL_DEPTH_COMPONENT32, {fromZero, false}},
    {"32 bits from -1", GL_DEPTH_COMPONENT32, {fromMinusOne, false}},
    {"float from 0", GL_DEPTH_COMPONENT32F, {fromZero, false}},
    {"float from -1", GL_DEPTH_COMPONENT32F, {fromMinusOne, false}},
}};

}  // namespace penumbra::studio
