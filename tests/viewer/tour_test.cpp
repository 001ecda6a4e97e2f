// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/viewer.md, made anew and checked to show what they are about. They are kept where
// PENUMBRA_TOUR says: PENUMBRA_TOUR=docs/pictures build/tour_test
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "studio/image/image_io.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

class Tour : public ViewerTest {
  protected:
    static bool keeps() { return std::getenv("PENUMBRA_TOUR") != nullptr; }
    /// What is kept shall look good; what is only checked shall be quick.
    static float scaleOf(float kept) { return keeps() ? kept : 0.15f; }

    void begin(const std::string& scene, const std::string& technique, bool traces = false) {
        saveSettings({.width = 1200,
                      .height = 760,
                      .resolutionScale = scaleOf(0.5f),
                      .referenceSamples = 64,
                      .referenceRuns = traces,
                      .technique = technique},
                     at("viewer.json"));
        viewer_ = std::make_unique<Viewer>(options(scene));
        if (!keeps()) cheapen();  // what is kept shows the defaults
        Display::input(to(0.97, 0.97));
        frames(3);
    }
    void awaitTruth() {
        framesUntil([&] { return session().truth() && session().truth()->samples == 64; });
        frames(2);
    }
    /// Wheels the panel down, so that its lower part is seen.
    void scrollPanel(int notches) {
        Display::input("mousemove 150 500 click --repeat " + std::to_string(notches) + " 5");
        frames(4);
    }
    void keep(const std::string& name) {
        frames(2);
        const Image window = viewer().screenshot();
        // Neither blank nor noise: a good share of colours, and panels.
        EXPECT_GT(std::ranges::max(window.values), 0.8f);
        EXPECT_GT(shareOfDifferent(window, Image(window.width_px, window.height_px, 3, window.values[0])),
                  0.3);
        if (keeps())
            writePng(std::filesystem::path(std::getenv("PENUMBRA_TOUR")) / ("viewer-" + name + ".png"),
                     window);
    }
};

TEST_F(Tour, Start) {
    saveSettings({.width = 1200, .height = 760, .resolutionScale = scaleOf(1), .referenceRuns = false},
                 at("viewer.json"));
    viewer_ = std::make_unique<Viewer>(options(""));
    frames(3);
    keep("start");
}

TEST_F(Tour, Wipe) {
    begin("torus", "pcss", true);
    key("c");
    awaitTruth();
    EXPECT_TRUE(session().metrics(0));
    keep("wipe");
}

TEST_F(Tour, Difference) {
    begin("torus", "pcss", true);
    key("x");
    awaitTruth();
    keep("difference");
}

TEST_F(Tour, Visibility) {
    begin("primitives", "exact");
    key("v");
    keep("visibility");
}

TEST_F(Tour, Illuminance) {
    begin("many-lights", "soft-volumes");
    key("i");
    click(to(0.5, 0.7));
    framesUntil([&] { return !session().picker().busy(); });
    keep("illuminance");
}

TEST_F(Tour, Lights) {
    begin("two-boxes", "exact");
    session().editLights(
        {rectLight("panel", 1.4f, 0.8f, {-0.9f, 2.2f, 0.9f}, {0, 0.2f, 0}, 900, {1, 0.9f, 0.75f}),
         sphereLight("bulb", 0.15f, {1.5f, 1.3f, 0.4f}, {0, 0, 0}, 300, {0.6f, 0.75f, 1})});
    session().freeCamera().frame({{-2, 0, -1.4f}, {2, 2.4f, 1.4f}}, 1.3f);
    session().changedView();
    keep("lights");
}

TEST_F(Tour, Pick) {
    begin("primitives", "exact", true);
    // In the penumbra of the ball on the drum: about half of the light is seen.
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities[0]);
    int x = visibility.width_px - 1, y = visibility.height_px * 2 / 3;
    while (x > 0 && std::abs(visibility.at(x, y) - 0.5f) > 0.1f) --x;
    click(to((x + 0.5) / visibility.width_px, (y + 0.5) / visibility.height_px));
    framesUntil([&] { return !session().picker().busy(); });
    scrollPanel(40);
    keep("pick");
}

TEST_F(Tour, Buffers) {
    begin("two-boxes", "smoothies");
    scrollPanel(40);
    openHeader("Times");
    scrollPanel(40);
    openHeader("Buffers");
    const auto buffers = session().inspected();
    viewer().windowState().buffer = buffers.size() - 1;
    scrollPanel(40);
    keep("buffers");
}

TEST_F(Tour, Measure) {
    begin("two-boxes", "exact");
    session().editLights(
        {rectLight("panel", 1.4f, 0.8f, {-0.9f, 2.2f, 0.9f}, {0, 0.2f, 0}, 900, {1, 0.9f, 0.75f})});
    session().freeCamera().lookFrom({.eye = {1.5f, 3.6f, 5}, .target = {0, 0.2f, 0.2f}, .fov_deg = 38});
    session().changedView();
    frames();
    session().choices().grid = GridSpec{.fromWorld = {-1.8, 0, 1.6},
                                        .toWorld = {1.8, 0, -0.4},
                                        .normalWorld = {0, 1, 0},
                                        .columns = 18,
                                        .rows = 10};
    frames(3);
    EXPECT_NE(session().grid().measurement(), nullptr) << session().grid().problem();
    scrollPanel(12);
    keep("measure");
}

TEST_F(Tour, Help) {
    begin("columns", "exact");
    key("h");
    EXPECT_TRUE(viewer().windowState().showsHelp);
    keep("help");
}

}  // namespace
}  // namespace penumbra::studio::viewer
