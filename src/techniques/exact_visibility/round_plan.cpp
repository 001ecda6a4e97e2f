// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/round_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra::exact_visibility {
namespace {

// Of the work of a receiver, as resolve.comp.glsl counts it.
constexpr double perNode = 2, perTriangle = 8, perRow = 32, perRound = 1000;
constexpr double mostRounds = 1e6;

int roundsOf(double work, int roundWork) {
    return int(std::min(1 + std::ceil(work / (roundWork - perRound)), mostRounds));
}

int mostSamplesOf(std::span<const LightLattice> lattices) {
    int most = 0;
    for (const LightLattice& lattice : lattices) {
        int count = 0;
        for (const unsigned row : lattice.validRows) count += std::popcount(row);
        most = std::max(most, count);
    }
    return most;
}

/// Whether a receiver may see the light through six windows (light.glsl): any sphere, and distant lights of
/// which an edge is more than 60 degrees from the middle.
bool mayFillHalfTheSky(const AreaLight& light) {
    constexpr float widest_rad = 1.0471f;  // 60 degrees, but for rounding
    return light.shape == LightShape::sphere ||
           (light.shape == LightShape::distant && 0.5f * light.angle_rad > widest_rad);
}

/// How many triangles may take a look at each sample: those with holes, and those that may reach the light.
/// Spheres and tubes may make any triangle one, flat lights those of casters that come near their planes:
/// within a hundredth of the scene's size, for receivers up to a thousand times that away.
std::size_t countSpecial(const CasterSoup& soup, const glm::vec3& eye, const ExactLight& light,
                         LightShape shape) {
    if (shape == LightShape::distant) return soup.maskedCount();
    if (shape == LightShape::sphere || shape == LightShape::cylinder) return soup.triangleCount();
    const float size = glm::distance(eye, light.center) + soup.farthestFrom(light.center);
    return soup.maskedCount() + soup.countNear(light.center, light.axisZ, 0.01f * size);
}

/// Of a turn for all that lets no light through.
double turnWork(const CasterSoup& soup, std::size_t special, int samples, std::size_t rows) {
    return double(soup.nodeCount()) * perNode + double(soup.triangleCount()) * perTriangle +
           double(special) * double(rows + std::size_t(samples)) + perRow * double(rows);
}

/// Of a step in which samples are taken through panes.
double paneWork(const CasterSoup& soup, std::size_t rows) {
    constexpr double perPaneTriangle = 4 + 2 * EXACT_PANE_SAMPLES;
    return double(soup.nodeCount()) * perNode +
           double(soup.paneTriangleCount()) * (perTriangle + perPaneTriangle) + perRow * double(rows) +
           10 * EXACT_PANE_SAMPLES;
}

}  // namespace

RoundPlan planRounds(const CasterSoup& soup, const AreaLight& light, const ExactLight& described,
                     std::span<const LightLattice> lattices, const glm::vec3& eye, std::size_t maskTextures,
                     int roundWork) {
    RoundPlan plan;
    for (const LightLattice& lattice : lattices) plan.rows = std::max(plan.rows, lattice.validRows.size());
    const int samples = mostSamplesOf(lattices);
    // A turn for each group of alpha textures, for each lattice, in each of a cone's windows, for all that
    // lets no light through and then for some samples after the others.
    plan.groups = std::max(int((maskTextures + EXACT_GROUP_TEXTURES - 1) / EXACT_GROUP_TEXTURES), 1);
    const int windows = int(lattices.size()) * (mayFillHalfTheSky(light) ? 6 : 1);
    const bool hasPanes = soup.paneTriangleCount() > 0;
    plan.paneSteps = hasPanes ? (samples + EXACT_PANE_SAMPLES - 1) / EXACT_PANE_SAMPLES : 0;
    const int paneRounds = hasPanes ? roundsOf(paneWork(soup, plan.rows), roundWork) : 0;
    const std::size_t special = countSpecial(soup, eye, described, light.shape);
    plan.turnRounds = roundsOf(turnWork(soup, special, samples, plan.rows), roundWork);
    plan.rounds = windows * (plan.turnRounds + plan.paneSteps * paneRounds);
    if (plan.groups > 1) {  // all turns take the same time
        plan.turnRounds = std::max(plan.turnRounds, paneRounds);
        plan.rounds = windows * (1 + plan.paneSteps) * plan.groups * plan.turnRounds;
    }
    return plan;
}

}  // namespace penumbra::exact_visibility
