// SPDX-License-Identifier: Apache-2.0
// Which points lie inside of things: there is no light to measure there, and a plan counts without them.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "studio/measure/point_set.h"

namespace penumbra::studio {

/// The closed bodies of a moment near some points: pieces that hang together, each of whose edges joins an
/// even number of triangles, of nodes that cast shadows. One with a light in it is a room, and counts as
/// none.
class ClosedBodies {
  public:
    ClosedBodies(const Scene& scene, const SceneMoment& moment, std::span<const MeasuringPoint> points);
    ~ClosedBodies();

    /// The name of the node in one of whose bodies the point lies; nullptr outside of all. On a surface a
    /// point is where its normal points to.
    const std::string* around(const MeasuringPoint& point) const;

  private:
    struct Body;
    std::vector<Body> bodies_;
};

}  // namespace penumbra::studio
