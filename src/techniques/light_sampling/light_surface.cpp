// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/light_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace penumbra::light_sampling {
namespace {

using std::numbers::pi;

/// Keeps areas and neighbours (P. Shirley and K. Chiu, A low distortion map between disk and square, 1997).
glm::dvec2 diskFromSquare(const glm::dvec2& square) {
    const glm::dvec2 p = 2.0 * square - 1.0;
    if (p == glm::dvec2(0)) return p;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const double radius = wide ? p.x : p.y;
    const double angle = wide ? pi / 4 * (p.y / p.x) : pi / 2 - pi / 4 * (p.x / p.y);
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

glm::dvec3 perpendicularTo(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, other));
}

// The part of a sphere that anyone sees, and how densely to sample it. A receiver in direction w weighs the
// point with outward normal n by its solid angle, dA max(0, n.w) / d^2. Over receivers in a cone of
// half-angle b around the axis, the largest that n.w becomes at the angle t from the axis is cos(max(0, t -
// b)): it is taken for the density, so that no receiver's weight n.w / density exceeds 1. b = 0 makes it the
// disk that a distant receiver sees; b = pi the whole sphere, evenly. The density's integral over bands
// sin(t) dt:
double sphereShare(double t, double b) {
    if (t <= b) return 1 - std::cos(t);
    return 1 - std::cos(b) + 0.5 * (0.5 * (std::cos(b) - std::cos(2 * t - b)) + (t - b) * std::sin(b));
}

/// It stands for all of the light.
LightSample sampleAt(const glm::dvec3& place) {
    LightSample sample{};
    sample.place = glm::vec3(place);
    sample.perDensity = 1;
    setShare(sample, 1);
    return sample;
}

}  // namespace

LightSurface::LightSurface(const AreaLight& light, const LightSpaceScene& scene) : light_(light) {
    switch (light.shape) {
        case LightShape::rect:
            isPoint_ = light.width_m == 0 && light.height_m == 0;
            break;
        case LightShape::distant:
            isPoint_ = light.angle_rad == 0;
            break;
        default:
            isPoint_ = light.radius_m == 0;
    }
    if (light.shape != LightShape::sphere) return;
    std::pmr::vector<glm::dvec3> directions{gl::ObjectRegistryScope::frameMemory()};
    for (const ReceiverRegion::Polygon& polygon : scene.receivers.polygons) {
        for (const glm::dvec3& p : polygon) {
            // Whoever lies within the sphere sees all of its inside.
            if (glm::length(p) <= light.radius_m) {
                coneHalfAngle_rad_ = pi;
                return;
            }
            directions.push_back(glm::normalize(p));
        }
    }
    if (directions.empty()) return;
    axis_ = coneAxis(directions);
    across_ = perpendicularTo(axis_);
    along_ = glm::cross(axis_, across_);
    double narrowest = 1;
    for (const glm::dvec3& direction : directions)
        narrowest = std::min(narrowest, glm::dot(direction, axis_));
    // Polygons bulge out of the cone around their corners where they surround the light.
    coneHalfAngle_rad_ = narrowest < 0.3 ? pi : std::acos(std::min(narrowest, 1.0));
}

void setShare(LightSample& sample, float share) {
    sample.radianceShare = glm::vec3(share);
    sample.areaShare = share;
}

LightSample LightSurface::sample(const glm::dvec2& square) const {
    const auto flat = [](const glm::dvec3& place) { return sampleAt(place); };
    switch (light_.shape) {
        case LightShape::rect:
            return flat({(square.x - 0.5) * light_.width_m, (square.y - 0.5) * light_.height_m, 0});
        case LightShape::disk:
            return flat({double(light_.radius_m) * diskFromSquare(square), 0});
        case LightShape::distant: {
            // A band of the sphere has an area proportional to its height; 1 - cos(a/2) = 2 sin^2(a/4).
            const glm::dvec2 disk = diskFromSquare(square);
            const double sine = std::sin(light_.angle_rad / 4.0), oneMinusCos = 2 * sine * sine;
            const double fall = glm::dot(disk, disk) * oneMinusCos;
            return flat({std::sqrt(oneMinusCos * std::max(0.0, 2 - fall)) * disk, 1 - fall});
        }
        default:
            return spherePoint(diskFromSquare(square));
    }
}

LightSample LightSurface::sampleWithSpans(const glm::dvec2& square, double cellSide) const {
    LightSample middle = sample(square);
    const auto span = [&](const glm::dvec2& step) {
        return (sample(square + step).place - sample(square - step).place) / float(cellSide);
    };
    middle.spanU = span({0.5 * cellSide, 0});
    middle.spanV = span({0, 0.5 * cellSide});
    return middle;
}

LightSample LightSurface::spherePoint(const glm::dvec2& disk) const {
    // Where a cone's receivers just lose sight the density is zero; the outermost points stay a little
    // inside.
    const double radius = 0.99 * glm::length(disk);
    const double widest = std::min(pi, coneHalfAngle_rad_ + pi / 2);
    const double share = radius * radius * sphereShare(widest, coneHalfAngle_rad_);
    double low = 0, high = widest;
    for (int i = 0; i < 48; ++i) {
        const double middle = 0.5 * (low + high);
        (sphereShare(middle, coneHalfAngle_rad_) < share ? low : high) = middle;
    }
    const double t = 0.5 * (low + high);
    const double density = std::cos(std::max(0.0, t - coneHalfAngle_rad_));
    const glm::dvec2 around = radius > 0 ? glm::normalize(disk) : glm::dvec2(1, 0);
    const glm::dvec3 normal = std::cos(t) * axis_ + std::sin(t) * (around.x * across_ + around.y * along_);
    LightSample sample = sampleAt(double(light_.radius_m) * normal);
    sample.perDensity = float(1 / std::max(density, 1e-3));
    sample.outward = glm::vec3(normal);
    return sample;
}

InlineVector<glm::dvec3, 8> LightSurface::bounds() const {
    const double r = light_.radius_m;
    glm::dvec3 half(0);
    switch (light_.shape) {
        case LightShape::rect:
            half = {0.5 * light_.width_m, 0.5 * light_.height_m, 0};
            break;
        case LightShape::disk:
            half = {r, r, 0};
            break;
        case LightShape::sphere:
            half = {r, r, r};
            break;
        case LightShape::cylinder:
            half = {0.5 * double(light_.length_m), r, r};
            break;
        case LightShape::distant:
            return {};
    }
    InlineVector<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        corners.push_back(half * glm::dvec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1));
    }
    return corners;
}

std::pmr::vector<PatternPoint> makePattern(SamplePattern pattern, int perSide, int seed, bool equalWeights,
                                           double jitter) {
    std::pmr::vector<PatternPoint> points{gl::ObjectRegistryScope::frameMemory()};
    const int count = perSide * perSide;
    if (perSide == 1) {
        points.emplace_back();
        return points;
    }
    std::mt19937 random;  // of the standard's own seed: the same numbers everywhere
    const auto moved = [&] { return jitter / perSide * (double(random()) / double(random.max()) - 0.5); };
    const auto fraction = [](double x) { return x - std::floor(x); };
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 cell(i % perSide, i / perSide);
        PatternPoint point;
        switch (pattern) {
            case SamplePattern::cells:
                point = {(cell + 0.5) / double(perSide), cell / double(perSide),
                         (cell + 1.0) / double(perSide)};
                break;
            case SamplePattern::corners: {
                // Each stands for what is nearest to it: half as much at an edge, a quarter at a corner.
                const double spacing = 1.0 / (perSide - 1);
                point.square = cell * spacing;
                point.cellMin = glm::max(point.square - 0.5 * spacing, 0.0);
                point.cellMax = glm::min(point.square + 0.5 * spacing, 1.0);
                break;
            }
            case SamplePattern::sequence: {
                // The plane's additive recurrence of lowest discrepancy (M. Roberts 2018): powers of 1
                // / 1.3247..., shifted by a random amount (Cranley and Patterson 1976).
                constexpr double step = 0.7548776662466927;
                const glm::dvec2 shift(fraction(0.5 + seed * 0.6180339887498949),
                                       fraction(0.5 + seed * 0.4142135623730951));
                point.square = {fraction(shift.x + i * step), fraction(shift.y + i * step * step)};
                const double half = 0.5 / perSide;
                point.cellMin = glm::max(point.square - half, 0.0);
                point.cellMax = glm::min(point.square + half, 1.0);
                break;
            }
        }
        const glm::dvec2 extent = point.cellMax - point.cellMin;
        const bool even = equalWeights || pattern == SamplePattern::sequence;
        if (jitter > 0) {
            const double x = moved(), y = moved();
            point.square = glm::clamp(point.square + glm::dvec2(x, y), 0.0, 1.0);
        }
        point.weight = even ? 1.0 / count : extent.x * extent.y;
        points.push_back(point);
    }
    return points;
}

std::vector<LightSample> ballSamples(double radius_m, int perSide) {
    // A slice of the ball at the height h has the area pi (1 - h^2): the share below h is (2 + 3 h - h^3)
    // / 4.
    const auto heightAt = [](double share) {
        double low = -1, high = 1;
        for (int i = 0; i < 48; ++i) {
            const double middle = 0.5 * (low + high);
            (2 + middle * (3 - middle * middle) < 4 * share ? low : high) = middle;
        }
        return 0.5 * (low + high);
    };
    std::vector<LightSample> samples;
    for (int z = 0; z < perSide; ++z) {
        const double height = heightAt((z + 0.5) / perSide);
        for (const PatternPoint& point : makePattern(SamplePattern::cells, perSide, 0, false)) {
            const glm::dvec2 disk = std::sqrt(1 - height * height) * diskFromSquare(point.square);
            samples.push_back(sampleAt(radius_m * glm::dvec3(disk, height)));
        }
    }
    return samples;
}

}  // namespace penumbra::light_sampling
