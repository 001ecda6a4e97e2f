// SPDX-License-Identifier: Apache-2.0
// A viewer on a display of its own, worked by mouse and keyboard.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "studio/image/test_folder.h"
#include "studio/viewer/viewer.h"
#include "tests/viewer/display.h"

namespace penumbra::studio::viewer {

class ViewerTest : public ::testing::Test {
  protected:
    static Display& display();

    void SetUp() override;
    void TearDown() override;

    /// A window so high that the panel shows all its widgets, `technique` at a quarter of the resolution, the
    /// truth switched off.
    void start(const std::string& scene, const std::string& technique = "hard");
    Viewer& viewer() { return *viewer_; }
    Session& session() { return viewer_->session(); }

    void frames(int count = 3);
    /// Until it is so; fails the test after 30 s.
    void framesUntil(const std::function<bool()>& reached);

    void key(const std::string& keys);
    /// To a place on the canvas, in shares of its size from the upper left.
    std::string to(double x, double y) const;
    void click(const std::string& place, int button = 1);
    /// Presses, moves in steps with frames between, and releases.
    void drag(double x0, double y0, double x1, double y1, int button = 1);
    /// Clicks the middle of a widget that the last frame has drawn; `share` moves the point along its width.
    void clickWidget(const std::string& label, double share = 0.5);
    /// In place of what the field says that is typed into.
    void retype(const std::string& text);
    /// Clicks into a number or a text and types, without Enter.
    void type(const std::string& label, const std::string& text);
    const PlacedWidget* widget(const std::string& label) const;
    /// Opens the headers that are closed at first.
    void openHeader(const std::string& label);

    /// Side A as shown, and the canvas.
    Image picture();
    Image canvas();
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    /// A glTF file of a floor and a sheet over it; returns its path.
    std::string writeScene(const std::string& name) const;
    ViewerOptions options(const std::string& scene) const;

    /// Runs the command, whose name the line begins with, in the test's folder; its exit code.
    int run(const std::string& commandLine) const;

    /// Few and small maps, where a test is not about how good they are.
    void cheapen();

    TestFolder folder_;
    bool driverMayComplain_ = false;  ///< the test gives it reason to
    std::unique_ptr<Viewer> viewer_;
};

/// Whether two pictures of eight bits a channel have the same pixels; dividing by 255 may round in two ways.
bool samePixels(const Image& a, const Image& b);
double largestDifference(const Image& a, const Image& b);
double shareOfDifferent(const Image& a, const Image& b, double tolerance = 0.004);

}  // namespace penumbra::studio::viewer
