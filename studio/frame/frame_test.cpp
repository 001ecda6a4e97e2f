// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/placing.h"
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
        program.use();
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer.name());
        glDispatchCompute(GLuint(cases.size()), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
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

using FrameTest = TechniqueTest;

/// What a white floor reflects under a light is known in closed form.
Scene whiteFloorUnder(const Light& light) {
    Scene scene = makeBuiltin("half-plane");
    for (Material& material : scene.materials) material.baseColor = glm::vec4(1);
    return withMoment(std::move(scene), [light](SceneMoment& moment) {
        moment.lights = {light};
        moment.cameras.erase(moment.cameras.begin());  // leaves the one that looks straight down
        std::erase_if(moment.instances, [](const Instance& instance) { return instance.casts; });
    });
}

double centerRadiance_nits(const Scene& scene) {
    const std::unique_ptr<Technique> hard = TechniqueTest::workbench().makeTechnique("hard");
    const SceneMoment moment = scene.at(0);
    auto& workbench = TechniqueTest::workbench();
    workbench.open(scene);
    return workbench.run("hard", *hard, moment, moment.cameras.front(), {33, 33}).radiance.at(16, 16, 1);
}

TEST_F(FrameTest, RadianceIsInNits) {
    // A receiver under the middle of a light of radiance L at 4 m reflects E / pi.
    Light disk = diskLight("disk", 0.5f, {0, 4, 0}, {0, 0, 0}, 1);
    disk.emission = {Emission::Unit::nits, glm::vec3(1000)};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(disk)), 1000 * 0.25 / (0.25 + 16), 0.1);

    Light point = sphereLight("point", 0, {0, 4, 0}, {0, 0, 0}, 1);
    point.emission = {Emission::Unit::candela, glm::vec3(160)};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(point)), 160 / 16.0 / glm::pi<double>(), 0.01);

    Light sun = distantLight("sun", 0, {0, -1, 0}, 1);
    sun.emission = {Emission::Unit::lux, glm::vec3(100)};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(sun)), 100 / glm::pi<double>(), 0.1);
}

TEST_F(FrameTest, SpotsFallOffBetweenTheirCones) {
    Light spot = diskLight("spot", 0.1f, {0, 4, 0}, {0, 0, 0}, 1000);
    const double inFull = centerRadiance_nits(whiteFloorUnder(spot));
    spot.cone_rad = {0.3f, 0.5f};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(spot)), inFull, 1e-3 * inFull);
    // Turned away by an angle between the two, then beyond both.
    const auto turned = [&](double angle_rad) {
        Light light = diskLight("spot", 0.1f, {0, 4, 0}, {float(4 * std::tan(angle_rad)), 0, 0}, 1000);
        light.emission = spot.emission;
        light.cone_rad = spot.cone_rad;
        return centerRadiance_nits(whiteFloorUnder(light));
    };
    EXPECT_LT(turned(0.4), 0.9 * inFull);
    EXPECT_GT(turned(0.4), 0);
    EXPECT_EQ(turned(0.6), 0);
}

TEST_F(FrameTest, LightsAddUp) {
    const Scene one = makeBuiltin("primitives");
    const Scene two = withMoment(makeBuiltin("primitives"),
                                 [](SceneMoment& moment) { moment.lights.push_back(moment.lights.front()); });
    const auto radianceOf = [&](const Scene& scene) {
        const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
        const SceneMoment moment = scene.at(0);
        workbench().open(scene);
        return workbench().run("hard", *hard, moment, moment.cameras.front(), defaultSize).radiance;
    };
    const Image single = radianceOf(one), both = radianceOf(two);
    for (std::size_t i = 0; i < single.values.size(); ++i) {
        ASSERT_NEAR(both.values[i], 2 * single.values[i], 1e-4f * single.values[i]);
    }
}

TEST_F(FrameTest, PicturesAreUpright) {
    // The ground of this scene fills the lower rows, the sky's background the upper.
    const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
    const Scene scene = makeBuiltin("primitives");
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const TechniqueResult result =
        workbench().run("hard", *hard, moment, moment.cameras.front(), defaultSize);
    const auto& radiance = result.radiance;
    EXPECT_EQ(radiance.at(radiance.width_px / 2, 0, 1), 0);
    EXPECT_GT(radiance.at(radiance.width_px / 2, radiance.height_px - 1, 1), 0);
}

TEST_F(FrameTest, SceneWithoutLightsIsDarkButShown) {
    const Scene scene =
        withMoment(makeBuiltin("primitives"), [](SceneMoment& moment) { moment.lights.clear(); });
    const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const TechniqueResult result =
        workbench().run("hard", *hard, moment, moment.cameras.front(), defaultSize);
    EXPECT_TRUE(result.lights.empty());
    for (const float value : result.display.values) ASSERT_TRUE(value >= 0 && value <= 1);
}

}  // namespace
}  // namespace penumbra::studio
