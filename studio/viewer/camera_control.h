// SPDX-License-Identifier: Apache-2.0
// The camera that mouse and keys move. Pure arithmetic: knows no window.
#pragma once

#include "studio/scene/look_at.h"

namespace penumbra::studio::viewer {

class CameraControl {
  public:
    /// Takes over where `camera` stands, looking at the depth of the middle of `bounds`. A roll is lost: +Y
    /// is up.
    void startFrom(const Camera& camera, const Bounds& bounds);

    /// Stands just there.
    void lookFrom(const LookAt& look);

    /// Turns around what is looked at; `right` and `up` are what the hand did, in radians.
    void orbit(float right_rad, float up_rad);
    /// Moves what is looked at along with the hand; in picture heights.
    void pan(float right, float up);
    /// One step is a notch of the wheel; positive goes nearer. The target is never reached.
    void zoom(float steps);
    /// Turns the head.
    void look(float right_rad, float up_rad);
    /// Moves the eye: x right, y up (world), z forward, in metres.
    void fly(const glm::vec3& way_m);
    /// Keeps the direction and shows all of `bounds`.
    void frame(const Bounds& bounds, float aspect);

    LookAt lookAt() const;
    /// A sensible speed for flying, from how far away the target is.
    float flyingSpeed_mps() const { return 0.8f * distance_m_; }

  private:
    glm::vec3 towardsEye() const;
    glm::vec3 right() const;

    glm::vec3 target_{0};
    float distance_m_ = 5;
    float yaw_rad_ = 0, pitch_rad_ = 0;  ///< of the eye as seen from the target
    float fov_deg_ = 40;
    std::optional<float> height_m_;
};

}  // namespace penumbra::studio::viewer
