// SPDX-License-Identifier: Apache-2.0
// Visibilities that can be computed by hand. The receiver lies on z = 0 and looks up, blockers at z = h, flat
// lights at z = H. A blocker's point b is seen from p in the light's plane at p + (b - p) H/h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studio/reference/reference.h"
#include "studio/reference/test_scenes.h"

namespace penumbra::studio {
namespace {

constexpr double pi = std::numbers::pi;

/// 256 estimates: their mean must be right within four standard errors (there are more than a hundred such
/// checks in this file, at three one of them would fail by chance), and they must scatter by what the trace
/// says of its own noise.
void expectVisibility(const Soup& blockers, const AreaLight& light, const glm::vec3& posWorld,
                      double expected, ReferenceOptions options = {.samples = 1024}) {
    const ReferenceResult result = blockers.scene().trace(repeated(posWorld), light, nullptr, options);
    double sum = 0, squares = 0;
    for (const float value : result.visibility.values) {
        sum += value - expected;
        squares += (value - expected) * (value - expected);
    }
    const double count = double(result.visibility.pixelCount());
    const double rounding = 2e-5;  // of ray origins, and of discs that are polygons
    EXPECT_NEAR(sum / count, 0, 4 * result.noise_rms / std::sqrt(count) + rounding)
        << "expected " << expected;
    EXPECT_LE(std::sqrt(squares / count), 1.5 * result.noise_rms + rounding);
    EXPECT_LE(result.noise_rms, 0.02);
}

/// Share of a disc that a half-plane leaves free, its edge at the signed distance d (in radii) from the
/// centre.
double freeOfDisc(double d) {
    d = std::clamp(d, -1.0, 1.0);
    return (std::acos(d) - d * std::sqrt(1 - d * d)) / pi;
}

/// Area common to two discs.
double lensArea(double R, double r, double c) {
    if (c >= R + r) return 0;
    if (c <= std::abs(R - r)) return pi * std::min(R, r) * std::min(R, r);
    return r * r * std::acos((c * c + r * r - R * R) / (2 * c * r)) +
           R * R * std::acos((c * c + R * R - r * r) / (2 * c * R)) -
           0.5 * std::sqrt((-c + r + R) * (c + r - R) * (c - r + R) * (c + r + R));
}

/// Solid angle common to two cones of half-angles A and B whose axes are g apart.
double commonSolidAngle(double A, double B, double g) {
    using std::cos, std::sin, std::acos;
    if (g >= A + B) return 0;
    if (g <= std::abs(A - B)) return 2 * pi * (1 - cos(std::min(A, B)));
    return 2 * (pi - acos((cos(g) - cos(A) * cos(B)) / (sin(A) * sin(B))) -
                cos(A) * acos((cos(B) - cos(g) * cos(A)) / (sin(g) * sin(A))) -
                cos(B) * acos((cos(A) - cos(g) * cos(B)) / (sin(g) * sin(B))));
}

TEST(ClosedForm, C1_HalfPlaneOverRect) {
    const double a = 0.75, h = 1, H = 3, k = (H - h) / h;
    const Soup blocker = Soup().rect(-far_m, 0, -far_m, far_m, float(h));
    for (const double x : {-0.5, -0.37, -0.2, 0.0, 0.1, 0.3, 0.374, 0.5}) {
        expectVisibility(blocker, rectAt({0, 0, float(H)}, float(2 * a), 0.4f), {float(x), 0, 0},
                         std::clamp((a + k * x) / (2 * a), 0.0, 1.0));
    }
}

TEST(ClosedForm, C2_HalfPlaneOverDisk) {
    const double R = 0.5, h = 1.5, H = 4, k = (H - h) / h;
    const Soup blocker = Soup().rect(-far_m, 0, -far_m, far_m, float(h));
    for (const double x : {-0.4, -0.25, -0.1, 0.0, 0.07, 0.2, 0.29, 0.4}) {
        expectVisibility(blocker, roundAt(LightShape::disk, {0, 0, float(H)}, float(R)), {float(x), 0, 0},
                         freeOfDisc(-k * x / R));
    }
}

TEST(ClosedForm, C3_StripOverDiskAndRect) {
    const double R = 0.6, h = 1, H = 2, x0 = -0.1, x1 = 0.15;
    const Soup strip = Soup().rect(float(x0), float(x1), -far_m, far_m, float(h));
    for (const double x : {-0.6, -0.3, -0.05, 0.0, 0.2, 0.5}) {
        // The strip's edges in the light's plane, where the light's centre is 0.
        const double e0 = x + (x0 - x) * H / h, e1 = x + (x1 - x) * H / h;
        expectVisibility(strip, roundAt(LightShape::disk, {0, 0, float(H)}, float(R)), {float(x), 0, 0},
                         1 - (freeOfDisc(e0 / R) - freeOfDisc(e1 / R)));
        const double hidden = std::max(0.0, std::min(e1, R) - std::max(e0, -R));
        expectVisibility(strip, rectAt({0, 0, float(H)}, float(2 * R), 1), {float(x), 0, 0},
                         1 - hidden / (2 * R));
    }
}

TEST(ClosedForm, C4_DiscOverDisk) {
    const double R = 0.5, h = 1, H = 2.5, m = H / h, k = (H - h) / h;
    for (const double b : {0.05, 0.18, 0.3}) {
        const Soup blocker = Soup().disc({0, 0, float(h)}, {0, 0, 1}, float(b));
        for (const double s : {0.0, 0.1, 0.25, 0.5, 0.9}) {
            expectVisibility(blocker, roundAt(LightShape::disk, {0, 0, float(H)}, float(R)), {float(s), 0, 0},
                             1 - lensArea(R, b * m, k * s) / (pi * R * R));
        }
    }
}

TEST(ClosedForm, C5_SphereOverSphere) {
    // From one receiver a sphere is the disc in which its tangent cone ends: at distance d, of radius d
    // tan(B).
    for (const double A : {0.05, 0.4}) {
        for (const double B : {0.03, 0.3}) {
            for (const double g : {0.0, 0.1, 0.25, 0.5}) {
                const double D = 3;
                const auto center = glm::vec3(0, 0, D);
                const auto axis = glm::vec3(std::sin(g), 0, std::cos(g));
                expectVisibility(Soup().disc(axis, -axis, float(std::tan(B))),
                                 roundAt(LightShape::sphere, center, float(D * std::sin(A))), {0, 0, 0},
                                 1 - commonSolidAngle(A, B, g) / (2 * pi * (1 - std::cos(A))));
            }
        }
    }
}

TEST(ClosedForm, C6_HalfPlaneOverSphere) {
    const Soup blocker = Soup().rect(-far_m, 0, -far_m, far_m, 1);
    for (const double A : {0.02, 0.3, 0.5}) {
        for (const double share : {-1.2, -0.8, -0.3, 0.0, 0.5, 0.9}) {
            const double e = share * A, D = 5;
            const auto center = glm::vec3(D * std::sin(e), 0, D * std::cos(e));
            expectVisibility(blocker, roundAt(LightShape::sphere, center, float(D * std::sin(A))), {0, 0, 0},
                             commonSolidAngle(A, pi / 2, pi / 2 - e) / (2 * pi * (1 - std::cos(A))));
        }
    }
}

TEST(ClosedForm, C6_HalfPlaneOverDistant) {
    const Soup blocker = Soup().rect(-far_m, 0, -far_m, far_m, 1);
    for (const double A : {0.02, 0.25}) {
        for (const double share : {-0.6, 0.0, 0.35}) {
            // A light that comes from (sin e, 0, cos e), its +Z.
            const double e = share * A;
            AreaLight light{.shape = LightShape::distant, .angle_rad = float(2 * A)};
            light.worldFromLight.columns[0] = {float(std::cos(e)), 0, float(-std::sin(e)), 0};
            light.worldFromLight.columns[2] = {float(std::sin(e)), 0, float(std::cos(e)), 0};
            expectVisibility(blocker, light, {0, 0, 0},
                             commonSolidAngle(A, pi / 2, pi / 2 - e) / (2 * pi * (1 - std::cos(A))));
        }
    }
}

TEST(ClosedForm, C7_WindowAndItsComplement) {
    const float x0 = -0.2f, x1 = 0.3f, y0 = -0.1f, y1 = 0.25f, h = 1, H = 2, a = 0.8f, b = 0.5f;
    const Soup screen = Soup()
                            .rect(-far_m, x0, -far_m, far_m, h)
                            .rect(x1, far_m, -far_m, far_m, h)
                            .rect(x0, x1, -far_m, y0, h)
                            .rect(x0, x1, y1, far_m, h);
    const Soup pane = Soup().rect(x0, x1, y0, y1, h);
    const auto overlap = [&](double p, double lo, double hi, double half) {
        const double from = p + (lo - p) * H / h, to = p + (hi - p) * H / h;
        return std::max(0.0, std::min(to, half) - std::max(from, -half));
    };
    for (const glm::vec2 p :
         {glm::vec2(0, 0), glm::vec2(0.3f, 0.1f), glm::vec2(-0.7f, 0.4f), glm::vec2(2, 0)}) {
        const double seen = overlap(p.x, x0, x1, a) * overlap(p.y, y0, y1, b) / (4.0 * a * b);
        expectVisibility(screen, rectAt({0, 0, H}, 2 * a, 2 * b), {p, 0}, seen);
        expectVisibility(pane, rectAt({0, 0, H}, 2 * a, 2 * b), {p, 0}, 1 - seen);
    }
}

TEST(ClosedForm, C8_IrradianceOfARect) {
    // 2 x 2 at z = 2, hidden up to x = 0.3: Lambert's formula for both polygons gives 0.33016, the area 0.35.
    const Soup blocker = Soup().rect(-far_m, 0.15f, -far_m, far_m, 1);
    const AreaLight light = rectAt({0, 0, 2}, 2, 2);
    expectVisibility(blocker, light, {0, 0, 0}, 0.35);
    ReferenceOptions options{.samples = 1024, .weight = ReferenceOptions::Weight::irradiance};
    const ReferenceResult result = blocker.scene().trace(repeated({0, 0, 0}), light, nullptr, options);
    double mean = 0;
    for (const float value : result.visibility.values) mean += value / 256.0;
    EXPECT_NEAR(mean, 0.33016, 4 * result.noise_rms / 16 + 2e-5);
}

TEST(ClosedForm, C8_IrradianceOfADistantLight) {
    // The sky's half above x = 0 of a hemisphere, weighted by the cosine: half. Of the quarter sphere around
    // (1, 0, 1) and a receiver that faces +x, only z > 0 counts and half-plane x < 0 hides nothing of it.
    AreaLight sky{.shape = LightShape::distant, .angle_rad = float(pi)};
    const ReferenceOptions options{.samples = 1024, .weight = ReferenceOptions::Weight::irradiance};
    expectVisibility(Soup().rect(-far_m, 0, -far_m, far_m, 0.03f), sky, {0, 0, 0}, 0.5, options);
    // A disc that hides all within 45 degrees of the zenith hides sin^2(45 deg) of the irradiance.
    expectVisibility(Soup().disc({0, 0, 1}, {0, 0, 1}, 1), sky, {0, 0, 0}, 0.5, options);
    expectVisibility(Soup().disc({0, 0, 1}, {0, 0, 1}, 1), sky, {0, 0, 0}, std::sqrt(0.5));
}

TEST(ClosedForm, C11_HalfPlanesOverATube) {
    // Across the tube: of a thin one, as of a rectangle.
    const double a = 0.75, h = 1, H = 3, k = (H - h) / h;
    const Soup across = Soup().rect(-far_m, 0, -far_m, far_m, float(h));
    for (const double x : {-0.5, -0.37, -0.2, 0.0, 0.1, 0.3, 0.374, 0.5}) {
        expectVisibility(across, tubeAt({0, 0, float(H)}, float(2 * a), 1e-4f), {float(x), 0, 0},
                         std::clamp((a + k * x) / (2 * a), 0.0, 1.0));
    }
    // Along a thick one: a line at the angle of the slope s of the way there looks longer by what it is
    // nearer than the plane through both outer lines.
    const double r = 1.1, outermost = std::asin(r / H), plane = H - r * r / H;
    const auto seenBeyond = [&](double slope) {
        constexpr int steps = 4000;
        const double most = std::tan(outermost);
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double s = slope + (most - slope) * (i + 0.5) / steps, angle = std::atan(s);
            const double near = H * std::cos(angle) - std::sqrt(r * r - std::pow(H * std::sin(angle), 2));
            sum += plane / std::cos(angle) / near * (most - slope) / steps;
        }
        return sum;
    };
    for (const double edge : {-0.3, -0.1, 0.0, 0.2, 0.35}) {
        const Soup along = Soup().rect(-far_m, far_m, -far_m, float(edge), float(h));
        expectVisibility(along, tubeAt({0, 0, float(H)}, 0.5f, float(r)), {0, 0, 0},
                         seenBeyond(edge / h) / seenBeyond(-std::tan(outermost)));
    }
}

/// Of a tube's end at the distance d over a surface that faces its axis, l long from there on: what of a
/// hemisphere's irradiance it gives (D. C. Hamilton, W. R. Morgan, Radiant-interchange configuration factors,
/// NACA TN 2836, 1952).
double tubeFactor(double l, double r, double d) {
    const double D = d / r, L = l / r, A = (D + 1) * (D + 1) + L * L, B = (D - 1) * (D - 1) + L * L;
    return std::atan(L / std::sqrt(D * D - 1)) / (pi * D) +
           L / pi *
               ((A - 2 * D) / (D * std::sqrt(A * B)) * std::atan(std::sqrt(A * (D - 1) / (B * (D + 1)))) -
                std::atan(std::sqrt((D - 1) / (D + 1))) / D);
}

TEST(ClosedForm, C12_IrradianceOfATube) {
    // Nothing of it is seen beyond x = 0.
    const Soup blocker = Soup().rect(0, far_m, -far_m, far_m, 0.05f);
    const ReferenceOptions options{.samples = 1024, .weight = ReferenceOptions::Weight::irradiance};
    for (const auto& [r, d] : {std::pair{0.013, 1.0}, {0.2, 0.8}, {0.5, 0.8}}) {
        const double seen = tubeFactor(0.9, r, d), hidden = tubeFactor(0.3, r, d);
        expectVisibility(blocker, tubeAt({-0.3f, 0, float(d)}, 1.2f, float(r)), {0, 0, 0},
                         seen / (seen + hidden), options);
    }
}

TEST(ClosedForm, C13_TubesAreDarkAtTheirEndsAndWithin) {
    const AreaLight tube = tubeAt({0, 0, 1}, 2, 0.3f);
    const auto seen = [&](const glm::vec3& posWorld, const glm::vec3& normalWorld) {
        return Soup()
            .scene()
            .trace(repeated(posWorld, normalWorld, 1, 1), tube, nullptr, {})
            .visibility.values[0];
    };
    EXPECT_EQ(seen({3, 0, 1.2f}, {-1, 0, 0}), 0) << "before an end";
    EXPECT_EQ(seen({0, 0, 1.1f}, {0, 0, 1}), 0) << "within";
    EXPECT_EQ(seen({3, 0, 1.4f}, {-1, 0, 0}), 1) << "beside an end";
}

TEST(ClosedForm, C10_StripsAddUp) {
    const AreaLight light = rectAt({0, 0, 2}, 1, 1);
    Soup strips;
    for (const float x : {-0.2f, -0.05f, 0.1f}) strips.rect(x, x + 0.06f, -far_m, far_m, 1);
    expectVisibility(strips, light, {0, 0, 0}, 1 - 3 * 0.12);
    expectVisibility(Soup().rect(-far_m, far_m, -far_m, far_m, 1), light, {0, 0, 0}, 0);
}

/// Blockers that let a share of the light pass, one after the other.
struct Panes {
    struct Pane {
        Soup blocker;
        glm::vec3 passes;
    };
    std::vector<Pane> panes;

    /// Mean visibility of 256 estimates, and what it may be off by.
    void expect(const AreaLight& light, const glm::vec3& posWorld, const glm::vec3& expected) const {
        std::vector<TracedCaster> casters;
        for (const Pane& pane : panes) {
            casters.push_back(pane.blocker.caster());
            casters.back().transmittance = pane.passes;
        }
        const ReferenceResult result =
            ReferenceScene(casters).trace(repeated(posWorld), light, nullptr, {.samples = 1024});
        ASSERT_EQ(result.visibility.channels, 3);
        glm::dvec3 sum(0);
        for (int y = 0; y < result.visibility.height_px; ++y) {
            for (int x = 0; x < result.visibility.width_px; ++x) {
                for (int c = 0; c < 3; ++c) sum[c] += double(result.visibility.at(x, y, c));
            }
        }
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c] / double(result.visibility.pixelCount()), expected[c], 1e-3);
    }
};

TEST(ClosedForm, PanesTakeTheirShare) {
    const AreaLight light = rectAt({0, 0, 3}, 1, 1);
    const glm::vec3 s{0.5f, 0.8f, 0}, t{0.25f, 1, 0.75f}, one(1);
    const Soup half = Soup().rect(-far_m, 0, -far_m, far_m, 1),
               other = Soup().rect(-far_m, far_m, -far_m, 0, 2);
    Panes{{{half, s}}}.expect(light, {0, 0, 0}, 0.5f * (one + s));
    // Two that cross leave a quarter to each, to both, and to neither, in either order.
    for (const bool isTurned : {false, true}) {
        Panes crossing{{{half, s}, {other, t}}};
        if (isTurned) std::ranges::reverse(crossing.panes);
        crossing.expect(light, {0, 0, 0}, 0.25f * (one + s + t + s * t));
    }
    // A slab has two faces and is one pane; of two slabs light passes both.
    const Soup slab = Soup().box({-far_m, -far_m, 1}, {0, far_m, 1.1f}),
               above = Soup().box({-far_m, -far_m, 2}, {0, far_m, 2.1f});
    Panes{{{slab, s}}}.expect(light, {-0.05f, 0, 0}, s + (one - s) * 0.4f);
    Panes{{{slab, s}, {above, t}}}.expect(light, {-2, 0, 0}, s * t);
    // Nothing passes what is opaque, before or behind.
    const Soup opaque = Soup().rect(-far_m, far_m, -far_m, 0, 0.5f);
    Panes{{{half, s}, {opaque, glm::vec3(0)}}}.expect(light, {0, 0, 0}, 0.25f * (one + s));
}

}  // namespace
}  // namespace penumbra::studio
