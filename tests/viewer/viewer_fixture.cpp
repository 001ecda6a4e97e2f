// SPDX-License-Identifier: Apache-2.0
#include "tests/viewer/viewer_fixture.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "studio/image/atomic_file.h"
#include "tests/support/own_cache.h"

namespace penumbra::studio::viewer {
namespace {

/// A floor of 4 x 4 m and a sheet of 1 x 1 m in y = 0.8, without light or camera.
constexpr std::string_view sheetOverFloor =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, ")"
    R"(name": "floor"}, {"mesh": 1, "name": "sheet"}], "meshes": [{"primitives": [{"attributes": {"POSI)"
    R"(TION": 0}, "indices": 2}]}, {"primitives": [{"attributes": {"POSITION": 1}, "indices": 2}]}], "a)"
    R"(ccessors": [{"bufferView": 0, "byteOffset": 0, "componentType": 5126, "count": 4, "type": "VEC3")"
    R"(, "min": [-2, 0, -2], "max": [2, 0, 2]}, {"bufferView": 0, "byteOffset": 48, "componentType": 51)"
    R"(26, "count": 4, "type": "VEC3", "min": [-0.5, 0.800000011920929, -0.5], "max": [0.5, 0.800000011)"
    R"(920929, 0.5]}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}], "bufferV)"
    R"(iews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 12}], "bu)"
    R"(ffers": [{"byteLength": 108, "uri": "data:application/octet-stream;base64,AAAAwAAAAAAAAABAAAAAQA)"
    R"(AAAAAAAABAAAAAQAAAAAAAAADAAAAAwAAAAAAAAADAAAAAv83MTD8AAAA/AAAAP83MTD8AAAA/AAAAP83MTD8AAAC/AAAAv8)"
    R"(3MTD8AAAC/AAABAAIAAAACAAMA"}]})";

}  // namespace

Display& ViewerTest::display() {
    static Display instance(96, "1600x1800");
    return instance;
}

void ViewerTest::SetUp() {
    display().use();
    setOwnCache(at("cache"));
    setenv("XDG_CONFIG_HOME", at("config").c_str(), 1);
}

void ViewerTest::TearDown() {
    if (viewer_ && !driverMayComplain_) {
        EXPECT_EQ(session().device().severeMessageCount(), 0) << "see the log above";
    }
}

ViewerOptions ViewerTest::options(const std::string& scene) const {
    return {.scene = scene,
            .settings = at("viewer.json"),
            .data = at("data"),
            .pictures = folder_.path(),
            .late_ms = std::numeric_limits<double>::infinity(),  // nothing hangs on the machine's speed
            .refine_ms = 0};
}

std::string ViewerTest::writeScene(const std::string& name) const {
    writeFileAtomically(at(name), sheetOverFloor);
    return at(name);
}

void ViewerTest::start(const std::string& scene, const std::string& technique) {
    saveSettings({.width = 900,
                  .height = 1660,
                  .resolutionScale = 0.25f,
                  .referenceRuns = false,
                  .technique = technique,
                  .pictureWidth_px = -1,
                  .pictureHeight_px = -1},
                 at("viewer.json"));
    viewer_ = std::make_unique<Viewer>(options(scene));
    frames(1);
    Display::input(to(0.9, 0.95));  // over the picture, where digits choose techniques
    frames(2);
}

void ViewerTest::frames(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(viewer_->frame(false));
}

void ViewerTest::framesUntil(const std::function<bool()>& reached) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::minutes(10);
    while (!reached()) {
        ASSERT_LT(Clock::now(), end) << "waited in vain";
        ASSERT_TRUE(viewer_->frame(true));
    }
}

void ViewerTest::key(const std::string& keys) {
    Display::input("key --clearmodifiers " + keys);
    frames(2);
}

std::string ViewerTest::to(double x, double y) const {
    const CanvasPlace& place = viewer_->canvasPlace();
    return fmt::format("mousemove {} {}", int(place.min.x + x * place.size.x),
                       int(place.min.y + y * place.size.y));
}

void ViewerTest::click(const std::string& place, int button) {
    Display::input(place);
    frames(2);  // a widget must be seen under the mouse before it is clicked
    Display::input(fmt::format("mousedown {}", button));
    frames(2);
    Display::input(fmt::format("mouseup {}", button));
    frames(2);
}

void ViewerTest::drag(double x0, double y0, double x1, double y1, int button) {
    Display::input(to(x0, y0));
    frames(2);
    Display::input(fmt::format("mousedown {}", button));
    frames(1);
    for (const double t : {0.3, 0.7, 1.0}) {
        Display::input(to(x0 + t * (x1 - x0), y0 + t * (y1 - y0)));
        frames(1);
    }
    Display::input(fmt::format("mouseup {}", button));
    frames(2);
}

const PlacedWidget* ViewerTest::widget(const std::string& label) const {
    const auto& widgets = viewer_->widgets();
    const auto found = std::ranges::find(widgets, label, &PlacedWidget::label);
    return found == widgets.end() ? nullptr : &*found;
}

void ViewerTest::clickWidget(const std::string& label, double share) {
    const PlacedWidget* placed = widget(label);
    ASSERT_NE(placed, nullptr) << label;
    click(fmt::format("mousemove {} {}", int(placed->min.x + share * (placed->max.x - placed->min.x)),
                      int(0.5f * (placed->min.y + placed->max.y))));
}

void ViewerTest::retype(const std::string& text) {
    Display::input("key ctrl+a");
    frames(2);  // while Ctrl is down letters are none
    Display::input("type " + text);
    frames(3);
}

void ViewerTest::type(const std::string& label, const std::string& text) {
    clickWidget(label, 0.2);
    retype(text);
}

void ViewerTest::openHeader(const std::string& label) {
    clickWidget(label, 0.3);
}

Image ViewerTest::picture() {
    return readTexture(session().side(0).display.name(), session().width_px(), session().height_px(), 3);
}

Image ViewerTest::canvas() {
    const gl::Texture& texture = session().canvas().texture();
    return readTexture(texture.name(), texture.width_px(), texture.height_px(), 3);
}

int ViewerTest::run(const std::string& commandLine) const {
    const std::string line = "cd " + folder_.path().string() + " && " PENUMBRA_COMMAND +
                             commandLine.substr(std::string("penumbra").size()) + " 2>" + at("stderr");
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void ViewerTest::cheapen() {
    TechniqueBank& techniques = session().techniques();
    setParameter(techniques.get("uniform"), "samples", "9");
    setParameter(techniques.get("uniform"), "map_size", "128");
    setParameter(techniques.get("adaptive"), "max_samples", "25");
    setParameter(techniques.get("adaptive"), "map_size", "128");
}

bool samePixels(const Image& a, const Image& b) {
    return largestDifference(a, b) < 1e-6;
}

double largestDifference(const Image& a, const Image& b) {
    if (a.values.size() != b.values.size()) return 1e9;
    double largest = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        largest = std::max(largest, std::abs(double(a.values[i]) - b.values[i]));
    }
    return largest;
}

double shareOfDifferent(const Image& a, const Image& b, double tolerance) {
    if (a.values.size() != b.values.size()) return 1;
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        different += !(std::abs(double(a.values[i]) - b.values[i]) <= tolerance);
    }
    return double(different) / double(a.values.size());
}

}  // namespace penumbra::studio::viewer
