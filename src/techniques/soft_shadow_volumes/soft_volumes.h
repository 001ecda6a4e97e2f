// SPDX-License-Identifier: Apache-2.0
// Soft shadow volumes (U. Assarsson and T. Akenine-Möller, SIGGRAPH 2003), as a thesis built them in OpenGL,
// and past that: layers are counted at points of the light, from the silhouettes that each receiver sees. See
// README.md.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/soft_shadow_volumes/tile_layers.h"
#include "src/techniques/soft_shadow_volumes/volume_counter.h"
#include "src/techniques/soft_shadow_volumes/wedge_raster.h"

namespace penumbra::soft_shadow_volumes {

class SoftVolumes final : public Technique {
  public:
    explicit SoftVolumes(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    void resolveHard(const VisibilityBuffer& out);
    int chooseSize();
    void upsample(const VisibilityBuffer& out);

    enum class Method { layers, wedges };
    int method_ = int(Method::layers);
    int counting_ = 0;
    TileLayers::Effort effort_;
    int marking_ = int(WedgeRaster::Marking::none);
    int layerFormat_ = int(WedgeRaster::LayerFormat::floats);
    int openMeshes_ = int(OpenMeshes::signedEdges);
    bool wireframe_ = false;
    int vBufferSize_ = 0;  // full, half, quarter
    enum class Upsampling { plane, point };
    int upsampling_ = int(Upsampling::plane);
    float frameBudget_ms_ = 0;   // 0: none
    std::size_t edgeCount_ = 0;  // of the last frame's casters
    int budgetedSize_ = 0;       // the size that the budget has led to
    int framesAtSize_ = 0;       // since then

    Device::Internals& device_;
    const bool isSoftware_;
    VolumeCounter counter_;
    TileLayers layers_;
    WedgeRaster wedges_;
    gl::Program hardResolve_, upsampleEven_, upsample_;
    FrameBinding binding_;
    gl::Texture vBuffer_;
    gl::Buffer mixedTiles_;  // of the picture, that upsample_ has to look at
    AlphaMaskWarning alphaMaskWarning_;
    gl::PassTimers timers_;
    gl::PassTimers sizeTimers_;  // whole frames, a pass for each size of the V-buffer
};

}  // namespace penumbra::soft_shadow_volumes
