// SPDX-License-Identifier: Apache-2.0
// Real-time soft shadows using a single light sample (F. Kirsch and J. Döllner, Journal of WSCG 11(1), 2003):
// a map of distances to the shadow's border beside the depth map, from which the penumbra's attenuation
// follows. The published constructions, and an exact one whose penumbra is as wide as the light makes it, on
// both sides of the hard edge.
#pragma once

#include <array>

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/shadow_width_map/attenuation.h"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

namespace penumbra {

class ShadowWidthMap final : public Technique {
  public:
    explicit ShadowWidthMap(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

    /// Replaces the curve of the published modes. Throws Error::Kind::badArgument, naming the property, if it
    /// is not a function as the paper wants it.
    void setAttenuation(const AttenuationFunction& attenuation);

  private:
    enum Mode { exact, compositing, cpuSweep };

    void makeMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                  std::span<const LightCamera> cameras);
    void findNearestEdges(const AreaLight& light);
    void composite();
    void sweepOnCpu();
    void resolve(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld, VisibilityBuffer& out);
    void allocate(gl::Texture& texture, int size_px, int layers, gl::Format format,
                  std::string_view label) const;
    void allocateWidths(bool scratch);
    void resolvePublished(const VisibilityBuffer& out);
    void resolveExact(const View& view, const VisibilityBuffer& out);
    ShadowWidthConstants constants(const AreaLight& light, const glm::dmat3& spaceFromLight) const;
    int cell_px() const;
    int cellsAcross() const { return (mapSize_px_ + cell_px() - 1) / cell_px(); }
    float background() const { return backFaces_ ? 1.0f : 0.0f; }

    int mode_ = exact;
    int mapSize_px_ = 1024;
    bool innerEdges_ = true;
    bool hiddenEdges_ = true;
    bool reuseMaps_ = true;
    bool physical_ = true;
    float cScale_ = 8;
    float cBias_ = 0;
    int curve_ = 0;
    int neighbours_ = 1;
    int startDifference_ = 3;

    DepthMap depthMap_, farthestMap_;
    gl::Program edgeBlocks_, cellEdges_, edgeColumns_, edgeRows_;
    gl::Program resolve_, resolveOneMap_;  ///< whatever there is; one map, and normals
    std::array<gl::Program, 4> penumbra_,
        crowded_;  ///< whatever there is; one map, normals and so many kinds
    gl::Program composite_, published_;
    gl::Texture cells_, columns_, nearest_, cellWidths_;  ///< exact mode
    gl::Texture widths_, scratch_, curveTable_;           ///< published modes
    int tabulatedCurve_ = -1;
    gl::Buffer listedBlocks_, penumbraPixels_, crowdedPixels_;
    gl::ConstantBuffer<ShadowWidthConstants> constants_;
    ViewBinding view_;
    gl::PassTimers timers_;

    int kinds_ = 1;  ///< of edges (edge_cells.glsl) in the maps as they are
    bool backFaces_ = false;
    LightCameraConstants firstCamera_{};  ///< in its own space
    glm::dmat4 faceFromLight_{1};
    std::vector<double> mapsMadeFrom_;
    int timesMade_ = 0;
};

}  // namespace penumbra
