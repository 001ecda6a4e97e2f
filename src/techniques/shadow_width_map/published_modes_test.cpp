// SPDX-License-Identifier: Apache-2.0
// Kirsch and Doellner's equation, where everything in it is known: a straight edge 2 m above the ground.
#include <algorithm>
#include <cmath>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class PublishedShadowWidthTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{160, 120};
};

/// From straight above, 4 m across.
Scene straightEdge(LightShape shape = LightShape::rect, float zoom = 1) {
    return withMoment(withLight(onReceivingGround(makeBuiltin("half-plane")),
                                [=](Light& light) { light.shape.shape = shape; }),
                      [=](SceneMoment& moment) {
                          moment.cameras.erase(moment.cameras.begin());
                          *moment.cameras.front().orthographicHeight_m /= zoom;
                      });
}

/// How deep a column of that picture lies in the geometric shadow.
double depthInShadow_m(int column, int columns, float zoom = 1) {
    return (0.5 * columns - column - 0.5) * 4 / columns / zoom;
}

TEST_F(PublishedShadowWidthTest, AttenuationIsTheEquations) {
    const LightResult result =
        render("shadow-width", straightEdge(LightShape::distant), size,
               {{"mode", "cpu-sweep"}, {"physical", "false"}, {"c_scale", "3"}, {"c_bias", "0.5"}});
    const double sd_m = 2;
    for (int x = 0; x < size.width_px; ++x) {
        const double sw_m = depthInShadow_m(x, size.width_px);
        if (sw_m > 1.05) continue;  // wider than 256 texels
        const double expected = sw_m <= 0 ? 1 : std::clamp(1 + 0.5 - 3 * sw_m / sd_m, 0.0, 1.0);
        EXPECT_NEAR(result.visibility.at(x, size.height_px / 2, 0), expected, 0.01) << sw_m;
    }
}

/// What is wider than the starting difference can tell is umbra: the penumbra gets narrower and nothing else.
TEST_F(PublishedShadowWidthTest, UmbrasAreBlackAtEveryStartingDifferenceAndZoom) {
    for (const float zoom : {0.5f, 1.0f, 4.0f}) {
        double before = 0;  // light in the shadow
        for (const char* start : {"1/4", "1/16", "1/64", "1/256"}) {
            const LightResult result = render("shadow-width", straightEdge(LightShape::rect, zoom), size,
                                              {{"mode", "compositing"}, {"start_difference", start}});
            double light = 0;
            for (int x = 0; x < size.width_px; ++x) {
                const double sw_m = depthInShadow_m(x, size.width_px, zoom);
                const float seen = result.visibility.at(x, size.height_px / 2, 0);
                if (sw_m > 0.52) {
                    EXPECT_EQ(seen, 0) << zoom << " " << start << " " << sw_m;
                }
                if (sw_m > 0) light += seen;
            }
            EXPECT_GE(light, before) << zoom << " " << start;
            before = light;
        }
    }
}

/// At the receiver, 4 m from the light, a distance in the map is twice what it is on a plane at the blocker.
TEST_F(PublishedShadowWidthTest, WidthsAreMeasuredAtTheReceiverOrOnAPlaneBehindTheBlockers) {
    for (const auto& [place, factor] : {std::pair("receiver", 1.0), {"plane", 0.5}}) {
        const LightResult result =
            render("shadow-width", straightEdge(), size,
                   {{"mode", "cpu-sweep"}, {"physical", "false"}, {"c_scale", "2"}, {"widths_at", place}});
        for (int x = 0; x < size.width_px; ++x) {
            const double sw_m = depthInShadow_m(x, size.width_px);
            if (sw_m < 0.02 || sw_m > 0.98) continue;
            EXPECT_NEAR(result.visibility.at(x, size.height_px / 2, 0), 1 - factor * sw_m, 0.01) << place;
        }
    }
}

/// An open mesh has no back faces, or nothing else.
TEST_F(PublishedShadowWidthTest, OpenBlockersThatOnlyCastHaveShadowsWhicheverWayTheyFace) {
    for (const bool isTurned : {false, true}) {
        const Scene scene =
            withMoment(onReceivingGround(makeBuiltin("disk-over-ground")), [&](SceneMoment& moment) {
                moment.cameras.erase(moment.cameras.begin());
                for (Instance& instance : moment.instances) {
                    instance.receives = !instance.casts;
                    if (instance.casts && isTurned) instance.worldFromMesh[0] *= -1;
                }
            });
        for (const char* mode : {"exact", "compositing", "cpu-sweep"}) {
            for (const char* backFaces : {"true", "false"}) {
                const LightResult result =
                    render("shadow-width", scene, size, {{"mode", mode}, {"back_faces", backFaces}});
                EXPECT_LE(result.visibility.at(size.width_px / 2, size.height_px / 2, 0), 0.4)
                    << isTurned << mode << backFaces;
                EXPECT_EQ(result.visibility.at(2, 2, 0), 1) << isTurned << mode << backFaces;
            }
        }
    }
}

/// Of a closed one the farthest surfaces are nearer to the receiver, which makes harder edges (figure 6).
TEST_F(PublishedShadowWidthTest, BackFacesMakeHarderEdges) {
    const Scene scene = withMoment(onReceivingGround(makeBuiltin("sphere")), [&](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.receives = !instance.casts;
    });
    const auto inPenumbra = [&](const char* backFaces) {
        const LightResult result =
            render("shadow-width", scene, size, {{"mode", "compositing"}, {"back_faces", backFaces}});
        return std::ranges::count_if(result.visibility.values,
                                     [](float v) { return v > 0.05f && v < 0.95f; });
    };
    EXPECT_LT(double(inPenumbra("true")), 0.95 * double(inPenumbra("false")));
}

}  // namespace
}  // namespace penumbra::studio
