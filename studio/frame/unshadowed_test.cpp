// SPDX-License-Identifier: Apache-2.0
// What lights without shadows give, against sums in double precision and closed forms.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "src/gl/pass.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

/// As in unshadowed_test.comp.glsl.
struct Case {
    glm::vec4 pos;
    glm::vec4 normal;
    glm::vec4 size;
};

/// Irradiance of a flat light for a radiance of 1, by summing cos * cos / d^2 over a fine grid of its area.
double sumOverFlatLight(const Case& c, bool disk) {
    constexpr int n = 600;
    const glm::dvec3 pos(c.pos), normal(c.normal);
    const glm::dvec2 half = disk ? glm::dvec2(c.size.z) : glm::dvec2(c.size);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const glm::dvec2 unit((i + 0.5) / n * 2 - 1, (j + 0.5) / n * 2 - 1);
            if (disk && glm::dot(unit, unit) > 1) continue;
            const glm::dvec3 towards = glm::dvec3(unit * half, 0) - pos;
            const double d2 = glm::dot(towards, towards);
            sum += std::max(0.0, glm::dot(normal, towards)) * std::abs(towards.z) / (d2 * d2);
        }
    }
    return sum * 4 * half.x * half.y / (double(n) * n);
}

/// The same for a cone of directions: a grid of equal solid angles.
double sumOverCone(const glm::dvec3& axis, const glm::dvec3& normal, double sine) {
    constexpr int n = 600;
    const double cosine = std::sqrt(1 - sine * sine);
    const glm::dvec3 side =
        glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 other = glm::cross(axis, side);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double z = 1 - (i + 0.5) / n * (1 - cosine);
            const double r = std::sqrt(std::max(0.0, 1 - z * z));
            const double phi = (j + 0.5) / n * 2 * glm::pi<double>();
            const glm::dvec3 direction = z * axis + r * (std::cos(phi) * side + std::sin(phi) * other);
            sum += std::max(0.0, glm::dot(normal, direction));
        }
    }
    return sum * 2 * glm::pi<double>() * (1 - cosine) / (double(n) * n);
}

class UnshadowedTest : public TechniqueTest {
  protected:
    static void evaluate(std::vector<Case>& cases) {
        workbench().makeCurrent();
        gl::ShaderLibrary shaders{PENUMBRA_SOURCE_DIRECTORY};
        const gl::Program program(shaders, {"studio/frame/unshadowed_test.comp.glsl"});
        gl::Buffer buffer(std::as_bytes(std::span(cases)), "cases");
        gl::Pass(program).bind("Cases", buffer).dispatch(cases.size());
        buffer.read(std::as_writable_bytes(std::span(cases)));
    }

    /// Receivers in front of the light at random, facing anywhere: many have the light across their horizon.
    static std::vector<Case> randomCases(LightShape shape) {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> unit(-1, 1);
        std::vector<Case> cases;
        while (cases.size() < 40) {
            const glm::vec3 pos(2 * unit(random), 2 * unit(random), -0.6f - 2 * std::abs(unit(random)));
            const glm::vec3 normal(unit(random), unit(random), unit(random));
            if (glm::length(normal) < 0.1f) continue;
            cases.push_back({glm::vec4(pos, float(shape)), glm::vec4(glm::normalize(normal), 0),
                             glm::vec4(0.4f, 0.25f, 0.5f, 0.3f)});
        }
        return cases;
    }
};

// Tolerances: of the quadratures above, 1e-3 of the light's own irradiance where the horizon cuts their
// grids.

TEST_F(UnshadowedTest, RectIsLambertsFormula) {
    // A 2 x 2 light at z = 2, seen from the axis: E = 0.75227 (closed form C8).
    std::vector<Case> axis = {{{0, 0, -2, 0}, {0, 0, 1, 0}, {1, 1, 0, 0}}};
    evaluate(axis);
    EXPECT_NEAR(axis[0].normal.w, 0.75227, 1e-4);

    std::vector<Case> cases = randomCases(LightShape::rect);
    evaluate(cases);
    for (const Case& c : cases) EXPECT_NEAR(c.normal.w, sumOverFlatLight(c, false), 1e-3);
}

TEST_F(UnshadowedTest, DiskOnAxisAndTilted) {
    // E = pi R^2 / (R^2 + H^2) (closed form C9).
    std::vector<Case> axis = {{{0, 0, -2, 1}, {0, 0, 1, 0}, {0, 0, 0.5f, 0}}};
    evaluate(axis);
    EXPECT_NEAR(axis[0].normal.w, glm::pi<double>() * 0.25 / 4.25, 2e-4);

    std::vector<Case> cases = randomCases(LightShape::disk);
    evaluate(cases);
    for (const Case& c : cases) EXPECT_NEAR(c.normal.w, sumOverFlatLight(c, true), 2e-3);
}

TEST_F(UnshadowedTest, SphereAndDistantAreConesOfDirections) {
    std::vector<Case> cases = randomCases(LightShape::sphere);
    evaluate(cases);
    for (const Case& c : cases) {
        const glm::dvec3 pos(c.pos);
        const double sine = c.size.z / glm::length(pos);
        EXPECT_NEAR(c.normal.w, sumOverCone(-glm::normalize(pos), glm::dvec3(c.normal), sine), 2e-3);
    }
    cases = randomCases(LightShape::distant);
    evaluate(cases);
    for (const Case& c : cases) {
        EXPECT_NEAR(c.normal.w, sumOverCone({0, 0, 1}, glm::dvec3(c.normal), std::sin(0.3)), 2e-3);
    }
}

/// The same of a tube along X, over its side.
double sumOverTube(const Case& c) {
    constexpr int n = 600;
    const glm::dvec3 pos(c.pos), normal(c.normal);
    const double length = 2.0 * c.size.x, radius = c.size.z;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * glm::pi<double>() * (i + 0.5) / n;
        const glm::dvec3 outward(0, std::cos(angle), std::sin(angle));
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 point = radius * outward + glm::dvec3(length * ((j + 0.5) / n - 0.5), 0, 0);
            const glm::dvec3 towards = point - pos;
            const double d2 = glm::dot(towards, towards);
            sum += std::max(0.0, glm::dot(normal, towards)) * std::max(0.0, -glm::dot(outward, towards)) /
                   (d2 * d2);
        }
    }
    return sum * length * 2 * glm::pi<double>() * radius / (double(n) * n);
}

/// Of a tube's end at the distance d over a surface that faces its axis, l long from there on: what of a
/// hemisphere's irradiance it gives (D. C. Hamilton, W. R. Morgan, Radiant-interchange configuration factors,
/// NACA TN 2836, 1952).
double tubeFactor(double l, double r, double d) {
    const double D = d / r, L = l / r, A = (D + 1) * (D + 1) + L * L, B = (D - 1) * (D - 1) + L * L;
    const double pi = glm::pi<double>();
    return std::atan(L / std::sqrt(D * D - 1)) / (pi * D) +
           L / pi *
               ((A - 2 * D) / (D * std::sqrt(A * B)) * std::atan(std::sqrt(A * (D - 1) / (B * (D + 1)))) -
                std::atan(std::sqrt((D - 1) / (D + 1))) / D);
}

TEST_F(UnshadowedTest, TubesAreWithinHalfAPercentOfTheirClosedForm) {
    constexpr float shape = float(LightShape::cylinder);
    std::vector<Case> cases;
    std::vector<double> expected;
    for (const double radius : {0.004, 0.013, 0.1, 0.5}) {
        for (const double away : {1.05, 1.3, 2.0, 5.0, 30.0, 200.0}) {  // in radii
            for (const double length : {0.3, 1.2, 6.0}) {
                const double d = away * radius;
                // A receiver under the middle, and one under an end.
                for (const double x : {0.0, 0.5 * length}) {
                    cases.push_back(
                        {glm::vec4(x, 0, -d, shape), {0, 0, 1, 0}, glm::vec4(0.5 * length, 0, radius, 0)});
                    expected.push_back(glm::pi<double>() *
                                       (tubeFactor(0.5 * length + x, radius, d) +
                                        (x == 0 ? tubeFactor(0.5 * length, radius, d) : 0)));
                }
            }
        }
    }
    evaluate(cases);
    double worst = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        worst = std::max(worst, std::abs(cases[i].normal.w / expected[i] - 1));
        EXPECT_NEAR(cases[i].normal.w / expected[i], 1, 0.005)
            << "radius " << cases[i].size.z << ", " << -cases[i].pos.z << " m away, half of it "
            << cases[i].size.x << " m long";
    }
    RecordProperty("worst", std::to_string(worst));

    cases = randomCases(LightShape::cylinder);
    evaluate(cases);
    for (const Case& c : cases) {
        // Its own irradiance: of the sum of all that a receiver here could get.
        const double sum = sumOverTube(c);
        EXPECT_NEAR(c.normal.w, sum, 0.005 * sum + 1e-3);
    }
    // As far away as this it is a point whose candela go with the sine to its axis; turned about it, the
    // same.
    cases = {{{0, 0, -100, shape}, {0, 0, 1, 0}, {0.5f, 0, 0.1f, 0}},
             {{0, 100, 0, shape}, {0, -1, 0, 0}, {0.5f, 0, 0.1f, 0}},
             {{-60, 0, -80, shape}, {0.6f, 0, 0.8f, 0}, {0.5f, 0, 0.1f, 0}},
             {{-60, 48, -64, shape}, {0, 0, 1, 0}, {0.5f, 0, 0.1f, 0}},
             {{3, 0.05f, 0, shape}, {-1, 0, 0, 0}, {0.5f, 0, 0.1f, 0}}};
    evaluate(cases);
    EXPECT_NEAR(cases[0].normal.w, 0.2 * 1e-4, 1e-3 * 0.2e-4);
    EXPECT_NEAR(cases[1].normal.w, cases[0].normal.w, 1e-3 * 0.2e-4);
    EXPECT_NEAR(cases[2].normal.w, 0.8 * 0.2e-4, 1e-3 * 0.2e-4);
    EXPECT_NEAR(cases[3].normal.w, 0.64 * 0.8 * 0.2e-4, 1e-3 * 0.2e-4);
    EXPECT_EQ(cases[4].normal.w, 0) << "its ends are dark";
}

}  // namespace
}  // namespace penumbra::studio
