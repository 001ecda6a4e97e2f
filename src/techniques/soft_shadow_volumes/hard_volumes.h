// SPDX-License-Identifier: Apache-2.0
// Shadow volumes of the light's centre (Crow 1977; Everitt and Kilgard 2003; Bergeron 1986 and Kim et al.
// 2008 for casters that are not closed). No penumbra, but edges as sharp as the picture.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

namespace penumbra::soft_shadow_volumes {

class HardVolumes final : public Technique {
  public:
    explicit HardVolumes(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    int counting_ = 0;
    int openMeshes_ = int(OpenMeshes::signedEdges);

    Device::Internals& device_;
    VolumeCounter counter_;
    gl::Program resolve_;
    FrameBinding binding_;
    AlphaMaskWarning alphaMaskWarning_;
    gl::PassTimers timers_;
};

}  // namespace penumbra::soft_shadow_volumes
