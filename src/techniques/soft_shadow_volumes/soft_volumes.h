// SPDX-License-Identifier: Apache-2.0
// Soft shadow volumes (U. Assarsson and T. Akenine-Möller, SIGGRAPH 2003), as a thesis built them in OpenGL,
// and past that: layers are counted at points of the light, from the silhouettes that each receiver sees. See
// README.md.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

namespace penumbra {

class SoftVolumes final : public Technique {
  public:
    explicit SoftVolumes(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    void allocate(const VolumeFrame& frame);
    void prepareSamples(const AreaLight& light);
    void gatherEdges(const VolumeFrame& frame);
    void resolve(GLuint target, GLenum format);
    void resolveHard(const VisibilityBuffer& out);
    int chooseSize();
    void upsample(const VisibilityBuffer& out);
    void drawWedges(GLuint target, GLenum format);

    enum class Method { layers, wedges };
    int method_ = int(Method::layers);
    int counting_ = 0;
    int samples_ = 64;
    int vBufferSize_ = 0;       // full, half, quarter
    float frameBudget_ms_ = 0;  // 0: none
    int budgetedSize_ = 0;      // the size that the budget has led to

    Device::Internals& device_;
    VolumeCounter counter_;
    gl::Program gather_, bounds_, lists_, radiance_, resolve_, hardResolve_, wedges_, wedgeResolve_,
        upsample_;
    gl::VertexArrayHandle noVertices_;
    int sampleCount_ = 0;     // of this light
    int resolveSamples_ = 0;  // that `resolve_` was made for
    int placedSamples_ = 0;
    bool placedOnSquare_ = false;
    ViewBinding view_;
    gl::ConstantBuffer<VolumeConstants> constants_;
    VolumeConstants frame_{};
    gl::Buffer lightEdges_, tileBounds_, tileLists_, samplePlaces_, sampleRadiances_;
    gl::Texture edgeCounts_, wedgeLayers_, vBuffer_;
    gl::Framebuffer wedgeFramebuffer_;
    std::size_t largestEdgeCount_ = 0;
    AlphaMaskWarning alphaMaskWarning_;
    gl::PassTimers timers_;
};

}  // namespace penumbra
