// SPDX-License-Identifier: Apache-2.0
// What is installed serves those who find it, by every route, from a prefix that nothing else is in; and the
// examples, which are such users, show what they should.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "studio/image/image_io.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

/// One prefix for all tests of the program.
class Installed : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = fs::temp_directory_path() / ("penumbra-install-" + std::to_string(::getpid()));
        fs::create_directories(folder);
        for (const char* component : {"library", "development"}) {
            run("cmake --install " PENUMBRA_BUILD " --prefix " + prefix() + " --component " + component);
        }
    }
    static void TearDownTestSuite() { fs::remove_all(folder); }

    static std::string at(const std::string& name) { return (folder / name).string(); }
    static std::string prefix() { return at("prefix"); }
    static std::string source(const std::string& name) { return PENUMBRA_SOURCE_DIRECTORY "/" + name; }
    static std::string library() {
        for (const auto& entry : fs::recursive_directory_iterator(prefix())) {
            if (entry.path().filename() == "libpenumbra.so") return entry.path().parent_path();
        }
        return {};
    }

    /// Fails the test, with what the command has said, unless it succeeds.
    static bool run(const std::string& command) {
        const bool done = std::system((command + " >" + at("log") + " 2>&1").c_str()) == 0;
        std::ostringstream log;
        if (!done) log << std::ifstream(at("log")).rdbuf();
        EXPECT_TRUE(done) << command << "\n" << log.str();
        return done;
    }
    static bool buildProject(const std::string& project, const std::string& name,
                             const std::string& more = {}) {
        return run("cmake -S " + project + " -B " + at(name) + " -DCMAKE_PREFIX_PATH=" + prefix() +
                   " -DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror' " + more) &&
               run("cmake --build " + at(name));
    }

    static inline fs::path folder;
};

/// A square lamp over a box over the ground: the box's top sees all of it, the ground before the box most of
/// it, and in the middle of the shadow there is none.
void expectMinimalPicture(const std::string& path) {
    const Image picture = readPng(path).image;
    ASSERT_EQ(picture.width_px, 640);
    const auto values = [&](float low, float high) {
        return std::ranges::count_if(picture.values, [=](float v) { return v >= low && v <= high; });
    };
    const auto all = std::ptrdiff_t(picture.values.size());
    EXPECT_GT(values(0.99f, 1), all / 2) << "lit";
    EXPECT_GT(values(0, 0.05f), all / 500) << "umbra";
    EXPECT_GT(values(0.1f, 0.9f), all / 100) << "penumbra";
}

TEST_F(Installed, IsFoundByCMake) {
    ASSERT_TRUE(buildProject(source("examples/minimal"), "shared"));
    ASSERT_TRUE(run(at("shared/minimal") + " " + at("shared.png")));
    expectMinimalPicture(at("shared.png"));
}

TEST_F(Installed, IsFoundByCMakeAsStaticLibrary) {
    ASSERT_TRUE(buildProject(source("tests/consumer"), "static",
                             "-DMINIMAL_SOURCE=" + source("examples/minimal/minimal.cpp")));
    ASSERT_TRUE(run(at("static/minimal") + " " + at("static.png")));
    expectMinimalPicture(at("static.png"));
    EXPECT_NE(std::system(("ldd " + at("static/minimal") + " | grep -q libpenumbra").c_str()), 0);
}

TEST_F(Installed, IsFoundByPkgConfig) {
    const std::string packages =
        "PKG_CONFIG_PATH=" + library() + "/pkgconfig pkg-config --cflags --libs penumbra ";
    ASSERT_TRUE(run("c++ -std=c++20 " + source("examples/minimal/minimal.cpp") + " -o " +
                    at("by-pkg-config") + " $(" + packages + "epoxy libpng) -Wl,-rpath," + library()));
    ASSERT_TRUE(run(at("by-pkg-config") + " " + at("pkg-config.png")));
    expectMinimalPicture(at("pkg-config.png"));
}

TEST_F(Installed, ShowsItsInterfaceAndNothingElse) {
    // Any other name could clash with a host's. (Weak ones are the standard library's templates.)
    const std::string symbols = "nm -DC --defined-only " + library() + "/libpenumbra.so | grep -E ' [TDBR] '";
    EXPECT_NE(std::system((symbols + " | grep -qv penumbra::").c_str()), 0);
    EXPECT_NE(std::system((symbols + " | grep -q 'penumbra::gl::'").c_str()), 0);
    EXPECT_EQ(std::system((symbols + " | grep -q 'penumbra::makeTechnique'").c_str()), 0);
}

bool hasProgram(const std::string& name) {
    return std::system(("which " + name + " >/dev/null 2>&1").c_str()) == 0;
}

TEST_F(Installed, ServesAHostWithAWindow) {
    if (!hasProgram("xvfb-run")) GTEST_SKIP() << "xvfb-run is missing";
    ASSERT_TRUE(buildProject(source("examples/glfw_host"), "glfw"));
    const auto picture = [&](const std::string& name, const std::string& flags) {
        EXPECT_TRUE(run("xvfb-run -a " + at("glfw/glfw_host") + " --screenshot " + at(name) + " " + flags));
        return readPng(at(name)).image;
    };
    const Image first = picture("one.png", "--frames 1 --technique pcss");
    const Image third = picture("three.png", "--frames 3 --technique pcss");
    const Image other = picture("other.png", "--frames 3 --technique soft-volumes");
    ASSERT_EQ(first.values.size(), third.values.size());
    const auto differing = [](const Image& a, const Image& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i) count += std::abs(a.values[i] - b.values[i]) > 0.1f;
        return double(count) / double(a.values.size());
    };
    EXPECT_GT(differing(first, third), 0.001) << "ring, camera and lamp move";
    // Two methods that have nothing in common but the answer: were the host's state not as it left it, or its
    // deformed ring not the one that casts, they would part by more than penumbrae.
    EXPECT_LT(differing(third, other), 0.02);
    const auto dark = std::ranges::count_if(third.values, [](float v) { return v < 0.3f; });
    EXPECT_GT(dark, std::ptrdiff_t(third.values.size()) / 50) << "a shadow";
}

/// Asked of CMake where it looks itself.
bool hasPackage(const std::string& package) {
    const std::string probe =
        "printf 'cmake_minimum_required(VERSION 3.25)\nproject(probe LANGUAGES C CXX)\n"
        "find_package(" +
        package + " REQUIRED)\n' >$d/CMakeLists.txt && cmake -S $d -B $d/build";
    return std::system(
               ("d=$(mktemp -d) && { (" + probe + ") >/dev/null 2>&1; s=$?; rm -r $d; exit $s; }").c_str()) ==
           0;
}

/// What is left where the lamp is hidden, by the share of other lights in a host's scene, and how much of the
/// picture that is.
struct Umbra {
    float atMost;    ///< of the unshadowed picture
    float penumbra;  ///< more than this is one
    double share;    ///< of all pixels, at least
};

/// Somebody else's renderer, with and without shadows: they darken, and change nothing else.
void expectShadows(const Image& plain, const Image& shadowed, const Umbra& umbra) {
    ASSERT_EQ(plain.values.size(), shadowed.values.size());
    std::size_t same = 0, darker = 0, between = 0;
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
        const float ratio = shadowed.values[i] / std::max(plain.values[i], 1.0f / 255);
        same += ratio > 0.985f;
        darker += ratio < umbra.atMost;
        between += ratio > umbra.penumbra && ratio < 0.9f;
        EXPECT_LE(shadowed.values[i], plain.values[i] + 1.5f / 255) << "light where there was none";
    }
    const double all = double(plain.values.size());
    EXPECT_GT(double(same) / all, 0.5) << "what sees the lamp is as the host drew it";
    EXPECT_GT(double(darker) / all, umbra.share) << "umbra";
    EXPECT_GT(double(between) / all, 0.01) << "penumbra";
}

struct Host {
    const char* name;
    const char* example;
    const char* package;  ///< of CMake's; where it is missing there is nothing to test
    const char* debian;
    Umbra umbra;
    const char* options = "";      ///< of CMake's, for the example
    const char* arguments = "";    ///< of the example's
    const char* environment = "";  ///< of the example's
    const char* program = "sh";    ///< that building it needs, of the same Debian packages
};
class Hosts : public Installed, public ::testing::WithParamInterface<Host> {};
// What is least lit follows from each example's scene and its `leastLit`, in the colours of the picture.
const std::vector<Host> hosts = {
    {"vtk",
     "vtk_client",
     "VTK 9 COMPONENTS CommonCore",
     "libvtk9-dev",
     {0.2f, 0.25f, 0.01},
     "",
     "--samples 0"},
    {"vtk_multisampled", "vtk_client", "VTK 9 COMPONENTS CommonCore", "libvtk9-dev", {0.2f, 0.25f, 0.01}},
    {"qt5", "qt_host", "Qt5 COMPONENTS Widgets", "qtbase5-dev", {0.27f, 0.3f, 0.005}, "-DWHICH_QT=Qt5"},
    {"qt6",
     "qt_host",
     "Qt6 COMPONENTS OpenGLWidgets",
     "qt6-base-dev",
     {0.27f, 0.3f, 0.005},
     "-DWHICH_QT=Qt6"},
    {"osg",
     "osg_host",
     "OpenSceneGraph 3.6 COMPONENTS osgViewer",
     "libopenscenegraph-dev",
     {0.27f, 0.3f, 0.005}},
    {"osg_multisampled",
     "osg_host",
     "OpenSceneGraph 3.6 COMPONENTS osgViewer",
     "libopenscenegraph-dev",
     {0.27f, 0.3f, 0.005},
     "",
     "",
     "OSG_MULTI_SAMPLES=4"},
    {"coin", "coin_host", "Coin 4", "libcoin-dev", {0.27f, 0.3f, 0.01}},
    {"occt",
     "occt_host",
     "OpenCASCADE",
     "libocct-visualization-dev, libocct-data-exchange-dev",
     {0.32f, 0.35f, 0.01}},
    {"ogre", "ogre_host", "OGRE 1.12", "libogre-1.12-dev", {0.27f, 0.3f, 0.01}},
    {"filament",
     "filament_host",
     "filament 1.9",
     "libfilament-dev, libfilament-tools",
     {0.42f, 0.45f, 0.005},
     "",
     "",
     "",
     "matc"}};
INSTANTIATE_TEST_SUITE_P(Examples, Hosts, ::testing::ValuesIn(hosts),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Hosts, AreServed) {
    const Host& host = GetParam();
    const std::string place = *host.options == '\0' ? host.example : host.name;
    if (!hasProgram("xvfb-run")) GTEST_SKIP() << "xvfb-run is missing";
    if (!hasPackage(host.package) || !hasProgram(host.program)) GTEST_SKIP() << host.debian << " is missing";
    ASSERT_TRUE(buildProject(source(std::string("examples/") + host.example), place, host.options));
    const auto picture = [&](const std::string& file, const std::string& flags) {
        EXPECT_TRUE(run(std::string(host.environment) + " xvfb-run -a -s '-screen 0 1280x1024x24' " +
                        at(place + "/" + host.example) + " --screenshot " + at(file) + " " + host.arguments +
                        " " + flags));
        return readPng(at(file)).image;
    };
    expectShadows(picture("plain.png", "--no-shadows"), picture("shadowed.png", "--technique exact"),
                  host.umbra);
}

/// At the Earth's radius from the world's origin, where floats come in steps of half a metre.
TEST_F(Installed, AHostOnEarthLooksAsAtTheOrigin) {
    if (!hasProgram("xvfb-run")) GTEST_SKIP() << "xvfb-run is missing";
    if (!hasPackage("OpenSceneGraph 3.6 COMPONENTS osgViewer"))
        GTEST_SKIP() << "libopenscenegraph-dev is missing";
    ASSERT_TRUE(buildProject(source("examples/osg_host"), "osg_host"));
    const auto picture = [&](const std::string& name, const std::string& flags) {
        EXPECT_TRUE(run("xvfb-run -a -s '-screen 0 1280x1024x24' " + at("osg_host/osg_host") +
                        " --screenshot " + at(name) + flags));
        return readPng(at(name)).image.values;
    };
    const std::vector<float> atOrigin = picture("at-origin.png", ""),
                             onEarth = picture("on-earth.png", " --on-earth");
    ASSERT_EQ(onEarth.size(), atOrigin.size());
    double difference = 0;
    for (std::size_t i = 0; i < atOrigin.size(); ++i)
        difference += std::abs(onEarth[i] - atOrigin[i]) / double(atOrigin.size());
    RecordProperty("difference", std::to_string(difference));
    EXPECT_LT(difference, 0.002);
}

}  // namespace
}  // namespace penumbra::studio
