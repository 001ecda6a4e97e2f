// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/hard_volumes.h"

#include <array>

namespace penumbra::soft_shadow_volumes {

HardVolumes::HardVolumes(Device& device)
    : device_(internalsOf(device)),
      counter_(device),
      resolve_(internalsOf(device).shaders, {"src/techniques/soft_shadow_volumes/hard_volumes.comp.glsl"}),
      alphaMaskWarning_(device) {}

void HardVolumes::describe(ParameterVisitor& visitor) {
    describeCounting(visitor, counting_);
    describeOpenMeshes(visitor, openMeshes_);
}

void HardVolumes::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    alphaMaskWarning_.check(inputs.casters);
    VolumeFrame frame(inputs, 1, VolumeFrame::Count::drawn);
    if (openMeshes_ == int(OpenMeshes::capped)) frame.capHoles(device_);
    binding_.fill(inputs.view, frame);
    {
        const auto pass = timers_.pass("hard-volumes/count");
        counter_.render(frame, binding_, Counting(counting_));
    }
    {
        const auto pass = timers_.pass("hard-volumes/resolve");
        gl::Pass(resolve_)
            .bind(binding_)
            .bind(counter_)
            .bind("visibility", imageOf(out))
            .dispatchPixels(out.width_px(), out.height_px());
    }
}

void HardVolumes::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "counts", .texture = counter_.counts().name(), .white = 4});
    visitor.texture({.name = "receiver depth", .texture = counter_.depth().name()});
}

Statistics HardVolumes::statistics() const {
    return {.counts = {{"edges", double(counter_.silhouettes().edgeCount())}}, .passes = passTimes(timers_)};
}

}  // namespace penumbra::soft_shadow_volumes
