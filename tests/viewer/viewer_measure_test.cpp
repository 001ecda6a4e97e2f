// SPDX-License-Identifier: Apache-2.0
// A grid laid over a surface by hand, measured while lights move, and taken away.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "studio/image/image_io.h"
#include "studio/measure/plan_of.h"
#include "studio/scene/builtin/placing.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

/// A disk of 1,000 nits with a radius of 0.5 m, 2 m over the middle of a floor, that nothing shades.
Light lamp() {
    Light disk = diskLight("disk", 0.5f, {0, 2, 0}, {0, 0, 0}, 1);
    disk.emission = {Emission::Unit::nits, glm::vec3(1000)};
    return disk;
}

class MeasureTest : public ViewerTest {
  protected:
    /// Looks down at a floor, and drags a grid over it.
    void lay() {
        session().editLights({lamp()});
        session().freeCamera().lookFrom({.eye = {0, 5, 4}, .target = {0, 0, 0}, .fov_deg = 80});
        session().changedView();
        frames();
        key("m");
        ASSERT_TRUE(viewer().windowState().placesGrid);
        const glm::vec2 from = pixelOf({-1, 0, 1}), to = pixelOf({1, 0, -0.5f});
        drag(from.x, from.y, to.x, to.y);
        ASSERT_TRUE(session().choices().grid);
        ASSERT_NE(measured(), nullptr) << session().grid().problem();
    }
    /// In shares of the canvas.
    glm::vec2 pixelOf(const glm::vec3& posWorld) const {
        const CanvasPlace& place = viewer_->canvasPlace();
        const glm::vec2 size(place.size.x, place.size.y);
        return *Projection(viewer_->session().cameraView(), size).pixelOf(posWorld) / size;
    }
    const Measurement* measured() { return session().grid().measurement(); }
    std::string textOf(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(at(name)).rdbuf();
        return text.str();
    }
};

TEST_F(MeasureTest, AGridIsDraggedOverASurfaceAndMeasured) {
    start(writeScene("box.gltf"));
    ASSERT_NO_FATAL_FAILURE(lay());
    const GridFrame& frame = *measured()->set.grid;
    EXPECT_NEAR(frame.width_m, 2, 0.06);
    EXPECT_NEAR(frame.depth_m, 1.5, 0.06);
    EXPECT_EQ(frame.normalWorld, glm::dvec3(0, 1, 0));
    EXPECT_EQ(frame.columns, 20);
    EXPECT_NEAR(frame.rows, 15, 1);
    // The sheet at 0.8 m shades some of it; none has more than what stands before nothing: a disk over its
    // foot, E = pi L r^2 / (r^2 + h^2).
    const Summary lux = luxSummary(*measured());
    EXPECT_LT(lux.max, std::acos(-1.0) * 1000 * 0.25 / 4.25 * 1.005);
    EXPECT_LT(lux.min, 0.2 * lux.max) << "under the sheet";

    // Live: while the lamp is dragged, values are those of where it is.
    const std::vector<MeasuredValue> before = measured()->values;
    std::vector<Light> lights = {lamp()};
    lights[0].castsShadow = false;
    session().editLights(lights);
    session().setHandsMove(true);
    session().update(session().width_px(), session().height_px());
    EXPECT_TRUE(session().grid().isRough());
    EXPECT_GT(luxSummary(*measured()).min, 10 * lux.min);
    frames();
    EXPECT_FALSE(session().grid().isRough()) << "and at rest with all samples";
    for (std::size_t i = 0; i < measured()->values.size(); ++i) {
        const MeasuringPoint& point = measured()->set.points[i];
        if (glm::length(glm::dvec2(point.posWorld.x, point.posWorld.z)) > 0.09) continue;
        EXPECT_NEAR(measured()->values[i].lux, std::acos(-1.0) * 1000 * 0.25 / 4.25, 1);
    }

    key("ctrl+z");  // the lamp, by test
    frames();
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(measured()->values[i].lux, before[i].lux);
    key("ctrl+z");
    EXPECT_FALSE(session().choices().grid) << "the grid is a step, too";
    EXPECT_EQ(measured(), nullptr);
    key("ctrl+shift+z");
    ASSERT_TRUE(session().choices().grid);
    frames();
    ASSERT_NE(measured(), nullptr);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(measured()->values[i].lux, before[i].lux);

    type("above the surface (m)", "0.5");
    key("Return");
    frames();
    EXPECT_NEAR(measured()->set.points[0].posWorld.y, 0.5, 0.01);
    clickWidget("Remove");
    EXPECT_EQ(measured(), nullptr);
}

TEST_F(MeasureTest, ValuesAndLinesLieOnTheSurface) {
    start(writeScene("box.gltf"));
    ASSERT_NO_FATAL_FAILURE(lay());
    Display::input(to(0.99, 0.99));
    frames();
    const Image with = viewer().screenshot();
    const Work work = session().work();
    session().choices().grid.reset();
    frames();
    const Image without = viewer().screenshot();
    const CanvasPlace& place = viewer().canvasPlace();
    const auto differsAt = [&](const glm::vec3& posWorld) {
        const glm::vec2 share = pixelOf(posWorld);
        const int x = int(place.min.x + share.x * place.size.x),
                  y = int(place.min.y + share.y * place.size.y);
        float most = 0;
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(with.at(x, y, c) - without.at(x, y, c)));
        return most > 0.05f;
    };
    int on = 0;
    for (const float x : {-0.9f, -0.7f, 0.7f, 0.9f}) on += differsAt({x, 0, 0.2f});
    EXPECT_GE(on, 3);
    EXPECT_FALSE(differsAt({-1.2f, 0, 0.2f}));
    EXPECT_FALSE(differsAt({1.2f, 0, 0.2f}));
    session().restore(work);
}

TEST_F(MeasureTest, WhatIsMeasuredIsSavedAsTheCommandWouldSaveIt) {
    start(writeScene("box.gltf"));
    ASSERT_NO_FATAL_FAILURE(lay());
    for (const char* name : {"grid.csv", "grid.svg", "grid.png"}) {
        clickWidget("Save as table or plan ...");
        retype(at(name));
        key("Return");
        ASSERT_TRUE(std::filesystem::exists(at(name))) << viewer().windowState().message;
    }
    const std::string csv = textOf("grid.csv");
    EXPECT_TRUE(csv.starts_with("x,y,z,nx,ny,nz,lux,bound,inside\n")) << csv.substr(0, 80);
    EXPECT_EQ(std::ranges::count(csv, '\n'), std::ptrdiff_t(measured()->set.points.size()) + 1);
    EXPECT_NE(textOf("grid.svg").find("<svg"), std::string::npos);
    EXPECT_GT(readPng(at("grid.png")).image.width_px, 500);

    // The command measures the same at the same points.
    std::ofstream points(at("points.csv"));
    std::istringstream lines(csv);
    std::vector<double> lux;
    for (std::string line; std::getline(lines, line);) {
        std::size_t comma = 0;
        for (int i = 0; i < 6; ++i) comma = line.find(',', comma) + 1;
        points << line.substr(0, comma - 1) << "\n";
        if (!line.starts_with("x")) lux.push_back(std::stod(line.substr(comma)));
    }
    points.close();
    key("ctrl+s");
    ASSERT_EQ(run("penumbra measure box.gltf --points points.csv --csv again.csv >measured.txt"), 0)
        << textOf("stderr");
    std::istringstream again(textOf("again.csv"));
    std::string line;
    std::getline(again, line);
    for (const double here : lux) {
        ASSERT_TRUE(std::getline(again, line));
        std::size_t comma = 0;
        for (int i = 0; i < 6; ++i) comma = line.find(',', comma) + 1;
        EXPECT_NEAR(std::stod(line.substr(comma)), here, 1e-4 * (1 + here));
    }

    clickWidget("Save as table or plan ...");
    retype(at("grid.doc"));
    key("Return");
    EXPECT_TRUE(viewer().windowState().messageIsError);
    EXPECT_FALSE(std::filesystem::exists(at("grid.doc")));
}

TEST_F(MeasureTest, TheSunsHoursLieOverTheFloor) {
    start(writeScene("box.gltf"));
    ASSERT_NO_FATAL_FAILURE(lay());
    clickWidget("hours of sun over a day", 0.05);
    frames();
    EXPECT_EQ(measured(), nullptr);
    EXPECT_NE(session().grid().problem().find("need a sun"), std::string::npos) << session().grid().problem();
    std::vector<Light> lights = {distantLight("sun", 0.01f, {0, -1, 0.2f}, 1000)};
    session().editLights(lights);
    frames();
    clickWidget("the sun of a place and time", 0.05);
    frames();
    ASSERT_NE(measured(), nullptr) << session().grid().problem();
    ASSERT_EQ(measured()->sunHours.size(), measured()->set.points.size());
    // Ten hours of Berlin's longest day, less what the sheet takes of them.
    EXPECT_NEAR(std::ranges::max(measured()->sunHours), 10, 0.01);
    EXPECT_LT(std::ranges::min(measured()->sunHours), 9);
    const ValueGrid shown = gridOf(*measured());
    EXPECT_EQ(shown.at(0, 0), double(measured()->sunHours[0]));
}

TEST_F(MeasureTest, AClickLaysNoGrid) {
    start(writeScene("box.gltf"));
    key("m");
    click(to(0.5, 0.6));
    EXPECT_FALSE(session().choices().grid);
    EXPECT_FALSE(viewer().windowState().placesGrid);
}

}  // namespace
}  // namespace penumbra::studio::viewer
