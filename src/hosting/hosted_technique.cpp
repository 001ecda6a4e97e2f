// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/hosted_technique.h"

#include <algorithm>
#include <utility>

#include "src/device/host_scope.h"
#include "src/device/input_checks.h"
#include "src/device/visibility_internals.h"
#include "src/geometry/caster_checks.h"
#include "src/hosting/diagnose_in_scope.h"
#include "src/techniques/common/light_constants.h"
#include "src/techniques/common/tube_stand_in.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra {

HostedTechnique::HostedTechnique(Device& device, std::unique_ptr<Technique> (*make)(Device&))
    : device_(Device::Internals::handle(internalsOf(device))), view_(internalsOf(device_)) {
    const HostScope scope(internalsOf(device_));
    technique_ = make(device_);
}

void HostedTechnique::describe(ParameterVisitor& visitor) {
    describeGuarded(*technique_, visitor);
}

void HostedTechnique::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const FrameLight light{.light = inputs.light, .out = &out};
    renderLights({.view = inputs.view, .casters = inputs.casters, .lights = {&light, 1}});
}

void HostedTechnique::renderLights(const FrameInputs& frame) {
    const HostScope scope(internalsOf(device_));
    checkCasters(frame.casters, internalsOf(device_));
    checkFrame(frame, internalsOf(device_));
    if (frame.view.isOfPoints && !answersAtPoints()) {
        refuse("View: isOfPoints:",
               "this technique needs a picture: take one that answers at points, such as exact or auto");
    }
    warnOfPolygonOffset(scope.hostsPolygonOffset(), frame.view);
    if (internalsOf(device_).diagnoses) diagnoseOnce(frame);
    const ReadableTexture depth(frame.view.depthTexture), normals(frame.view.normalTexture),
        shadingNormals(frame.view.shadingNormalTexture), receivers(frame.view.receiverTexture);
    lights_.clear();
    const std::span<const Caster> casters = castersFor(frame.casters);
    for (const auto& [light, out, castsShadow] : frame.lights) {
        warnOfTube(light);
        ShadowInputs inputs{.view = frame.view, .light = light};
        if (castsShadow) inputs.casters = casters;
        lights_.push_back({lightFor(*technique_, inputs), &plain(*out, light, lights_.size()), castsShadow});
    }
    technique_->renderLights({view_.prepare(frame.view, frame.casters), casters, lights_, frame.answered});
    for (std::size_t i = 0; i < lights_.size(); ++i) deliver(*lights_[i].out, *frame.lights[i].out);
    // Whatever the host does with it next.
    internalsOf(device_).shaders.order()->makeAllVisible();
}

void HostedTechnique::diagnoseOnce(const FrameInputs& frame) {
    if (frame.view.isOfPoints || std::exchange(isDiagnosed_, true)) return;
    for (const std::string& finding :
         diagnoseInScope(internalsOf(device_), frame.view, frame.casters).findings)
        internalsOf(device_).log.write(LogLevel::warning, "diagnosis: " + finding);
}

void HostedTechnique::warnOfPolygonOffset(const PolygonOffset& ofHost, const View& view) {
    const PolygonOffset none;
    if (ofHost == none || view.polygonOffset != none) return;
    if (std::exchange(internalsOf(device_).hasWarnedOfPolygonOffset, true)) return;
    internalsOf(device_).log.write(
        LogLevel::warning,
        "GL_POLYGON_OFFSET_FILL is on: if the depths were drawn with it, state it in "
        "View::polygonOffset, or surfaces lie behind themselves and are dark");
}

void HostedTechnique::warnOfTube(const AreaLight& light) {
    if (light.shape != LightShape::cylinder || answersTubes() || !hasSize(light)) return;
    if (std::exchange(hasWarnedOfTube_, true)) return;
    internalsOf(device_).log.write(LogLevel::warning,
                                   "this technique takes tubes for flat strips that face the middle of the "
                                   "casters: exact and auto answer them as they are");
}

/// Panes are none for a technique that does not answer them.
std::span<const Caster> HostedTechnique::castersFor(std::span<const Caster> casters) {
    if (answersPanes() || std::ranges::none_of(casters, isPane)) return casters;
    if (!std::exchange(hasWarnedOfPanes_, true)) {
        internalsOf(device_).log.write(
            LogLevel::warning,
            "this technique lets all light through casters that let a share of it pass: "
            "exact and auto answer them as they are");
    }
    casters_.assign(casters.begin(), casters.end());
    for (Caster& caster : casters_) caster.casts = caster.casts && !isPane(caster);
    return casters_;
}

VisibilityBuffer& HostedTechnique::plain(VisibilityBuffer& out, const AreaLight& light, std::size_t place) {
    // Techniques that know of no panes answer in colour for textured lights alone.
    const bool colored = out.colored() && (light.radianceTexture != 0 || answersPanes());
    if (internalsOf(out).isPlain() && colored == out.colored()) return out;
    if (detours_.size() <= place) detours_.resize(place + 1);
    std::optional<VisibilityBuffer>& detour = detours_[place];
    if (!detour || detour->colored() != colored) {
        detour =
            VisibilityBuffer::Internals::make(internalsOf(device_), out.width_px(), out.height_px(), colored);
    }
    detour->resize(out.width_px(), out.height_px());
    return *detour;
}

void HostedTechnique::deliver(const VisibilityBuffer& written, const VisibilityBuffer& out) {
    if (&written == &out) return;
    if (!copy_) copy_.emplace(internalsOf(device_));
    const VisibilityBuffer::HostTexture& host = internalsOf(out).host;
    copy_->run({.texture = imageOf(written), .isGray = !written.colored()},
               {{.name = out.texture(),
                 .format = gl::Format(internalsOf(out).format),
                 .isLayered = false,
                 .record = &internalsOf(out).written},
                {host.x_px, host.y_px}},
               {out.width_px(), out.height_px()});
}

void HostedTechnique::inspect(InspectionVisitor& visitor) const {
    const HostScope scope(internalsOf(device_));
    technique_->inspect(visitor);
}

Statistics HostedTechnique::statistics() const {
    const HostScope scope(internalsOf(device_));
    return technique_->statistics();
}

}  // namespace penumbra
