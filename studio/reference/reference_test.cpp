// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/reference.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "studio/errors.h"
#include "studio/reference/test_scenes.h"

namespace penumbra::studio {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

double meanOf(const ReferenceResult& result, int channel = 0) {
    const Image& image = result.visibility;
    double sum = 0;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) sum += image.values[i * image.channels + channel];
    return sum / double(image.pixelCount());
}

/// That every pixel has exactly this value.
void expectAll(const ReferenceResult& result, float expected) {
    for (const float value : result.visibility.values) ASSERT_EQ(value, expected);
}

/// A floor of receivers around the origin.
ReceiverImage floorGrid(int size, float spacing_m, const glm::vec3& offset = {0, 0, 0}) {
    ReceiverImage receivers = repeated({0, 0, 0}, {0, 0, 1}, size, size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            receivers.posWorld[std::size_t(y) * size + x] =
                offset + spacing_m * glm::vec3(x - 0.5f * size + 0.37f, y - 0.5f * size + 0.41f, 0);
        }
    }
    receivers.eyeWorld = offset + glm::vec3(0, -4, 3);
    return receivers;
}

std::vector<AreaLight> oneOfEachShape() {
    return {rectAt({0, 0, 2}, 1, 0.5f), roundAt(LightShape::disk, {0.2f, 0, 2}, 0.4f),
            roundAt(LightShape::sphere, {0, 0.2f, 2}, 0.4f),
            AreaLight{.shape = LightShape::distant, .angle_rad = 0.3f}};
}

// --- The ends of the range ---

TEST(Reference, NothingBlocksIsExactlyOne) {
    for (const AreaLight& light : oneOfEachShape()) {
        for (const auto weight : {ReferenceOptions::Weight::area, ReferenceOptions::Weight::irradiance}) {
            const ReferenceResult result = ReferenceScene({}).trace(floorGrid(8, 0.3f), light, nullptr,
                                                                    {.samples = 65, .weight = weight});
            expectAll(result, 1);
            EXPECT_EQ(result.noise_rms, 0);
        }
    }
}

TEST(Reference, AClosedBoxRoundTheReceiversIsExactlyZero) {
    const ReferenceScene scene = Soup().box({-1, -1, -0.5f}, {1, 1, 1}).scene();
    for (const AreaLight& light : oneOfEachShape()) {
        expectAll(scene.trace(floorGrid(8, 0.2f), light, nullptr, {.samples = 64}), 0);
    }
}

TEST(Reference, PixelsThatReceiveNothingAreOne) {
    ReceiverImage receivers = repeated({0, 0, 0}, {0, 0, 1}, 2, 2);
    receivers.valid[0] = 0;
    receivers.posWorld[1].x = nan;
    receivers.normalWorld[2].y = std::numeric_limits<float>::infinity();
    const ReferenceResult result =
        Soup().rect(-1, 1, -1, 1, 1).scene().trace(receivers, rectAt({0, 0, 2}, 1, 1), nullptr, {});
    EXPECT_EQ(result.visibility.values, (std::vector<float>{1, 1, 1, 0}));
    EXPECT_EQ(result.rays, 256u);
}

// --- What counts as the whole light ---

TEST(Reference, TheHorizonCutsBothPartAndWhole) {
    // The receiver faces +x: only the light's x > 0 counts, of which the blocker hides 0 < x < 0.5.
    const AreaLight light = rectAt({0, 0, 2}, 2, 2);
    const Soup blocker = Soup().rect(-5, 0.25f, -5, 5, 1);
    const ReferenceResult result =
        blocker.scene().trace(repeated({0, 0, 0}, {1, 0, 0}), light, nullptr, {.samples = 1024});
    EXPECT_NEAR(meanOf(result), 0.5, 4 * result.noise_rms / 16);
    expectAll(ReferenceScene({}).trace(repeated({0, 0, 0}, {0, 0, -1}), light, nullptr, {}), 0);
}

TEST(Reference, ASliverOfTheLightAboveTheHorizonIsFound) {
    // Receivers that see the last hundredth of a radian of the light over their horizon, less than a percent
    // of it, and nothing in between: most of their first 64 samples miss it.
    const float halfAngle_rad = 0.2f;
    const float across_m = 4 * std::tan(halfAngle_rad);
    for (const AreaLight& light :
         {rectAt({0, 0, 2}, across_m, 0.5f), roundAt(LightShape::disk, {0, 0, 2}, across_m / 2),
          roundAt(LightShape::sphere, {0, 0, 2}, 2 * std::sin(halfAngle_rad)),
          AreaLight{.shape = LightShape::distant, .angle_rad = 2 * halfAngle_rad}}) {
        const auto facing = [&](float beyondTheHorizon_rad) {
            const float angle = halfAngle_rad + beyondTheHorizon_rad;
            return repeated({0, 0, 0}, {std::cos(angle), 0, -std::sin(angle)});
        };
        expectAll(ReferenceScene({}).trace(facing(-0.01f), light, nullptr, {.samples = 64}), 1);
        expectAll(ReferenceScene({}).trace(facing(0.001f), light, nullptr, {.samples = 64}), 0);
    }
}

TEST(Reference, AOneSidedLightIsSeenFromItsFrontOnly) {
    for (AreaLight light : {rectAt({0, 0, -1}, 1, 1), roundAt(LightShape::disk, {0, 0, -1}, 1)}) {
        const ReceiverImage behind = repeated({0, 0, 0}, {0, 0, -1});
        expectAll(ReferenceScene({}).trace(behind, light, nullptr, {}), 0);
        light.twoSided = true;
        expectAll(ReferenceScene({}).trace(behind, light, nullptr, {}), 1);
        const ReceiverImage inItsPlane = repeated({3, 0, -1}, {-1, 0, 0});
        expectAll(ReferenceScene({}).trace(inItsPlane, light, nullptr, {}), 1);
        light.twoSided = false;
        expectAll(ReferenceScene({}).trace(inItsPlane, light, nullptr, {}), 0);
    }
}

TEST(Reference, ALightOfSizeZeroIsItsCentre) {
    const ReferenceScene scene = Soup().rect(-5, 0, -5, 5, 1).scene();
    for (const LightShape shape :
         {LightShape::rect, LightShape::disk, LightShape::sphere, LightShape::distant}) {
        const AreaLight point = lightAt(shape, {0, 0, 2});
        const ReferenceResult shadowed = scene.trace(repeated({-1e-3f, 0, 0}), point, nullptr, {});
        const ReferenceResult lit = scene.trace(repeated({1e-3f, 0, 0}), point, nullptr, {});
        expectAll(shadowed, 0);
        expectAll(lit, 1);
        EXPECT_EQ(lit.rays, 256u);
        EXPECT_EQ(lit.noise_rms, 0);
    }
    // A line is no point.
    EXPECT_EQ(scene.trace(repeated({0, 0, 0}), rectAt({0, 0, 2}, 1, 0), nullptr, {}).rays, 256u * 256u);
}

TEST(Reference, InsideASphereLightAllDirectionsCount) {
    const AreaLight light = roundAt(LightShape::sphere, {0, 0, 0}, 2);
    expectAll(ReferenceScene({}).trace(repeated({0.5f, 0, 0}), light, nullptr, {}), 1);
    expectAll(ReferenceScene({}).trace(repeated({0, 0, 0}), light, nullptr, {}), 1);
    // A disc that hides all within 60 degrees of the normal hides half of the half above the horizon.
    const Soup disc = Soup().disc({0.5f, 0, 0.5f}, {0, 0, 1}, 0.5f * std::sqrt(3.0f));
    const ReferenceResult result =
        disc.scene().trace(repeated({0.5f, 0, 0}), light, nullptr, {.samples = 1024});
    EXPECT_NEAR(meanOf(result), 0.5, 4 * result.noise_rms / 16 + 2e-5);
}

TEST(Reference, ATextureWeighsTheLight) {
    // Two texels, red at -Y and green at +Y: between their centres red falls linearly. The blocker hides y <
    // 0, half of the light, and leaves of red the triangle from 1/2 to 3/4, which is 1/8 of all red.
    RadianceTexture texture{Image(1, 2, 3)};
    texture.rgb.at(0, 0, 0) = 5;
    texture.rgb.at(0, 1, 1) = 2;
    texture.rgb.at(0, 1, 2) = -1;
    const ReferenceResult result =
        Soup()
            .rect(-5, 5, -5, 0, 1)
            .scene()
            .trace(repeated({0, 0, 0}), rectAt({0, 0, 2}, 1, 1), &texture, {.samples = 1024});
    ASSERT_EQ(result.visibility.channels, 3);
    EXPECT_NEAR(meanOf(result, 0), 0.125, 4 * result.noise_rms / 16);
    EXPECT_NEAR(meanOf(result, 1), 0.875, 4 * result.noise_rms / 16);
    EXPECT_EQ(meanOf(result, 2), 0);  // no blue leaves the light, hence nothing is seen of it
}

TEST(Reference, ATextureOfOneColourChangesNothing) {
    RadianceTexture texture{Image(3, 2, 3, 0.25f)};
    const ReferenceScene scene = Soup().rect(-5, 0, -5, 5, 1).scene();
    const AreaLight light = rectAt({0, 0, 2}, 1, 1);
    const ReferenceResult plain = scene.trace(repeated({0, 0, 0}), light, nullptr, {});
    const ReferenceResult textured = scene.trace(repeated({0, 0, 0}), light, &texture, {});
    for (std::size_t i = 0; i < plain.visibility.pixelCount(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(plain.visibility.values[i], textured.visibility.values[3 * i + c]);
        }
    }
}

// --- Where rays start and end ---

TEST(Reference, ABlockerBehindTheLightOrBelowTheReceiverHidesNothing) {
    const ReferenceScene scene = Soup().rect(-5, 5, -5, 5, 2.7f).rect(-5, 5, -5, 5, -0.01f).scene();
    for (const AreaLight& light : oneOfEachShape()) {
        if (light.shape == LightShape::distant) continue;  // nothing is behind it
        expectAll(scene.trace(floorGrid(8, 0.3f), light, nullptr, {}), 1);
    }
}

TEST(Reference, ABlockerInTheReceiversPlaneHidesNothing) {
    const ReferenceScene scene = Soup().rect(-5, 5, -5, 5, 0).scene();
    for (const AreaLight& light : oneOfEachShape()) {
        expectAll(scene.trace(floorGrid(16, 0.3f), light, nullptr, {}), 1);
    }
}

TEST(Reference, ABlockerInTheLightsPlaneHidesNothing) {
    const ReferenceScene scene = Soup().rect(-5, 5, -5, 5, 2).scene();
    expectAll(scene.trace(floorGrid(16, 0.3f), rectAt({0, 0, 2}, 1, 1), nullptr, {}), 1);
    expectAll(scene.trace(floorGrid(16, 0.3f), roundAt(LightShape::disk, {0, 0, 2}, 1), nullptr, {}), 1);
}

TEST(Reference, ABlockerInsideASphereLightHidesNothing) {
    // Two walls through the sphere, one across the rays and one along them, both within it.
    const Soup walls = Soup()
                           .rect(-0.25f, 0.25f, -0.25f, 0.25f, 2)
                           .quad({0, -0.2f, 1.8f}, {0, 0.2f, 1.8f}, {0, 0.2f, 2.2f}, {0, -0.2f, 2.2f});
    const AreaLight light = roundAt(LightShape::sphere, {0, 0, 2}, 0.4f);
    expectAll(walls.scene().trace(floorGrid(8, 0.3f), light, nullptr, {}), 1);
}

TEST(Reference, APlainSlopeFarFromTheOriginDoesNotShadowItself) {
    // Positions with the errors of a depth buffer, on a plane askew, under grazing light.
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.2f, 1));
    const glm::vec3 a = glm::normalize(glm::cross(normal, glm::vec3(0, 1, 0))), b = glm::cross(normal, a);
    for (const glm::vec3& offset : {glm::vec3(0, 0, 0), glm::vec3(1000, -300, 20)}) {
        Soup slope;
        slope.quad(offset - 9.0f * a - 9.0f * b, offset + 9.0f * a - 9.0f * b, offset + 9.0f * a + 9.0f * b,
                   offset - 9.0f * a + 9.0f * b);
        ReceiverImage receivers = repeated(offset, normal, 32, 32);
        receivers.eyeWorld = offset + 5.0f * normal;
        std::mt19937 random(1);
        const auto within = [&](float size) { return size * (float(random() >> 8) * 0x1p-23f - 1.0f); };
        for (glm::vec3& posWorld : receivers.posWorld) {
            posWorld += within(8) * a + within(8) * b;
            posWorld += within(5e-7f) * glm::distance(posWorld, receivers.eyeWorld) * normal;
        }
        const AreaLight light = roundAt(LightShape::sphere, offset + 12.0f * a + 0.3f * normal, 0.2f);
        expectAll(slope.scene().trace(receivers, light, nullptr, {.samples = 64}), 1);
    }
}

TEST(Reference, ABoxOnTheFloorNeitherLeaksNorReachesTooFar) {
    for (const glm::vec3& offset : {glm::vec3(0), glm::vec3(200, 50, 0)}) {
        const ReferenceScene scene = Soup()
                                         .box(offset, offset + glm::vec3(1))
                                         .rect(offset.x - 5, offset.x + 5, offset.y - 5, offset.y + 5, 0)
                                         .scene();
        const AreaLight light = rectAt(offset + glm::vec3(5, 0.5f, 3), 0.5f, 0.5f);
        for (const float distance : {1e-3f, 0.01f, 0.1f, 0.3f}) {
            const auto at = [&](const glm::vec3& p, const glm::vec3& normal) {
                ReceiverImage receivers = repeated(offset + p, normal, 4, 4);
                receivers.eyeWorld = offset + glm::vec3(0, -3, 2);
                return scene.trace(receivers, light, nullptr, {});
            };
            expectAll(at({-distance, 0.5f, 0}, {0, 0, 1}), 0);     // behind the box
            expectAll(at({1 + distance, 0.5f, 0}, {0, 0, 1}), 1);  // before it
            expectAll(at({1, 0.5f, distance}, {1, 0, 0}), 1);      // on its lit side, close to the floor
            expectAll(at({0, 0.5f, distance}, {-1, 0, 0}), 0);     // on its dark side
            expectAll(at({distance, 0.5f, 1}, {0, 0, 1}), 1);      // on its top
        }
    }
}

TEST(Reference, ScalingByAPowerOfTwoChangesNoBit) {
    const AreaLight light = rectAt({0, 0, 2}, 1, 0.5f);
    const Soup soup = Soup().random(50, {-1, -1, 0.2f}, {1, 1, 1.5f}, 0.5f, 2);
    const ReferenceResult plain = soup.scene().trace(floorGrid(8, 0.2f), light, nullptr, {.samples = 64});
    for (const float scale : {1024.0f, 1.0f / 1024}) {
        Soup scaledSoup = soup;
        for (glm::vec3& position : scaledSoup.positions) position *= scale;
        ReceiverImage receivers = floorGrid(8, 0.2f);
        for (glm::vec3& posWorld : receivers.posWorld) posWorld *= scale;
        receivers.eyeWorld *= scale;
        const AreaLight scaledLight = rectAt({0, 0, 2 * scale}, scale, 0.5f * scale);
        const ReferenceResult scaled =
            scaledSoup.scene().trace(receivers, scaledLight, nullptr, {.samples = 64});
        EXPECT_EQ(plain.visibility.values, scaled.visibility.values) << scale;
    }
}

// --- Casters ---

TEST(Reference, CastersAreMovedAndMirroredByTheirTransform) {
    const Soup half = Soup().rect(0, 1, 0, 1, 0);
    TracedCaster caster = half.caster();
    caster.worldFromMesh = {{-8, 0, 0, 0}, {0, 10, 0, 0}, {0, 0, 0, 0}, {0, -5, 1, 1}};  // mirrored and flat
    const ReferenceScene scene({&caster, 1});
    const AreaLight light = lightAt(LightShape::sphere, {0, 0, 2});
    expectAll(scene.trace(repeated({-0.1f, 0, 0}), light, nullptr, {}), 0);
    expectAll(scene.trace(repeated({0.1f, 0, 0}), light, nullptr, {}), 1);
}

TEST(Reference, HolesOfAnAlphaMaskLetLightThrough) {
    const std::vector<std::uint8_t> pixels{9, 9, 9, 255, 9, 9, 9, 0};  // solid, hole
    const Soup half = Soup().rect(-1, 1, -1, 1, 1);
    std::vector<glm::vec2> uvs;
    for (const glm::vec3& p : half.positions) uvs.emplace_back((p.x + 1) / 2, (p.y + 1) / 2);
    TracedCaster caster = half.caster();
    caster.uvs = uvs;
    caster.alphaMask = TracedAlphaMask{.width_px = 2,
                                       .height_px = 1,
                                       .rgba = pixels,
                                       .wrapS = Wrap::clampToEdge,
                                       .wrapT = Wrap::clampToEdge};
    const AreaLight light = rectAt({0, 0, 2}, 1, 1);
    const ReferenceResult result =
        ReferenceScene({&caster, 1}).trace(repeated({0, 0, 0}), light, nullptr, {.samples = 1024});
    EXPECT_NEAR(meanOf(result), 0.5, 4 * result.noise_rms / 16);
    caster.alphaMask->factor = 0.4f;
    expectAll(ReferenceScene({&caster, 1}).trace(repeated({0, 0, 0}), light, nullptr, {}), 1);
    caster.alphaMask->cutoff = 0;
    expectAll(ReferenceScene({&caster, 1}).trace(repeated({0, 0, 0}), light, nullptr, {}), 0);
}

TEST(AlphaTexture, SamplesAsAGpuDoes) {
    const std::vector<std::uint8_t> pixels{0, 0, 0, 255, 0, 0, 0, 0,
                                           0, 0, 0, 0,   0, 0, 0, 0};  // solid, hole, hole, hole
    const auto blocks = [&](float u, Wrap wrap, bool linear, float cutoff = 0.5f) {
        return AlphaTexture({4, 1, pixels, wrap, wrap, linear, 1, cutoff}).blocks({u, 0.3f});
    };
    EXPECT_TRUE(blocks(0.24f, Wrap::repeat, false));
    EXPECT_FALSE(blocks(0.26f, Wrap::repeat, false));
    EXPECT_TRUE(blocks(-3.9f, Wrap::repeat, false));
    EXPECT_FALSE(blocks(-0.1f, Wrap::repeat, false));
    EXPECT_TRUE(blocks(-0.1f, Wrap::mirroredRepeat, false));
    EXPECT_TRUE(blocks(1.9f, Wrap::mirroredRepeat, false));
    EXPECT_TRUE(blocks(-9, Wrap::clampToEdge, false));
    EXPECT_FALSE(blocks(9, Wrap::clampToEdge, false));
    EXPECT_TRUE(blocks(0.125f, Wrap::repeat, true, 0.99f));  // a texel's centre
    EXPECT_TRUE(blocks(0.0f, Wrap::repeat, true, 0.49f));    // halfway to its neighbour across the edge
    EXPECT_FALSE(blocks(0.0f, Wrap::repeat, true, 0.51f));
    EXPECT_TRUE(blocks(0.0f, Wrap::clampToEdge, true, 0.99f));
    EXPECT_FALSE(blocks(nan, Wrap::repeat, true, 0.6f));
    EXPECT_THROW(AlphaTexture({.width_px = 5, .height_px = 1, .rgba = pixels}), InputError);
}

TEST(Reference, BadTrianglesBlockNothing) {
    Soup soup = Soup().rect(-1, 1, -1, 1, 1);
    for (glm::vec3& position : soup.positions) position.x = nan;
    soup.triangle({0, 0, 1}, {0, 0, 1}, {0, 0, 1}).triangle({-1, 0.1f, 1}, {0, 0.1f, 1}, {1, 0.1f, 1});
    expectAll(soup.scene().trace(floorGrid(8, 0.1f), rectAt({0, 0, 2}, 1, 1), nullptr, {}), 1);
}

TEST(Reference, RefusesWhatItCannotUse) {
    const std::vector<glm::vec3> positions(3);
    const auto sceneOf = [&](std::vector<std::uint32_t> indices) {
        const TracedCaster caster{.positions = positions, .indices = indices};
        return ReferenceScene({&caster, 1});
    };
    EXPECT_THROW(sceneOf({0, 1, 3}), InputError);
    EXPECT_THROW(sceneOf({0, 1}), InputError);
    ReceiverImage receivers = repeated({0, 0, 0});
    EXPECT_THROW(sceneOf({}).trace(receivers, rectAt({0, 0, 2}, 1, 1), nullptr, {.samples = 1}), UsageError);
    receivers.valid.pop_back();
    EXPECT_THROW(sceneOf({}).trace(receivers, rectAt({0, 0, 2}, 1, 1), nullptr, {}), InputError);
}

// --- Samples, seeds, threads ---

struct Noisy {
    Soup soup = Soup().random(80, {-1, -1, 0.2f}, {1, 1, 1.5f}, 0.5f, 2);
    ReferenceScene scene = soup.scene();
    ReceiverImage receivers = floorGrid(40, 0.05f);
    AreaLight light = rectAt({0, 0, 2}, 1, 0.5f);
    ReferenceResult trace(const ReferenceOptions& options) const {
        return scene.trace(receivers, light, nullptr, options);
    }
};

double rmsDifference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::pow(double(a.values[i]) - b.values[i], 2);
    return std::sqrt(sum / double(a.values.size()));
}

TEST(Reference, ThreadsChangeNoBit) {
    const Noisy noisy;
    const auto traceWith = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return noisy.trace({.samples = 50});
    };
    const ReferenceResult one = traceWith(1), two = traceWith(2);
    EXPECT_EQ(one.visibility.values, two.visibility.values);
    EXPECT_EQ(one.noise_rms, two.noise_rms);
    EXPECT_EQ(one.rays, two.rays);
}

TEST(Reference, SeedsDifferByTheNoiseThatIsStated) {
    const Noisy noisy;
    const ReferenceResult a = noisy.trace({.samples = 128, .seed = 1}),
                          b = noisy.trace({.samples = 128, .seed = 2});
    EXPECT_EQ(a.visibility.values, noisy.trace({.samples = 128, .seed = 1}).visibility.values);
    EXPECT_NEAR(rmsDifference(a.visibility, b.visibility), std::sqrt(2.0) * a.noise_rms, 0.1 * a.noise_rms);
}

TEST(Reference, NoiseFallsFasterThanWithRandomSamples) {
    const Noisy noisy;
    const ReferenceResult truth = noisy.trace({.samples = 16384, .seed = 99});
    // Least squares of log(error) over log(samples).
    double sx = 0, sy = 0, sxx = 0, sxy = 0, count = 0;
    for (int samples = 16; samples <= 1024; samples *= 4) {
        const ReferenceResult result = noisy.trace({.samples = samples});
        const double error = rmsDifference(result.visibility, truth.visibility);
        EXPECT_NEAR(error, result.noise_rms, 0.15 * error) << samples;
        const double x = std::log(samples), y = std::log(error);
        sx += x, sy += y, sxx += x * x, sxy += x * y, ++count;
    }
    EXPECT_LT((count * sxy - sx * sy) / (count * sxx - sx * sx), -0.6);
}

TEST(Reference, ProgressRisesToOneAndItsExceptionsGetThrough) {
    const Noisy noisy;
    std::vector<double> seen;
    noisy.trace({.samples = 4, .progress = [&](double fraction) { seen.push_back(fraction); }});
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_EQ(seen.size(), 9u);
    EXPECT_EQ(seen.back(), 1.0);
    EXPECT_THROW(noisy.trace({.samples = 4, .progress = [](double) { throw InputError("stop"); }}),
                 InputError);
}

}  // namespace
}  // namespace penumbra::studio
