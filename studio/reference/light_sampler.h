// SPDX-License-Identifier: Apache-2.0
// Which points of a light a receiver may see, and how much each counts.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "penumbra/light.h"
#include "studio/reference/reference.h"
#include "studio/reference/traced_triangle.h"

namespace penumbra::studio {

/// A part of the light above the receiver's horizon.
struct LightSample {
    glm::vec3 direction;  ///< from the receiver to the sample; of a distant light a unit vector
    bool infinite;        ///< nothing ends the ray
    glm::vec3 weight;     ///< what the part counts, per channel, >= 0; all zero where it counts nothing
};

/// Maps the unit square to a light as one receiver sees it, evenly in area (rect, disk), in solid angle
/// (sphere, distant), or along the tube and across what it shows (cylinder).
class LightSampler {
  public:
    LightSampler(const AreaLight& light, const RadianceTexture* texture, ReferenceOptions::Weight weight);

    /// The light is a point or a single direction: every sample is the same.
    bool isPoint() const { return isPoint_; }
    int channels() const { return texture_ ? 3 : 1; }
    /// Of rect and disk lights alone.
    std::optional<LightPlane> plane() const;

    /// The light from one receiver.
    class FromReceiver {
      public:
        FromReceiver(const LightSampler& sampler, const glm::vec3& posWorld, const glm::vec3& normalWorld);
        /// Some of the light is above the receiver's horizon and emits this way.
        bool isAboveHorizon() const;
        /// The sample for `square` in [0, 1)^2. Its weight is 0 if it is below the horizon or not emitting
        /// this way.
        LightSample sample(const glm::vec2& square) const;

      private:
        LightSample flat(const glm::vec2& square) const;
        LightSample cone(const glm::vec2& square) const;
        LightSample tube(const glm::vec2& square) const;

        const LightSampler& light_;
        glm::vec3 normalWorld_;
        glm::vec3 toCenter_{0};
        float distance_ = 0;  // to the sphere's centre
        bool emitsThisWay_ = true;
        // The cone of directions in which a sphere or distant light lies: its axis, two vectors across, and 1
        // - cos of its half-angle, kept in this form because 1 - cos of a small angle would cancel. Of a tube
        // axis_ is the way to its axis, the shortest one, and across_ its other side.
        glm::vec3 axis_{0}, across_{0}, along_{0};
        float oneMinusCos_ = 0;
        // Of a tube: the way to its axis, from there to the plane through its two outer lines, and how far
        // these are from that plane's middle.
        float away_ = 0, toOuterLines_ = 0, halfWidth_ = 0;
    };

  private:
    glm::vec3 radianceAt(const glm::vec2& square) const;

    AreaLight shape_;
    const RadianceTexture* texture_;
    bool irradiance_;
    bool isPoint_ = false;
    glm::vec3 axisX_, axisY_, axisZ_, center_;
};

}  // namespace penumbra::studio
