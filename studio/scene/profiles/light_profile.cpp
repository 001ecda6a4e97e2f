// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/light_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace penumbra::studio {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radians = pi / 180;

/// Which two angles a value lies between, and how far from the first to the second.
struct Between {
    std::size_t first = 0, second = 0;
    double share = 0;
};

std::optional<Between> locate(const std::vector<double>& angles_deg, double angle_deg) {
    // Directions come from arithmetic: a rounding error beyond the last angle is still that angle.
    constexpr double rounding_deg = 1e-9;
    if (angle_deg < angles_deg.front() - rounding_deg || angle_deg > angles_deg.back() + rounding_deg)
        return {};
    if (angles_deg.size() == 1) return Between{};
    const auto above = std::upper_bound(angles_deg.begin() + 1, angles_deg.end() - 1, angle_deg);
    const std::size_t second = std::size_t(above - angles_deg.begin());
    const double share = (angle_deg - angles_deg[second - 1]) / (angles_deg[second] - angles_deg[second - 1]);
    return Between{second - 1, second, std::clamp(share, 0.0, 1.0)};
}

/// A C angle as an angle of the grid: turned to its first plane, and mirrored into what it covers.
double foldedPlane_deg(const CandelaGrid& grid, double c_deg) {
    const double span = grid.horizontals_deg.back();
    if (span == 0) return 0;
    double beyond = std::fmod(c_deg - grid.firstPlane_deg, 360);
    if (beyond < 0) beyond += 360;
    if (span < 360 && beyond > 180) beyond = 360 - beyond;
    if (span < 180 && beyond > 90) beyond = 180 - beyond;
    return beyond;
}

/// {vertical, horizontal} angle of the grid for a direction of length 1.
std::pair<double, double> anglesOf(const CandelaGrid& grid, const glm::dvec3& d) {
    const auto asin_deg = [](double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)) / radians; };
    if (grid.type == CandelaGrid::Type::C) {
        // atan2 keeps what acos(-z) would lose near the poles.
        return {std::atan2(std::hypot(d.x, d.y), -d.z) / radians,
                foldedPlane_deg(grid, std::atan2(d.y, d.x) / radians)};
    }
    std::pair<double, double> angles;
    if (grid.type == CandelaGrid::Type::B) {
        angles = {std::atan2(d.x, -d.z) / radians, asin_deg(-d.y)};
    } else {
        angles = {asin_deg(d.z), std::atan2(-d.y, d.x) / radians};
    }
    if (grid.horizontals_deg.front() == 0) angles.second = std::abs(angles.second);
    return angles;
}

/// The integrals of sin t (1 - u) and sin t u, u running from 0 to 1 as t does from `from` to `to`.
std::pair<double, double> sineMoments(double from_rad, double to_rad) {
    const double width = to_rad - from_rad;
    const double whole = std::cos(from_rad) - std::cos(to_rad);
    const double second = (std::sin(to_rad) - std::sin(from_rad)) / width - std::cos(to_rad);
    return {whole - second, second};
}

/// Weights with which values at `angles_deg` sum up to the integral of their interpolant times the sine of
/// the angle from the pole, which is the angle itself + `pole_deg`.
std::vector<double> sineWeights(const std::vector<double>& angles_deg, double pole_deg) {
    std::vector<double> weights(angles_deg.size(), 0.0);
    for (std::size_t i = 1; i < angles_deg.size(); ++i) {
        const auto [first, second] =
            sineMoments((angles_deg[i - 1] + pole_deg) * radians, (angles_deg[i] + pole_deg) * radians);
        weights[i - 1] += first;
        weights[i] += second;
    }
    return weights;
}

/// The same without the sine.
std::vector<double> plainWeights(const std::vector<double>& angles_deg) {
    std::vector<double> weights(angles_deg.size(), 0.0);
    for (std::size_t i = 1; i < angles_deg.size(); ++i) {
        const double half = 0.5 * (angles_deg[i] - angles_deg[i - 1]) * radians;
        weights[i - 1] += half;
        weights[i] += half;
    }
    return weights;
}

}  // namespace

double CandelaGrid::at(const glm::dvec3& direction) const {
    const auto [vertical, horizontal] = anglesOf(*this, glm::normalize(direction));
    const auto v = locate(verticals_deg, vertical), h = locate(horizontals_deg, horizontal);
    if (!v || !h) return 0;
    const auto alongPlane = [&](std::size_t plane) {
        const float* const values = &candela[plane * verticals_deg.size()];
        return (1 - v->share) * values[v->first] + v->share * values[v->second];
    };
    return (1 - h->share) * alongPlane(h->first) + h->share * alongPlane(h->second);
}

float CandelaGrid::largest() const {
    return *std::ranges::max_element(candela);
}

bool CandelaGrid::shinesUp() const {
    for (std::size_t h = 0; h < horizontals_deg.size(); ++h) {
        for (std::size_t v = 0; v < verticals_deg.size(); ++v) {
            const double vertical = verticals_deg[v];
            const bool up = type == Type::C   ? vertical > 90
                            : type == Type::B ? std::abs(vertical) > 90
                                              : vertical > 0;
            if (up && candela[h * verticals_deg.size() + v] > 0) return true;
        }
    }
    return false;
}

bool CandelaGrid::isDarkAlongAxis() const {
    constexpr double nextToNothing = 0.01;
    return std::max(at({0, 0, -1}), at({0, 0, 1})) <= nextToNothing * double(largest());
}

double CandelaGrid::integral() const {
    // The solid angle is sin(gamma) dgamma dC, cos H dH dV and cos V dV dH.
    std::vector<double> v, h;
    double copies = 1;
    switch (type) {
        case Type::C:
            v = sineWeights(verticals_deg, 0);
            h = plainWeights(horizontals_deg);
            if (horizontals_deg.size() == 1) h = {2 * pi};
            if (horizontals_deg.size() > 1) copies = 360 / horizontals_deg.back();
            break;
        case Type::B:
            v = plainWeights(verticals_deg);
            h = sineWeights(horizontals_deg, 90);
            copies = horizontals_deg.front() == 0 ? 2 : 1;
            break;
        case Type::A:
            v = sineWeights(verticals_deg, 90);
            h = plainWeights(horizontals_deg);
            copies = horizontals_deg.front() == 0 ? 2 : 1;
            break;
    }
    double sum = 0;
    for (std::size_t i = 0; i < h.size(); ++i)
        for (std::size_t j = 0; j < v.size(); ++j) sum += h[i] * v[j] * candela[i * v.size() + j];
    return copies * sum;
}

std::string CandelaGrid::symmetry() const {
    if (type != Type::C) return horizontals_deg.front() == 0 ? "left and right alike" : "none";
    const double span = horizontals_deg.back();
    if (span == 0) return "rotational";
    if (span == 90) return "four quadrants alike";
    if (span == 180)
        return std::fmod(firstPlane_deg, 180) == 0 ? "mirrored across C0-C180" : "mirrored across C90-C270";
    return "none";
}

glm::dvec3 directionOf(double gamma_deg, double c_deg) {
    const double gamma = gamma_deg * radians, c = c_deg * radians;
    return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)};
}

double LightProfile::tiltFactor(double tilt_deg) const {
    if (tiltFactors.empty()) return 1;
    const auto above = std::ranges::upper_bound(tiltFactors, tilt_deg, {}, &TiltFactor::tilt_deg);
    if (above == tiltFactors.begin()) return above->factor;
    if (above == tiltFactors.end()) return tiltFactors.back().factor;
    const TiltFactor &below = *(above - 1), &next = *above;
    const double share = (tilt_deg - below.tilt_deg) / (next.tilt_deg - below.tilt_deg);
    return (1 - share) * below.factor + share * next.factor;
}

}  // namespace penumbra::studio
