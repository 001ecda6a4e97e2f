// SPDX-License-Identifier: Apache-2.0
// The exact mode: silhouettes as short straight pieces, the nearest of which every cell of a map knows (A.
// Meijster, J. Roerdink, W. Hesselink, A general algorithm for computing distance transforms in linear time,
// 2000), and penumbrae as wide as the light makes them on both sides of these.
#pragma once

#include <array>
#include <memory_resource>
#include <vector>

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/shadow_width_map/receiver_binding.h"

namespace penumbra::shadow_width_map {

class ExactWidths {
  public:
    explicit ExactWidths(Device& device);

    void describe(ParameterVisitor& visitor);

    /// Appends what the edges depend on, beside scene and cameras: equal numbers, equal edges.
    void appendKey(std::pmr::vector<double>& key) const;

    /// Finds the edges in `depthMap`, and in a map of its own those that are hidden in that. `halfExtent` is
    /// the light's largest, in metres; of a distant light, a tangent.
    void make(const ShadowInputs& inputs, const LightSpaceScene& scene, std::span<const LightCamera> cameras,
              const DepthMap& depthMap, float halfExtent, gl::PassTimers& timers);

    void resolve(const ReceiverBinding& receivers, gl::PassTimers& timers);
    void inspect(InspectionVisitor& visitor) const;

    int kinds() const { return kinds_; }  ///< of edges (edge_cells.glsl) in the maps as they are
    /// A cell's width in texels of maps of a size.
    static int cell_px(int mapSize_px);
    /// Cells along a map of a size.
    static int cellsAcross(int mapSize_px);

  private:
    void findNearest(const DepthMap& depthMap, float halfExtent, gl::PassTimers& timers);
    gl::TextureRef farthestMap() const;

    bool innerEdges_ = true;
    bool hiddenEdges_ = true;

    DepthMap farthest_;
    gl::Program edgeBlocks_, cellEdges_, edgeColumns_, edgeRows_;
    gl::Program resolve_, resolveOneMap_;  ///< whatever there is; one map, and normals
    std::array<gl::Program, 4> penumbra_,
        crowded_;  ///< whatever there is; one map, normals and so many kinds
    gl::Texture cells_, columns_, nearest_, cellWidths_;
    gl::Buffer listedBlocks_, penumbraPixels_, crowdedPixels_;
    int kinds_ = 1;
    int mapCount_ = 0;
};

}  // namespace penumbra::shadow_width_map
