// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/camera_control.h"

#include <algorithm>
#include <cmath>

namespace penumbra::studio::viewer {
namespace {

/// Straight up and down the camera would not know which way is right.
constexpr float steepest_rad = glm::radians(89.0f);

glm::vec3 direction(float yaw_rad, float pitch_rad) {
    return {std::cos(pitch_rad) * std::sin(yaw_rad), std::sin(pitch_rad),
            std::cos(pitch_rad) * std::cos(yaw_rad)};
}

}  // namespace

void CameraControl::startFrom(const Camera& camera, const Bounds& bounds) {
    const glm::vec3 eye(camera.worldFromCamera[3]);
    const glm::vec3 back = glm::normalize(glm::vec3(camera.worldFromCamera[2]));
    const float depth_m = glm::dot(eye - bounds.center(), back);
    distance_m_ = std::max({depth_m, 0.05f * bounds.radius(), 1e-3f});
    target_ = eye - distance_m_ * back;
    pitch_rad_ = std::clamp(std::asin(std::clamp(back.y, -1.0f, 1.0f)), -steepest_rad, steepest_rad);
    yaw_rad_ = std::atan2(back.x, back.z);
    // Looking straight down, what is up in the picture tells where the eye would sink to.
    if (std::abs(back.y) > 0.9999f) {
        const glm::vec3 up = std::copysign(1.0f, -back.y) * glm::vec3(camera.worldFromCamera[1]);
        yaw_rad_ = std::atan2(up.x, up.z);
    }
    fov_deg_ = glm::degrees(camera.yfov_rad);
    height_m_ = camera.orthographicHeight_m;
}

void CameraControl::lookFrom(const LookAt& look) {
    startFrom(lookAtCamera(look), {});
    distance_m_ = glm::distance(look.eye, look.target);
    target_ = look.target;
}

glm::vec3 CameraControl::towardsEye() const {
    return direction(yaw_rad_, pitch_rad_);
}

glm::vec3 CameraControl::right() const {
    return {std::cos(yaw_rad_), 0, -std::sin(yaw_rad_)};
}

void CameraControl::orbit(float right_rad, float up_rad) {
    yaw_rad_ -= right_rad;
    pitch_rad_ = std::clamp(pitch_rad_ - up_rad, -steepest_rad, steepest_rad);
}

void CameraControl::pan(float right_, float up) {
    const float height_m = height_m_.value_or(2 * distance_m_ * std::tan(0.5f * glm::radians(fov_deg_)));
    const glm::vec3 upWorld = glm::cross(towardsEye(), right());
    target_ -= height_m * (right_ * right() + up * upWorld);
}

void CameraControl::zoom(float steps) {
    const float factor = std::pow(0.88f, std::clamp(steps, -20.0f, 20.0f));
    distance_m_ = std::clamp(distance_m_ * factor, 1e-4f, 1e7f);
    if (height_m_) height_m_ = std::clamp(*height_m_ * factor, 1e-4f, 1e7f);
}

void CameraControl::look(float right_rad, float up_rad) {
    const glm::vec3 eye = target_ + distance_m_ * towardsEye();
    yaw_rad_ -= right_rad;
    pitch_rad_ = std::clamp(pitch_rad_ - up_rad, -steepest_rad, steepest_rad);
    target_ = eye - distance_m_ * towardsEye();
}

void CameraControl::fly(const glm::vec3& way_m) {
    target_ += way_m.x * right() + way_m.y * glm::vec3(0, 1, 0) - way_m.z * towardsEye();
}

void CameraControl::frame(const Bounds& bounds, float aspect) {
    const float radius_m = std::max(bounds.radius(), 1e-3f);
    target_ = bounds.center();
    // A ball fits where the narrower of the picture's two half angles sees it from outside.
    const float half = std::tan(0.5f * glm::radians(fov_deg_)) * std::min(1.0f, aspect);
    distance_m_ = radius_m / std::sin(std::atan(half));
    if (height_m_) height_m_ = 2 * radius_m / std::min(1.0f, aspect);
}

LookAt CameraControl::lookAt() const {
    return {.eye = target_ + distance_m_ * towardsEye(),
            .target = target_,
            .fov_deg = fov_deg_,
            .height_m = height_m_};
}

}  // namespace penumbra::studio::viewer
