// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/picker.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "studio/frame/conversions.h"
#include "studio/scene/builtin/placing.h"
#include "studio/viewer/gizmo.h"
#include "studio/workbench/any_technique.h"
#include "studio/workbench/reference_inputs.h"

namespace penumbra::studio::viewer {
namespace {

constexpr int lightView_px = 256;

/// One pixel of a texture, `y` from the top; waits for the device, which is what a click may do.
glm::vec4 readPixel(GLuint texture, int x, int y, int height_px, GLenum format = GL_RGBA) {
    glm::vec4 value(0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureSubImage(texture, 0, x, height_px - 1 - y, 0, 1, 1, 1, format, GL_FLOAT, sizeof(value),
                         &value[0]);
    return value;
}

}  // namespace

std::optional<SurfacePoint> surfaceAt(const FrameRenderer& frame, int x, int y) {
    const View& view = frame.gbuffer().view();
    if (x < 0 || y < 0 || x >= view.width_px || y >= view.height_px) return {};
    const float depth = readPixel(view.depthTexture, x, y, view.height_px, GL_DEPTH_COMPONENT).r;
    if (!(depth > 0)) return {};
    const CameraView& camera = frame.camera();
    const glm::dvec4 clip((x + 0.5) / view.width_px * 2 - 1, 1 - (y + 0.5) / view.height_px * 2, depth, 1);
    const glm::dvec4 pos = glm::inverse(camera.clipFromView * camera.viewFromWorld) * clip;
    return SurfacePoint{glm::vec3(glm::dvec3(pos) / pos.w),
                        glm::vec3(readPixel(view.normalTexture, x, y, view.height_px))};
}

Picker::Picker(Device& device, gl::ShaderLibrary& shaders)
    : device_(device), pointFrame_(device), lightView_(shaders) {}

void Picker::restart() {
    if (wanted_ && !stopped_) pick(wanted_->x, wanted_->y);
}

bool Picker::busy() const {
    return wanted_ && !stopped_ &&
           (!located_ || (wanted_->hasSurface &&
                          (!wanted_->truth || wanted_->answers.size() < techniqueCatalog().size())));
}

void Picker::step(const FrameRenderer& frame, const Side& side, const Document& document, std::size_t light,
                  const std::string& first, TechniqueBank& techniques, const ReferenceScene* traced) {
    if (!wanted_) return;
    const View& view = frame.gbuffer().view();
    if (wanted_->x >= view.width_px || wanted_->y >= view.height_px) return clear();
    const std::vector<Light>& lights = document.moment().lights;
    if (wanted_->answers.empty() && !wanted_->truth) {
        locate(frame, side);
        located_ = true;
        if (wanted_->hasSurface && light < lights.size()) lookAtLight(document, lights[light]);
    }
    if (!wanted_->hasSurface || light >= lights.size()) return;
    std::vector<std::string> names;
    if (first != referenceName) names.push_back(first);
    for (const TechniqueInfo& info : techniqueCatalog()) {
        if (info.name != first) names.emplace_back(info.name);
    }
    const std::size_t next = wanted_->answers.size();
    if (next < names.size()) ask(frame, lights[light], names[next], techniques);
    if (!wanted_->truth && traced != nullptr) trace(frame, lights[light], *traced);
}

void Picker::locate(const FrameRenderer& frame, const Side& side) {
    Pick& pick = *wanted_;
    const std::optional<SurfacePoint> surface = surfaceAt(frame, pick.x, pick.y);
    pick.hasSurface = surface.has_value();
    if (!surface) return;
    pick.posWorld = surface->posWorld;
    pick.normalWorld = surface->normalWorld;
    pick.illuminance_lux =
        readPixel(side.illuminance.name(), pick.x, pick.y, frame.gbuffer().view().height_px).r;
}

void Picker::lookAtLight(const Document& document, const Light& light) {
    const AreaLight& shape = light.shape;
    const Bounds& bounds = document.bounds();
    const glm::vec3 place = placeOf(shape, bounds);
    // Off the surface by what a ray would be, so that it is not in the way.
    const glm::vec3 eye = wanted_->posWorld + 1e-4f * std::max(bounds.radius(), 1e-3f) * wanted_->normalWorld;
    glm::mat4 worldFromLight = fromPenumbra(shape.worldFromLight);
    const bool distant = shape.shape == LightShape::distant;
    const glm::vec3 target = distant ? eye + glm::vec3(worldFromLight[2]) : place;
    const float distance_m = std::max(glm::distance(eye, target), 1e-4f);
    const float radius_m = shape.shape == LightShape::rect ? 0.5f * std::hypot(shape.width_m, shape.height_m)
                           : shape.shape == LightShape::cylinder
                               ? std::hypot(0.5f * shape.length_m, shape.radius_m)
                               : shape.radius_m;
    const float half_rad = distant ? 0.5f * shape.angle_rad : std::atan(radius_m / distance_m);
    const float fov_rad = std::clamp(2.6f * half_rad, glm::radians(2.0f), glm::radians(150.0f));
    if (distant) worldFromLight[3] = glm::vec4(eye, 1);  // it has no place; here numbers stay small
    if (eye == target) return;
    pointFrame_.draw(document.gpuScene(), document.moment(), studio::camera("point", eye, target, fov_rad),
                     lightView_px, lightView_px);
    lightView_.lookAtLight(pointFrame_, shape, worldFromLight);
}

void Picker::ask(const FrameRenderer& frame, const Light& light, const std::string& technique,
                 TechniqueBank& techniques) {
    VisibilityBuffer visibility = frame.makeVisibility(light);
    techniques.get(technique).render(frame.shadowInputs(light), visibility);
    const glm::vec4 value = readPixel(visibility.texture(), wanted_->x, wanted_->y, visibility.height_px());
    wanted_->answers.push_back(
        {technique, visibility.colored() ? (value.r + value.g + value.b) / 3 : value.r});
}

void Picker::trace(const FrameRenderer& frame, const Light& light, const ReferenceScene& scene) {
    const glm::vec3 eye(glm::inverse(frame.camera().viewFromWorld)[3]);
    const ReceiverImage receiver{.width_px = 1,
                                 .height_px = 1,
                                 .posWorld = {wanted_->posWorld},
                                 .normalWorld = {wanted_->normalWorld},
                                 .valid = {1},
                                 .eyeWorld = eye};
    const ShadowInputs inputs = frame.shadowInputs(light);
    const std::optional<RadianceTexture> radiance = readRadianceTexture(inputs.light.radianceTexture);
    const ReferenceScene empty((std::span<const TracedCaster>()));
    const ReferenceResult result =
        (light.castsShadow ? scene : empty)
            .trace(receiver, inputs.light, radiance ? &*radiance : nullptr, {.samples = Pick::truthSamples});
    float sum = 0;
    for (const float value : result.visibility.values) sum += value;
    wanted_->truth = sum / float(result.visibility.values.size());
}

}  // namespace penumbra::studio::viewer
