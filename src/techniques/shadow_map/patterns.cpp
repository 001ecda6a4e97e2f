// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/patterns.h"

#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <random>

namespace penumbra::shadow_map {
namespace {

glm::vec2 goldenDirection(int i) {
    const double angle = double(i) * glm::pi<double>() * (3.0 - std::sqrt(5.0));
    return {float(std::cos(angle)), float(std::sin(angle))};
}

/// The binary digits of `i`, mirrored at the point (van der Corput).
double radicalInverse(std::uint32_t i) {
    double inverse = 0;
    for (double digit = 0.5; i != 0; i >>= 1, digit *= 0.5) inverse += (i & 1) != 0 ? digit : 0;
    return inverse;
}

}  // namespace

std::vector<glm::vec2> poissonDisk(int count) {
    std::minstd_rand random(1);  // its sequence is prescribed by the standard
    const auto coordinate = [&] { return float(2.0 * double(random()) / double(random.max()) - 1.0); };
    std::vector<glm::vec2> points;
    while (int(points.size()) < count) {
        glm::vec2 best(0);
        float bestDistance = -1;
        for (int candidates = 0; candidates < 64;) {
            const float x = coordinate();
            const glm::vec2 candidate(x, coordinate());
            if (glm::dot(candidate, candidate) > 1) continue;
            ++candidates;
            float distance = std::numeric_limits<float>::infinity();
            for (const glm::vec2& point : points)
                distance = std::min(distance, glm::distance(point, candidate));
            if (distance > bestDistance) {
                bestDistance = distance;
                best = candidate;
            }
        }
        points.push_back(best);
    }
    return points;
}

std::vector<glm::vec2> squarePattern(int count) {
    std::vector<glm::vec2> points;
    for (int i = 0; i < count; ++i) {
        const double across = (i + 0.5) / count;
        const double up = radicalInverse(std::uint32_t(i)) + 0.5 / count;
        points.emplace_back(float(2 * across - 1), float(2 * std::fmod(up, 1.0) - 1));
    }
    return points;
}

std::vector<glm::vec2> diskPattern(int count) {
    std::vector<glm::vec2> points;
    for (int i = 0; i < count; ++i)
        points.push_back(float(std::sqrt((i + 0.5) / count)) * goldenDirection(i));
    return points;
}

std::vector<glm::vec4> searchPattern(int count) {
    std::vector<glm::vec4> points;
    for (int i = 0; i < count; ++i) {
        points.emplace_back(goldenDirection(i), i == 0 ? 0.0f : float((i + 0.5) / count), 0.0f);
    }
    return points;
}

}  // namespace penumbra::shadow_map
