// SPDX-License-Identifier: Apache-2.0
// Depth as hosts have it, drawn as they draw it: not reversed, of every format, and no normals.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numeric>

#include "tests/support/host_depth.h"
#include "tests/support/random_ground.h"

namespace penumbra::studio {
namespace {

TEST_F(HostDepth, ThatIsNotReversedMakesNoSpeckles) {
    for (const Planes& range : {Planes{0.23, 23}, Planes{0.02, 20}}) {
        const ShadowInputs inputs = drawScene("primitives", {240, 150});
        const View& view = inputs.view;
        const Image normals = readTexture(view.normalTexture, view.width_px, view.height_px, 3);
        const glm::vec3 towardsLight(fromPenumbra(inputs.light.worldFromLight)[2]);
        const Image expected = visibility(inputs, best, range);
        for (const DepthForm& form : usual) {
            const Image seen = visibility(inputs, form, range);
            int darker = 0, lighter = 0;
            for (std::size_t i = 0; i < seen.values.size(); ++i) {
                // As far as it is seen: where a facet grazes the light, normals out of the depth let even the
                // best depth shadow itself.
                const glm::vec3 normal(normals.values[3 * i], normals.values[3 * i + 1],
                                       normals.values[3 * i + 2]);
                const float arrives = std::max(glm::dot(normal, towardsLight), 0.0f);
                const float difference = arrives * (seen.values[i] - expected.values[i]);
                darker += difference < -0.1f;
                lighter += difference > 0.1f;
            }
            // What is left are outlines, where normals depend on which neighbour a pixel takes for its own.
            EXPECT_LE(darker, 4) << form.name << " from " << range.near_m << " m";
            // And, with the near plane at a 350th of the distance, contacts that the depth no longer tells
            // apart.
            EXPECT_LE(lighter, range.near_m > 0.1 ? 4 : 72) << form.name << " from " << range.near_m << " m";
        }
    }
}

// Whatever its depth: a ground that casts shadows nothing but what a ground that casts nothing does.
TEST_F(HostDepth, OfLargeGroundsShadowsNothing) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const RandomGround ground = makeRandomGround(seed);
        const auto seen = [&](const Scene& scene, const DepthForm& form) {
            const float eye_m = glm::length(glm::vec3(scene.at(0).cameras[0].worldFromCamera[3]));
            return visibility(drawScene(scene, {64, 40}), form, Planes{0.1 * eye_m, 20'000}, true);
        };
        for (const DepthForm& form : {best, usual[0], usual[1], usual[4]}) {
            const Image casting = seen(ground.casting, form), receiving = seen(ground.receiving, form);
            int darker = 0;
            for (std::size_t i = 0; i < casting.values.size(); ++i)
                darker += casting.values[i] < receiving.values[i];
            EXPECT_EQ(darker, 0) << form.name << ", " << ground.description;
        }
    }
}

double meanOf(const Image& image) {
    return std::accumulate(image.values.begin(), image.values.end(), 0.0) / double(image.values.size());
}

// With normals and without, on faces that are large and on some that are narrower than three pixels.
TEST_F(HostDepth, PolygonOffsetIsTakenOutAgain) {
    const Planes range{0.23, 23};
    const auto judge = [&](const ShadowInputs& inputs, const DepthForm& form, bool hasNormals) {
        std::map<std::string, Image> expected;
        for (const char* technique : {"hard", "pcss", "exact"})
            expected[technique] = visibility(technique, inputs, drawn(inputs, form, range, {}, hasNormals));
        const float away = form.convention.reversed ? -1 : 1;
        for (const auto& [factor, units] : {std::pair{0.01f, 0.0f}, {1.0f, 1.0f}, {2.0f, 8.0f}}) {
            const PolygonOffset offset{away * factor, away * units};
            View view = drawn(inputs, form, range, offset, hasNormals);
            view.polygonOffset = offset;
            for (const auto& [technique, before] : expected) {
                const Image seen = visibility(technique.c_str(), inputs, view);
                std::size_t specks = 0;
                for (std::size_t i = 0; i < seen.values.size(); ++i)
                    specks += seen.values[i] < before.values[i] - 0.3f;
                EXPECT_NEAR(meanOf(seen), meanOf(before), 0.005) << technique << ", factor " << offset.factor;
                EXPECT_LT(double(specks) / double(seen.values.size()), 0.005)
                    << technique << ", factor " << offset.factor;
            }
        }
    };
    for (const bool hasNormals : {true, false}) {
        for (const auto& [scene, size] :
             {std::pair{"primitives", PictureSize{240, 150}}, {"torus", PictureSize{120, 75}}}) {
            const ShadowInputs inputs = drawScene(scene, size);
            for (const DepthForm& form : {usual[0], usual[1], usual[2], usual[5], best}) {
                SCOPED_TRACE(std::string(scene) + ", " + form.name + (hasNormals ? ", normals" : ""));
                judge(inputs, form, hasNormals);
            }
        }
    }
}

// Surfaces that cast nothing are not among the casters that tell slopes: their own depths do.
TEST_F(HostDepth, PolygonOffsetOfWhatCastsNothingIsTakenOutAgain) {
    ShadowInputs inputs = drawScene("primitives", {240, 150});
    const Planes range{0.23, 23};
    const View before = drawn(inputs, usual[0], range, {});
    ShadowInputs others = inputs;
    others.casters = inputs.casters.first(inputs.casters.size() / 2);
    const double expected = meanOf(visibility("hard", others, before));
    View view = drawn(inputs, usual[0], range, {1, 1});
    view.polygonOffset = {1, 1};
    EXPECT_NEAR(meanOf(visibility("hard", others, view)), expected, 0.005);
}

TEST_F(HostDepth, PolygonOffsetThatIsNotStatedIsWarnedOfOnce) {
    int warnings = 0;
    Device device({.log = [&](LogLevel level, std::string_view) { warnings += level == LogLevel::warning; },
                   .shared = &this->device()});
    ShadowInputs inputs = drawScene("two-boxes", {96, 72});
    const auto technique = penumbra::makeTechnique(device, "hard");
    VisibilityBuffer out(device, 96, 72);
    const auto render = [&](bool isOn, const PolygonOffset& stated) {
        isOn ? glEnable(GL_POLYGON_OFFSET_FILL) : glDisable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
        inputs.view.polygonOffset = stated;
        technique->render(inputs, out);
    };
    render(false, {});
    render(true, {1, 1});
    EXPECT_EQ(warnings, 0);
    render(true, {});
    render(true, {});
    EXPECT_EQ(warnings, 1);
}

/// A camera and a light at the Earth's radius, with matrices of doubles as OpenSceneGraph has them.
TEST_F(HostDepth, WorldsAsLargeAsTheEarthLookAsAtTheOrigin) {
    ShadowInputs inputs = drawScene("primitives", {240, 150});
    const Image expected = visibility("exact", inputs, inputs.view);
    const glm::dvec3 place(6.378e6, -1.2e6, 3.4e5);
    const WorldOrigin origin{place.x + 1, place.y + 2, place.z - 1};
    const glm::dmat4 shift = glm::translate(glm::dmat4(1), place);
    const auto columns = [](const glm::dmat4& matrix) { return &matrix[0][0]; };
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    for (Caster& caster : casters)
        caster.worldFromMesh =
            origin.worldFrom(columns(shift * glm::dmat4(fromPenumbra(caster.worldFromMesh))));
    inputs.casters = casters;
    inputs.light.worldFromLight =
        origin.worldFrom(columns(shift * glm::dmat4(fromPenumbra(inputs.light.worldFromLight))));
    View view = inputs.view;
    view.viewFromWorld =
        origin.fromWorld(columns(glm::dmat4(fromPenumbra(view.viewFromWorld)) * glm::inverse(shift)));
    const Image seen = visibility("exact", inputs, view);
    double error = 0;
    for (std::size_t i = 0; i < seen.values.size(); ++i)
        error += std::abs(seen.values[i] - expected.values[i]) / double(seen.values.size());
    EXPECT_LE(error, 0.002);
}

TEST(MatricesOfHosts, ComeByRowsAndByColumns) {
    std::array<double, 16> numbers;
    std::iota(numbers.begin(), numbers.end(), 0.0);
    EXPECT_EQ(Mat4::fromColumns(numbers.data()).columns[3][1], 13);
    EXPECT_EQ(Mat4::fromRows(numbers.data()).columns[3][1], 7);
}

}  // namespace
}  // namespace penumbra::studio
