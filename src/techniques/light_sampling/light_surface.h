// SPDX-License-Identifier: Apache-2.0
// Points of a light: the unit square laid over it so that equal areas of the square are equal shares of the
// light.
#pragma once

#include <glm/glm.hpp>
#include <memory_resource>
#include <vector>

#include "src/techniques/common/inline_vector.h"
#include "src/techniques/common/light_camera.h"
#include "src/techniques/light_sampling/sampling_io.h"

namespace penumbra::light_sampling {

/// What a sample stands for where the light has no picture: as much of its emission as of its area.
void setShare(LightSample& sample, float share);

/// Rect: as it is. Disk: the concentric map of Shirley and Chiu 1997. Distant: the same, lifted to the cap of
/// directions so that areas are solid angles. Sphere: see `spherePoint`.
class LightSurface {
  public:
    LightSurface(const AreaLight& light, const LightSpaceScene& scene);

    /// A light without size: all of the square is one point.
    bool isPoint() const { return isPoint_; }

    /// A sample at `square` in [0, 1]^2, of weight 1.
    LightSample sample(const glm::dvec2& square) const;
    /// The same with its spans: how it moves with `square`, over a cell of the lattice.
    LightSample sampleWithSpans(const glm::dvec2& square, double cellSide) const;

    /// The corners of a box around all samples; of a distant light, nothing.
    InlineVector<glm::dvec3, 8> bounds() const;

  private:
    LightSample spherePoint(const glm::dvec2& disk) const;

    AreaLight light_;
    bool isPoint_;
    // Sphere: the cone in which receivers lie as seen from the centre.
    glm::dvec3 axis_{0, 0, -1}, across_{1, 0, 0}, along_{0, 1, 0};
    double coneHalfAngle_rad_ = 0;
};

enum class SamplePattern {
    cells,     ///< the middles of n x n cells
    corners,   ///< an n x n lattice that includes the light's corners (the paper's)
    sequence,  ///< n^2 points of a randomly shifted additive recurrence
};

/// A sample and the part of the square that it stands for.
struct PatternPoint {
    glm::dvec2 square{0.5};
    glm::dvec2 cellMin{0}, cellMax{1};
    double weight = 1;  ///< share of the square's area
};

/// `jitter`: each point is moved at random, alike at each call, by up to half as many sides of a cell.
std::pmr::vector<PatternPoint> makePattern(SamplePattern pattern, int perSide, int seed, bool equalWeights,
                                           double jitter = 0);

/// A ball that shines from all of its inside: the middles of n x n x n pieces of equal volume, of weight 1.
std::vector<LightSample> ballSamples(double radius_m, int perSide);

}  // namespace penumbra::light_sampling
