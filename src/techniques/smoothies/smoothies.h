// SPDX-License-Identifier: Apache-2.0
// Rendering fake soft shadows with smoothies (E. Chan, F. Durand, Eurographics Symposium on Rendering 2003):
// a shadow map, and geometry attached to the blockers' silhouettes that fades the shadow's edges. README.md
// says what is theirs and what goes past it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "penumbra/technique.h"
#include "src/geometry/silhouette_extractor.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/gl/texture.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/smoothies/smoothie_buffer.h"
#include "src/techniques/smoothies/smoothie_constants.h"
#include "src/techniques/smoothies/smoothie_construction.h"

namespace penumbra::smoothies {

class Smoothies final : public Technique {
  public:
    explicit Smoothies(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    /// A program of the picture's passes, for receivers with normals of their own or without: software
    /// rasterizers take both sides of a branch.
    struct PicturePrograms {
        PicturePrograms(Device& device, const std::string& file, std::vector<std::string> defines);
        gl::Program withoutNormals, withNormals;
        const gl::Program& of(const View& view) const {
            return view.normalTexture != 0 ? withNormals : withoutNormals;
        }
    };

    void drawMaps(const ShadowInputs& inputs, const LightSpaceScene& scene, const LightCameras& cameras);
    void drawSmoothies(const ShadowInputs& inputs, const LightSpaceScene& scene);
    void profileLight(std::uint32_t radianceTexture);
    SmoothieBuffer::Keeps keeps() const { return SmoothieBuffer::Keeps(settings_.buffer); }
    PictureConstants pictureConstants(const ShadowInputs& inputs) const;
    void resolve(const ShadowInputs& inputs, const VisibilityBuffer& out);
    void resolveStored(const ShadowInputs& inputs, const VisibilityBuffer& out);
    void resolveMasked(const ShadowInputs& inputs, const LightSpaceScene& scene, const LightCameras& cameras,
                       const VisibilityBuffer& out);

    SmoothieSettings settings_;

    Device::Internals& device_;
    DepthMap depthMap_, farthestMap_, maskedMap_, receiverMap_;
    bool hasFarthestMap_ = false;
    bool hasMaskedMap_ = false;
    bool hasReceiverMap_ = false;
    SilhouetteExtractor silhouettes_;
    SmoothieConstruction construction_;
    SmoothieBuffer buffer_;
    gl::Program lightProfileProgram_;
    PicturePrograms classify_, resolve_, resolveColored_, stored_, storedColored_, masked_, maskedColored_;
    gl::Buffer tiles_;
    gl::Texture lightProfile_;
    gl::Buffer constants_;  ///< of the cameras, and as many again, so that a block may begin with any
    ViewBinding view_;
    gl::PassTimers timers_;
    bool hasSmoothies_ = false;
    bool saidMasked_ = false;  ///< once is enough
};

}  // namespace penumbra::smoothies
