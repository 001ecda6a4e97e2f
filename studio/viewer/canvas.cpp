// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/canvas.h"

#include <algorithm>
#include <array>

#include "src/gl/pass.h"
#include "studio/viewer/canvas_io.h"

#include "src/gl/texture_target.h"

namespace penumbra::studio::viewer {
namespace {

glm::vec2 halfSize_m(const AreaLight& light) {
    if (light.shape == LightShape::cylinder) return glm::vec2(0.5f * light.length_m);
    return 0.5f * glm::vec2(light.width_m, light.height_m);
}

gl::Texture mapTexture(const ColorTable& table, std::string_view label) {
    gl::Texture texture({.width_px = 256, .format = gl::Format::rgba8, .label = label});
    texture.write(std::as_bytes(std::span(table)));
    return texture;
}

GLint parameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

}  // namespace

Canvas::Canvas(gl::ShaderLibrary& shaders)
    : order_(shaders.order()),
      compose_(shaders, {"studio/viewer/compose.comp.glsl"}),
      inspect_(shaders, {"studio/viewer/inspect.comp.glsl"}),
      inspectLayer_(shaders, {"studio/viewer/inspect.comp.glsl"}, {"LAYERED"}),
      inspectRange_(shaders, {"studio/viewer/inspect_range.comp.glsl"}),
      inspectLayerRange_(shaders, {"studio/viewer/inspect_range.comp.glsl"}, {"LAYERED"}),
      lightView_(shaders, {"studio/viewer/light_view.comp.glsl"}),
      inspectedRange_(2 * sizeof(std::uint32_t), "viewer/inspected range"),
      orderedMap_(mapTexture(orderedColors(), "viewer/ordered colours")),
      divergingMap_(mapTexture(divergingColors(), "viewer/diverging colours")),
      nothing_({.format = gl::Format::rgba8, .label = "viewer/nothing"}) {}

void Canvas::resize(int width_px, int height_px) {
    texture_.fit({.width_px = width_px,
                  .height_px = height_px,
                  .format = gl::Format::rgba8,
                  .filter = gl::Filter::linear,
                  .label = "viewer/canvas"});
}

void Canvas::compose(const FrameRenderer& frame, const Side& a, const Side& b, const CanvasOptions& options) {
    const gl::DebugGroup group("canvas");
    const View& view = frame.gbuffer().view();
    resize(view.width_px, view.height_px);
    isolines_.fit({.width_px = view.width_px,
                   .height_px = view.height_px,
                   .format = gl::Format::r32f,
                   .label = "viewer/isolines"});
    // Between the pixels of a picture more is not known but looks better; between numbers it would be made
    // up.
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER,
                        options.shown == Shown::picture ? GL_LINEAR : GL_NEAREST);
    const auto visibilityOf = [&](const Side& side) {
        const bool exists = options.light < side.visibilities.size();
        return gl::TextureRef{.name = exists ? side.visibilities[options.light].texture() : nothing_.name()};
    };
    gl::Pass(compose_)
        .constants(ComposeConstants{.size_px = {view.width_px, view.height_px},
                                    .shown = int(options.shown),
                                    .hasIsolines = options.isolines,
                                    .rangeMin = options.range.min,
                                    .rangeMax = options.range.max,
                                    .isLogarithmic = options.logarithmic,
                                    .firstColumnOfB = options.firstColumnOfB})
        .bind("displayA", a.display)
        .bind("displayB", b.display)
        .bind("visibilityA", visibilityOf(a))
        .bind("visibilityB", visibilityOf(b))
        .bind("illuminanceA", a.illuminance)
        .bind("illuminanceB", b.illuminance)
        .bind("depthTexture", gl::TextureRef{.name = view.depthTexture})
        .bind("normalTexture", gl::TextureRef{.name = view.normalTexture})
        .bind("reachTexture", a.reach.name() != 0 ? a.reach : nothing_)
        .bind("orderedMap", orderedMap_)
        .bind("divergingMap", divergingMap_)
        .bind("canvasImage", texture_)
        .bind("isolineImage", isolines_)
        .dispatchPixels(view.width_px, view.height_px);
    order_->makeAllVisible();  // the window shows it
}

void Canvas::inspect(const InspectedTexture& texture, int layer, bool stretched) {
    const gl::DebugGroup group("inspection");
    const bool layered = gl::targetOf(texture.texture) == GL_TEXTURE_2D_ARRAY;
    const int width_px = parameter(texture.texture, GL_TEXTURE_WIDTH);
    const int height_px = parameter(texture.texture, GL_TEXTURE_HEIGHT);
    const bool grey = parameter(texture.texture, GL_TEXTURE_GREEN_SIZE) == 0;
    resize(width_px, height_px);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const std::array<std::uint32_t, 2> nothingSeen = {0xffffffffu, 0};
    inspectedRange_.write(std::as_bytes(std::span(nothingSeen)));
    const InspectConstants constants{
        .size_px = {width_px, height_px},
        .layer = layer,
        .isGrey = grey,
        .black = texture.black,
        .white = texture.white == texture.black ? texture.black + 1 : texture.white,
        .isStretched = stretched,
    };
    const gl::TextureRef inspected{.name = texture.texture};
    if (stretched) {
        gl::Pass(layered ? inspectLayerRange_ : inspectRange_)
            .constants(constants)
            .bind("inspected", inspected)
            .bind("Range", inspectedRange_)
            .dispatchPixels(width_px, height_px);
    }
    gl::Pass(layered ? inspectLayer_ : inspect_)
        .constants(constants)
        .bind("inspected", inspected)
        .bind("Range", inspectedRange_)
        .bind("picture", texture_)
        .dispatchPixels(width_px, height_px);
    order_->makeAllVisible();  // the window shows it
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
    gl::Pass(lightView_)
        .constants(LightViewConstants{.lightFromClip = lightFromClip,
                                      .eyeLight = eyeLight,
                                      .shape = int(light.shape),
                                      .eyeWorldForward = forward,
                                      .radius_m = light.radius_m,
                                      .halfSize_m = halfSize_m(light),
                                      .halfAngle_rad = 0.5f * light.angle_rad})
        .bind("depthTexture", gl::TextureRef{.name = view.depthTexture})
        .bind("normals", gl::TextureRef{.name = view.normalTexture})
        .bind("albedoTexture", frame.gbuffer().albedo())
        .bind("picture", texture_)
        .dispatchPixels(view.width_px, view.height_px);
    order_->makeAllVisible();  // the window shows it
}

}  // namespace penumbra::studio::viewer
