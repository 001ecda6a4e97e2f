// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra::studio {
namespace {

using std::numbers::pi_v;

glm::vec3 column(const Mat4& matrix, std::size_t index) {
    const auto& c = matrix.columns[index];
    return {c[0], c[1], c[2]};
}

/// Keeps areas and neighbours (Shirley and Chiu, "A low distortion map between disk and square", 1997).
glm::vec2 diskFromSquare(const glm::vec2& square) {
    const glm::vec2 p = 2.0f * square - 1.0f;
    if (p.x == 0 && p.y == 0) return {0, 0};
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    const float angle =
        wide ? pi_v<float> / 4 * (p.y / p.x) : pi_v<float> / 2 - pi_v<float> / 4 * (p.x / p.y);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

/// A unit vector across `axis`.
glm::vec3 perpendicularTo(const glm::vec3& axis) {
    const glm::vec3 other = std::abs(axis.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, other));
}

float emitted(float radiance) {
    return std::isfinite(radiance) ? std::max(radiance, 0.0f) : 0.0f;
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

LightSampler::LightSampler(const AreaLight& light, const RadianceTexture* texture,
                           ReferenceOptions::Weight weight)
    : shape_(light),
      texture_(light.shape == LightShape::rect && texture && texture->rgb.pixelCount() > 0 ? texture
                                                                                           : nullptr),
      irradiance_(weight == ReferenceOptions::Weight::irradiance),
      axisX_(column(light.worldFromLight, 0)),
      axisY_(column(light.worldFromLight, 1)),
      axisZ_(column(light.worldFromLight, 2)),
      center_(column(light.worldFromLight, 3)) {
    const auto size = [](float value) { return value > 0 ? value : 0.0f; };
    shape_.width_m = size(light.width_m);
    shape_.height_m = size(light.height_m);
    shape_.length_m = size(light.length_m);
    shape_.radius_m = size(light.radius_m);
    shape_.angle_rad = std::min(size(light.angle_rad), pi_v<float>);
    switch (light.shape) {
        case LightShape::rect:
            isPoint_ = shape_.width_m == 0 && shape_.height_m == 0;
            break;
        case LightShape::distant:
            isPoint_ = shape_.angle_rad == 0;
            break;
        case LightShape::cylinder:
            isPoint_ = shape_.length_m == 0 && shape_.radius_m == 0;
            break;
        default:
            isPoint_ = shape_.radius_m == 0;
            break;
    }
}

/// Bilinear, clamped to the edge; texel centres lie at (i + 1/2) / size.
glm::vec3 LightSampler::radianceAt(const glm::vec2& square) const {
    const Image& image = texture_->rgb;
    const auto channel = [&](int x, int y, int c) {
        return emitted(image.at(std::clamp(x, 0, image.width_px - 1), std::clamp(y, 0, image.height_px - 1),
                                std::min(c, image.channels - 1)));
    };
    const float s = square.x * float(image.width_px) - 0.5f, t = square.y * float(image.height_px) - 0.5f;
    const int x = int(std::floor(s)), y = int(std::floor(t));
    const float right = s - std::floor(s), up = t - std::floor(t);
    glm::vec3 radiance;
    for (int c = 0; c < 3; ++c) {
        radiance[c] = std::lerp(std::lerp(channel(x, y, c), channel(x + 1, y, c), right),
                                std::lerp(channel(x, y + 1, c), channel(x + 1, y + 1, c), right), up);
    }
    return radiance;
}

std::optional<LightPlane> LightSampler::plane() const {
    switch (shape_.shape) {
        case LightShape::rect:
            return LightPlane{center_, axisZ_,
                              0.5 * glm::length(glm::dvec2(shape_.width_m, shape_.height_m))};
        case LightShape::disk:
            return LightPlane{center_, axisZ_, glm::length(glm::dvec2(shape_.radius_m))};
        default:
            return std::nullopt;
    }
}

LightSampler::FromReceiver::FromReceiver(const LightSampler& sampler, const glm::vec3& posWorld,
                                         const glm::vec3& normalWorld)
    : light_(sampler), normalWorld_(normalWorld), toCenter_(sampler.center_ - posWorld) {
    const AreaLight& shape = light_.shape_;
    switch (shape.shape) {
        case LightShape::rect:
        case LightShape::disk:
            emitsThisWay_ = shape.twoSided || glm::dot(toCenter_, light_.axisZ_) > 0;
            return;
        case LightShape::distant: {
            // Light travels along -Z, hence it comes from +Z. 1 - cos(a/2) = 2 sin^2(a/4).
            axis_ = light_.axisZ_;
            const float sine = std::sin(shape.angle_rad / 4);
            oneMinusCos_ = 2 * sine * sine;
            break;
        }
        case LightShape::sphere: {
            distance_ = glm::length(toCenter_);
            axis_ = distance_ > 0 ? toCenter_ / distance_ : normalWorld;
            // sin = r / d of the half-angle; 1 - cos = sin^2 / (1 + cos). From inside, all directions: 1 -
            // cos = 2.
            const float sine = shape.radius_m / distance_;
            const float cosine = sine < 1 ? std::sqrt((1 - sine) * (1 + sine)) : 0.0f;
            oneMinusCos_ = sine < 1 ? sine * sine / (1 + cosine) : 2.0f;
            break;
        }
        case LightShape::cylinder: {
            const glm::vec3 across = toCenter_ - glm::dot(toCenter_, light_.axisX_) * light_.axisX_;
            away_ = glm::length(across);
            emitsThisWay_ = away_ > shape.radius_m || light_.isPoint_;
            axis_ = away_ > 0 ? across / away_ : light_.axisZ_;
            across_ = glm::cross(axis_, light_.axisX_);
            // Tangents from the receiver touch the circle at these places.
            const float sine = shape.radius_m / away_;
            toOuterLines_ = shape.radius_m * sine;
            halfWidth_ = shape.radius_m * std::sqrt(std::max((1 - sine) * (1 + sine), 0.0f));
            return;
        }
    }
    across_ = perpendicularTo(axis_);
    along_ = glm::cross(axis_, across_);
}

bool LightSampler::FromReceiver::isAboveHorizon() const {
    const AreaLight& shape = light_.shape_;
    const auto across = [&](const glm::vec3& axis) { return std::abs(glm::dot(normalWorld_, axis)); };
    const float center = glm::dot(normalWorld_, toCenter_);
    switch (shape.shape) {
        case LightShape::rect:
            return emitsThisWay_ && center + shape.width_m / 2 * across(light_.axisX_) +
                                            shape.height_m / 2 * across(light_.axisY_) >
                                        0;
        case LightShape::disk:
            return emitsThisWay_ &&
                   center + shape.radius_m * std::hypot(across(light_.axisX_), across(light_.axisY_)) > 0;
        case LightShape::cylinder:
            return emitsThisWay_ &&
                   center + shape.length_m / 2 * across(light_.axisX_) +
                           shape.radius_m * std::hypot(across(light_.axisY_), across(light_.axisZ_)) >
                       0;
        default:
            // The cone reaches its half-angle beyond a right angle with the normal.
            return oneMinusCos_ > 1 ||
                   glm::dot(normalWorld_, axis_) > -std::sqrt(oneMinusCos_ * (2 - oneMinusCos_));
    }
}

LightSample LightSampler::FromReceiver::sample(const glm::vec2& square) const {
    const LightShape shape = light_.shape_.shape;
    const bool isFlat = shape == LightShape::rect || shape == LightShape::disk;
    LightSample result = isFlat ? flat(square) : shape == LightShape::cylinder ? tube(square) : cone(square);
    // Written so that whatever is not a number is below the horizon, too.
    const bool aboveHorizon = glm::dot(normalWorld_, result.direction) > 0;
    if (!aboveHorizon || !emitsThisWay_ || !isFinite(result.direction)) result.weight = glm::vec3(0);
    return result;
}

LightSample LightSampler::FromReceiver::flat(const glm::vec2& square) const {
    const AreaLight& shape = light_.shape_;
    const glm::vec2 posLight = shape.shape == LightShape::rect
                                   ? (square - 0.5f) * glm::vec2(shape.width_m, shape.height_m)
                                   : shape.radius_m * diskFromSquare(square);
    LightSample result{toCenter_ + posLight.x * light_.axisX_ + posLight.y * light_.axisY_, false,
                       glm::vec3(1)};
    if (light_.texture_) result.weight = light_.radianceAt(square);
    if (light_.irradiance_) {
        // cos(receiver) cos(light) / d^2, each cosine being a dot product over d; kept finite for receivers
        // on the light.
        const double cosines = double(glm::dot(normalWorld_, result.direction)) *
                               std::abs(double(glm::dot(light_.axisZ_, toCenter_)));
        const double distance2 = glm::dot(glm::dvec3(result.direction), glm::dvec3(result.direction));
        result.weight *= float(std::clamp(cosines / (distance2 * distance2), 0.0, 1e30));
    }
    return result;
}

/// What a tube shows is its outline in the plane through its two outer lines: a line along it at the place s
/// across has there `stretch` times the tube's length, being nearer than that plane.
LightSample LightSampler::FromReceiver::tube(const glm::vec2& square) const {
    const AreaLight& shape = light_.shape_;
    if (light_.isPoint_) return {toCenter_, false, glm::vec3(1)};
    // Where the ray to the place (ahead, s) of that plane meets the circle first.
    const float s = (2 * square.y - 1) * halfWidth_, ahead = away_ - toOuterLines_;
    const float length2 = ahead * ahead + s * s, along = away_ * ahead;
    const float beyond = (away_ - shape.radius_m) * (away_ + shape.radius_m);
    const float root = std::sqrt(std::max(along * along - length2 * beyond, 0.0f));
    const float share = beyond / (along + root);
    const float stretch = 1 / share;
    const float posLight = (square.x - 0.5f) * shape.length_m + glm::dot(toCenter_, light_.axisX_);
    const glm::vec3 direction = share * (ahead * axis_ + s * across_) + posLight * light_.axisX_;
    float weight = stretch;
    if (light_.irradiance_) {
        // As of a flat light in that plane: of the same luminance, it shows the same from here.
        const double cosines = double(glm::dot(normalWorld_, direction)) * stretch * ahead;
        const double distance2 =
            glm::dot(glm::dvec3(direction), glm::dvec3(direction)) * double(stretch) * stretch;
        weight *= float(std::clamp(cosines / (distance2 * distance2), 0.0, 1e30));
    }
    return {direction, false, glm::vec3(weight)};
}

LightSample LightSampler::FromReceiver::cone(const glm::vec2& square) const {
    // A band of the sphere has an area proportional to its height, so that a point of the unit disk at radius
    // r goes to the height 1 - r^2 (1 - cos), where sin^2 = r^2 (1 - cos) (2 - r^2 (1 - cos)).
    const glm::vec2 disk = diskFromSquare(square);
    const float fall = glm::dot(disk, disk) * oneMinusCos_;
    const glm::vec3 direction = (1 - fall) * axis_ + std::sqrt(oneMinusCos_ * std::max(2 - fall, 0.0f)) *
                                                         (disk.x * across_ + disk.y * along_);
    const float weight = light_.irradiance_ ? std::max(glm::dot(normalWorld_, direction), 0.0f) : 1.0f;
    if (light_.shape_.shape == LightShape::distant) return {direction, true, glm::vec3(weight)};

    // The ray ends at the sphere: the near side of it from outside, the far side from inside.
    const float radius = light_.shape_.radius_m;
    if (radius == 0) return {toCenter_, false, glm::vec3(weight)};
    const float halfChord2 = radius * radius - distance_ * distance_ * fall * (2 - fall);
    const float halfChord = std::sqrt(std::max(halfChord2, 0.0f));
    const float middle = distance_ * (1 - fall);
    const float length = distance_ > radius ? middle - halfChord : middle + halfChord;
    return {length * direction, false, glm::vec3(weight)};
}

}  // namespace penumbra::studio
