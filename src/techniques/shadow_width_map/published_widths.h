// SPDX-License-Identifier: Apache-2.0
// Kirsch and Döllner 2003 as published: shadow widths by compositing on the device or by sweeps on the CPU
// (section 4), and the attenuation that follows from them (section 3).
#pragma once

#include <memory_resource>
#include <vector>

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/shadow_width_map/attenuation.h"
#include "src/techniques/shadow_width_map/receiver_binding.h"

namespace penumbra::shadow_width_map {

class PublishedWidths {
  public:
    enum class Construction { compositing, cpuSweep };

    explicit PublishedWidths(Device& device);

    void describe(ParameterVisitor& visitor);

    /// Replaces the curve. Throws Error::Kind::badArgument, naming the property, if it is not a function as
    /// the paper wants it; the curve stays as it was then.
    void setAttenuation(const AttenuationFunction& attenuation);

    /// Appends what the widths depend on, beside the depth maps: equal numbers, equal widths.
    void appendKey(std::pmr::vector<double>& key) const;

    /// What the depth maps shall show of the casters.
    DepthMap::Surface surfaceFor(const ShadowInputs& inputs) const;

    /// The widths of depth maps that show `surface`; `plane_m` away from the light is a plane behind all
    /// casters.
    void make(Construction construction, const DepthMap& depthMap, DepthMap::Surface surface, double plane_m,
              gl::PassTimers& timers);

    /// `meanHalfExtent` is the light's, in metres; of a distant light, a tangent.
    void resolve(const ReceiverBinding& receivers, float meanHalfExtent, gl::PassTimers& timers);
    void inspect(InspectionVisitor& visitor) const;

  private:
    void composite(const DepthMap& depthMap);
    void sweepOnCpu(const DepthMap& depthMap);

    bool backFaces_ = true;
    bool physical_ = true;
    float cScale_ = 8;
    float cBias_ = 0;
    int curve_ = 0;
    int widthsAt_ = 0;
    int neighbours_ = 1;
    int startDifference_ = 3;
    int steps_ = 0;

    std::vector<float> table_;
    bool isTableUploaded_ = false;
    gl::Program composite_, resolve_;
    gl::Texture widths_, scratch_, curveTable_;
    int mapCount_ = 0;
    float background_ = 0;  ///< the depth where there is no caster
    double plane_m_ = 0;
};

}  // namespace penumbra::shadow_width_map
