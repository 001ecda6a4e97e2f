// SPDX-License-Identifier: Apache-2.0
// Percentage-closer soft shadows (R. Fernando, SIGGRAPH 2005 sketches): look for blockers around the
// receiver's place in the map, take from their mean depth how wide the penumbra is, and filter over that
// width.
#pragma once

#include <array>

#include "penumbra/promise.h"
#include "penumbra/technique.h"
#include "src/gl/buffer.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/shadow_map/nearest_tiles.h"
#include "src/techniques/shadow_map/shadow_map_io.h"

namespace penumbra::shadow_map {

class Pcss final : public Technique {
  public:
    static constexpr std::array promises = {Promise{{}, {}, 0.4f, 1.8f}};

    explicit Pcss(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    enum class Pattern { fixed, rotated };
    enum class BlockerMean { arithmetic, harmonic };

    PcssConstants constantsOf(const AreaLight& light) const;
    void updatePatterns(const AreaLight& light);

    int mapSize_px_ = 2048;
    int searchSamples_ = 64;
    int filterSamples_ = 64;
    int pattern_ = int(Pattern::fixed);
    int blockerMean_ = int(BlockerMean::harmonic);
    float lightScale_ = 1;

    DepthMap depthMap_;
    NearestTiles nearestTiles_;
    gl::Program resolve_;
    ViewBinding view_;
    gl::StorageArray<glm::vec4> searchPattern_;
    gl::StorageArray<glm::vec2> filterPattern_;
    int searchPatternSize_ = 0, filterPatternSize_ = 0;
    bool filterPatternIsSquare_ = false;
    gl::PassTimers timers_;
};

}  // namespace penumbra::shadow_map
