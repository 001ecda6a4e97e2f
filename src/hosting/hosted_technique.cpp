// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/hosted_technique.h"

#include "src/hosting/host_scope.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/common/visibility_internals.h"

namespace penumbra {

HostedTechnique::HostedTechnique(Device& device, std::unique_ptr<Technique> (*make)(Device&))
    : device_(device), view_(device.internals()) {
    const HostScope scope(device.internals());
    technique_ = make(device);
}

void HostedTechnique::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const HostScope scope(device_.internals());
    checkTextures(inputs.view);
    const ReadableTexture depth(inputs.view.depthTexture), normals(inputs.view.normalTexture),
        receivers(inputs.view.receiverTexture);
    VisibilityBuffer& written = plain(out);
    technique_->render({view_.prepare(inputs.view), inputs.light, inputs.casters}, written);
    deliver(written, out);
    // Whatever the host does with it next.
    device_.internals().shaders.order()->makeAllVisible();
}

VisibilityBuffer& HostedTechnique::plain(VisibilityBuffer& out) {
    if (out.internals().isPlain()) return out;
    if (!detour_ || detour_->colored() != out.colored()) {
        detour_.emplace(device_, out.width_px(), out.height_px(), out.colored());
    }
    detour_->resize(out.width_px(), out.height_px());
    return *detour_;
}

void HostedTechnique::deliver(const VisibilityBuffer& written, const VisibilityBuffer& out) {
    if (&written == &out) return;
    if (!copy_) copy_.emplace(device_.internals());
    const VisibilityBuffer::HostTexture& host = out.internals().host;
    copy_->run({.texture = imageOf(written)},
               {{.name = host.texture,
                 .format = gl::Format(out.internals().format),
                 .isLayered = false,
                 .record = &out.internals().written},
                {host.x_px, host.y_px}},
               {host.width_px, host.height_px});
}

void HostedTechnique::inspect(InspectionVisitor& visitor) const {
    const HostScope scope(device_.internals());
    technique_->inspect(visitor);
}

Statistics HostedTechnique::statistics() const {
    const HostScope scope(device_.internals());
    return technique_->statistics();
}

}  // namespace penumbra
