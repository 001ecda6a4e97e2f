// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/canvas.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>

namespace penumbra::studio::viewer {
namespace {

gl::Texture mapTexture(const ColorTable& table, std::string_view label) {
    gl::Texture texture({.width_px = 256, .format = gl::Format::rgba8, .label = label});
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.name(), 0, 0, 0, 256, 1, GL_RGBA, GL_UNSIGNED_BYTE, table.data());
    return texture;
}

GLint parameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

void finishWriting() {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace

Canvas::Canvas(gl::ShaderLibrary& shaders)
    : compose_(shaders, {"studio/viewer/compose.comp.glsl"}),
      inspect_(shaders, {"studio/viewer/inspect.comp.glsl"}),
      inspectLayer_(shaders, {"studio/viewer/inspect.comp.glsl"}, {"LAYERED"}),
      inspectRange_(shaders, {"studio/viewer/inspect_range.comp.glsl"}),
      inspectLayerRange_(shaders, {"studio/viewer/inspect_range.comp.glsl"}, {"LAYERED"}),
      lightView_(shaders, {"studio/viewer/light_view.comp.glsl"}),
      constants_("canvas"),
      inspectedRange_(2 * sizeof(std::uint32_t), "viewer/inspected range"),
      orderedMap_(mapTexture(orderedColors(), "viewer/ordered colours")),
      divergingMap_(mapTexture(divergingColors(), "viewer/diverging colours")),
      nothing_({.format = gl::Format::rgba8, .label = "viewer/nothing"}) {}

void Canvas::resize(int width_px, int height_px) {
    if (texture_.width_px() == width_px && texture_.height_px() == height_px && texture_.name() != 0) return;
    texture_ = gl::Texture({.width_px = width_px,
                            .height_px = height_px,
                            .format = gl::Format::rgba8,
                            .filter = gl::Filter::linear,
                            .label = "viewer/canvas"});
}

void Canvas::compose(const FrameRenderer& frame, const Side& a, const Side& b, const CanvasOptions& options) {
    const gl::DebugGroup group("canvas");
    const View& view = frame.gbuffer().view();
    resize(view.width_px, view.height_px);
    constants_.write({.size = {view.width_px, view.height_px, int(options.shown), options.isolines},
                      .range = {options.range.min, options.range.max, options.logarithmic,
                                float(std::min(options.firstColumnOfB, 1 << 20))}});
    constants_.bindUniform(0);
    a.display.bind(0);
    b.display.bind(1);
    const auto bindVisibility = [&](GLuint unit, const Side& side) {
        const bool exists = options.light < side.visibilities.size();
        const GLuint name = exists ? side.visibilities[options.light].texture() : nothing_.name();
        glBindTextureUnit(unit, name);
    };
    bindVisibility(2, a);
    bindVisibility(3, b);
    a.illuminance.bind(4);
    b.illuminance.bind(5);
    glBindTextureUnit(6, view.depthTexture);
    glBindTextureUnit(7, a.reach.name() != 0 ? a.reach.name() : nothing_.name());
    orderedMap_.bind(8);
    divergingMap_.bind(9);
    // Between the pixels of a picture more is not known but looks better; between numbers it would be made
    // up.
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER,
                        options.shown == Shown::picture ? GL_LINEAR : GL_NEAREST);
    texture_.bindImage(0, GL_WRITE_ONLY);
    compose_.use();
    gl::dispatchPixels(view.width_px, view.height_px);
    finishWriting();
}

void Canvas::inspect(const InspectedTexture& texture, int layer, bool stretched) {
    const gl::DebugGroup group("inspection");
    GLint target = 0;
    glGetTextureParameteriv(texture.texture, GL_TEXTURE_TARGET, &target);
    const bool layered = target == GL_TEXTURE_2D_ARRAY;
    const int width_px = parameter(texture.texture, GL_TEXTURE_WIDTH);
    const int height_px = parameter(texture.texture, GL_TEXTURE_HEIGHT);
    const bool grey = parameter(texture.texture, GL_TEXTURE_GREEN_SIZE) == 0;
    resize(width_px, height_px);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const std::array<std::uint32_t, 2> nothingSeen = {0xffffffffu, 0};
    inspectedRange_.write(std::as_bytes(std::span(nothingSeen)));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, inspectedRange_.name());
    glBindTextureUnit(0, texture.texture);
    if (stretched) {
        (layered ? inspectLayerRange_ : inspectRange_).use();
        glUniform2i(0, width_px, height_px);
        glUniform1i(2, layer);
        glUniform1i(3, grey);
        gl::dispatchPixels(width_px, height_px);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    (layered ? inspectLayer_ : inspect_).use();
    glUniform2i(0, width_px, height_px);
    glUniform2f(1, texture.black, texture.white == texture.black ? texture.black + 1 : texture.white);
    glUniform1i(2, layer);
    glUniform1i(3, grey);
    glUniform1i(4, stretched);
    texture_.bindImage(0, GL_WRITE_ONLY);
    gl::dispatchPixels(width_px, height_px);
    finishWriting();
}

void Canvas::lookAtLight(const FrameRenderer& frame, const AreaLight& light,
                         const glm::dmat4& worldFromLight) {
    const gl::DebugGroup group("light as seen from a point");
    const View& view = frame.gbuffer().view();
    resize(view.width_px, view.height_px);
    const CameraView& camera = frame.camera();
    const glm::dmat4 worldFromView = glm::inverse(camera.viewFromWorld);
    const glm::dmat4 lightFromWorld = glm::inverse(worldFromLight);
    const glm::mat4 lightFromClip = lightFromWorld * worldFromView * glm::inverse(camera.clipFromView);
    const glm::vec3 eyeLight = lightFromWorld * worldFromView[3];
    const glm::vec3 forward = -glm::vec3(worldFromView[2]);
    lightView_.use();
    glBindTextureUnit(0, view.depthTexture);
    glBindTextureUnit(1, view.normalTexture);
    frame.gbuffer().albedo().bind(2);
    glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(lightFromClip));
    glUniform3fv(1, 1, glm::value_ptr(eyeLight));
    glUniform4f(2, 0.5f * light.width_m, 0.5f * light.height_m, light.radius_m, 0.5f * light.angle_rad);
    glUniform1i(3, int(light.shape));
    glUniform3fv(4, 1, glm::value_ptr(forward));
    texture_.bindImage(0, GL_WRITE_ONLY);
    gl::dispatchPixels(view.width_px, view.height_px);
    finishWriting();
}

}  // namespace penumbra::studio::viewer
