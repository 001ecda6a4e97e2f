// SPDX-License-Identifier: Apache-2.0
// Where is measured: lists, planes, surfaces, and what lies inside of bodies.
#include "studio/measure/point_set.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "studio/errors.h"
#include "studio/measure/closed_bodies.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

/// A table of 2 x 0.04 x 1 m at 0.7 m on a ground, and a ball of 0.5 m beside it.
Scene tableAndBall() {
    SceneBuilder scene("table");
    scene.ground(10);
    scene.place("desk", scene.mesh("desk", box({2, 0.04f, 1}), glm::vec3(0.5f)), at({0, 0.72f, 0}));
    scene.place("ball", scene.mesh("ball", sphere(0.5f, 32, 16), glm::vec3(0.5f)), at({3, 0.5f, 0}));
    scene.light(rectLight("key", 1, 1, {0, 3, 0}, {0, 0, 0}, 500));
    return std::move(scene).build();
}

std::string messageOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing was thrown";
}

class PointFile : public ::testing::Test {
  protected:
    ~PointFile() override { fs::remove(file_); }
    PointSet read(const std::string& text) const {
        std::ofstream(file_, std::ios::binary) << text;
        return readPoints(file_, tableAndBall());
    }
    std::string messageFor(const std::string& text) const {
        return messageOf([&] { read(text); });
    }
    fs::path file_ = fs::temp_directory_path() / ("penumbra-points-" + std::to_string(getpid()) + ".csv");
};

TEST_F(PointFile, HasAPointALine) {
    for (const char* text :
         {"1,2,3,0,2,0\n4,5,6,0,0,-1\n", "x,y,z,nx,ny,nz\n1,2,3,0,2,0\n4,5,6,0,0,-1",
          "\xEF\xBB\xBFx, y, z, nx, ny, nz\r\n# two\r\n\r\n 1, 2,3 ,0,2,0\r\n4,5,6,0,0,-1\r\n"}) {
        const PointSet set = read(text);
        ASSERT_EQ(set.points.size(), 2u) << text;
        EXPECT_EQ(set.points[0].posWorld, glm::dvec3(1, 2, 3));
        EXPECT_EQ(set.points[0].normalWorld, glm::dvec3(0, 1, 0));
        EXPECT_EQ(set.points[1].normalWorld, glm::dvec3(0, 0, -1));
        EXPECT_EQ(set.rows, 2);
    }
}

TEST_F(PointFile, TellsLineAndFault) {
    EXPECT_NE(messageFor("1,2,3,0,1,0\n1,2,3\n").find(".csv:2: 3 columns"), std::string::npos);
    EXPECT_NE(messageFor("1,2,3,0,1,0,7\n").find("7 columns"), std::string::npos);
    EXPECT_NE(messageFor("1,2,nan,0,1,0\n").find("z is not finite"), std::string::npos);
    EXPECT_NE(messageFor("1,2,1e999,0,1,0\n").find("no number for z"), std::string::npos);
    EXPECT_NE(messageFor("# list\n1,two,3,0,1,0\n").find(".csv:2: 'two' is no number for y"),
              std::string::npos);
    EXPECT_NE(messageFor("1,2,3,0,0,0\n").find("normal has no length"), std::string::npos);
    EXPECT_NE(messageFor("").find("no point"), std::string::npos);
    EXPECT_NE(messageFor("x,y,z,nx,ny,nz\n").find("no point"), std::string::npos);
    EXPECT_NE(messageFor(std::string("1,2\0,3", 6)).find("is no text"), std::string::npos);
    EXPECT_NE(messageFor(std::string(1 << 20, '1')).find("does not end"), std::string::npos);
    EXPECT_NE(messageOf([] { readPoints("/nowhere.csv", tableAndBall()); }).find("cannot be read"),
              std::string::npos);
    EXPECT_NE(messageOf([] { readPoints("/tmp", tableAndBall()); }).find("folder"), std::string::npos);
}

TEST(PlaneGrid, HasItsPointsInTheMiddlesOfCells) {
    const Scene scene = tableAndBall();
    const PointSet set =
        planeGrid({.corner = {-1, 0.8, -2}, .width_m = 2, .depth_m = 4}, 4, 2, scene, scene.at(0));
    ASSERT_EQ(set.points.size(), 8u);
    EXPECT_EQ(set.points[0].posWorld, glm::dvec3(-0.75, 0.8, -1));
    EXPECT_EQ(set.points[5].posWorld, glm::dvec3(-0.25, 0.8, 1));
    EXPECT_EQ(set.points[5].normalWorld, glm::dvec3(0, 1, 0));
}

TEST(PlaneGrid, TellsWhatCannotBe) {
    const Scene scene = tableAndBall();
    const SceneMoment moment = scene.at(0);
    const auto messageFor = [&](const PlaneOption& plane, int columns, int rows) {
        return messageOf([&] { planeGrid(plane, columns, rows, scene, moment); });
    };
    EXPECT_NE(messageFor({{0, 1, 0}, 0, 2}, 3, 3).find("no extent"), std::string::npos);
    EXPECT_NE(messageFor({{0, 1, 0}, 2, -2}, 3, 3).find("no extent"), std::string::npos);
    EXPECT_NE(messageFor({{0, 1, 0}, 1, 1}, 100000, 10000).find("at most"), std::string::npos);
    EXPECT_NE(messageFor({{0, 1, 0}, 1, 1}, 0, 5).find("at most"), std::string::npos);
    EXPECT_NE(messageFor({{100, 1, 0}, 1, 1}, 3, 3).find("beside the scene"), std::string::npos);
    EXPECT_NE(messageFor({{0, 100, 0}, 1, 1}, 3, 3).find("beside the scene"), std::string::npos);
}

TEST(PlaneGrid, CanBeHandedOutByRows) {
    const Scene scene = tableAndBall();
    PointSet set = planeGrid({{-1, 0.8, -2}, 2, 4}, 4, 6, scene, scene.at(0));
    EXPECT_NE(messageOf([&] { set.keepRows(0, 2, "--rows"); }).find("rows 1 to 6"), std::string::npos);
    EXPECT_NE(messageOf([&] { set.keepRows(5, 7, "--rows"); }).find("rows 1 to 6"), std::string::npos);
    set.keepRows(2, 3, "--rows");
    ASSERT_EQ(set.points.size(), 8u);
    EXPECT_EQ(set.points.front().row, 1);
    EXPECT_EQ(set.points.back().row, 2);
}

TEST(SurfaceGrid, LiesOnTheSideThatHasTheLights) {
    const Scene scene = tableAndBall();
    const PointSet set = surfaceGrid("desk", 4, 2, scene, scene.at(0));
    ASSERT_EQ(set.points.size(), 8u);
    EXPECT_EQ(set.cellsBeside, 0u);
    for (const MeasuringPoint& point : set.points) {
        EXPECT_NEAR(point.posWorld.y, 0.74, 1e-6);
        EXPECT_NEAR(point.normalWorld.y, 1, 1e-9);
    }
    EXPECT_NEAR(set.points[0].posWorld.x, -0.75, 1e-6);
    EXPECT_NEAR(set.points[0].posWorld.z, -0.25, 1e-6);
}

TEST(SurfaceGrid, TakesPatternsOfNames) {
    const Scene scene = tableAndBall();
    const PointSet named = surfaceGrid("desk", 4, 2, scene, scene.at(0)),
                   fitting = surfaceGrid("de?k*", 4, 2, scene, scene.at(0));
    ASSERT_EQ(fitting.points.size(), named.points.size());
    EXPECT_EQ(fitting.points[0].posWorld, named.points[0].posWorld);
}

TEST(SurfaceGrid, FollowsRoundThingsAndTellsWhatLiesBeside) {
    const Scene scene = tableAndBall();
    const PointSet set = surfaceGrid("ball", 20, 20, scene, scene.at(0));
    EXPECT_GT(set.points.size(), 280u);
    EXPECT_EQ(set.points.size() + set.cellsBeside, 400u);
    for (const MeasuringPoint& point : set.points)
        EXPECT_NEAR(glm::distance(point.posWorld, glm::dvec3(3, 0.5, 0)), 0.5, 0.02);
}

TEST(SurfaceGrid, TellsTheNearestName) {
    const Scene scene = tableAndBall();
    const auto messageFor = [&](const char* name) {
        return messageOf([&] { surfaceGrid(name, 4, 4, scene, scene.at(0)); });
    };
    EXPECT_NE(messageFor("desc").find("did you mean 'desk'"), std::string::npos);
    EXPECT_NE(messageFor("wardrobe").find("--nodes"), std::string::npos);
}

TEST(ClosedBodiesTest, KnowWhatIsInside) {
    const Scene scene = tableAndBall();
    const SceneMoment moment = scene.at(0);
    const auto bodyAround = [&](const glm::dvec3& place, const glm::dvec3& normal = {0, 1, 0}) {
        const std::vector<MeasuringPoint> points = {{.posWorld = place, .normalWorld = normal}};
        const ClosedBodies bodies(scene, moment, points);
        const std::string* body = bodies.around(points[0]);
        return body == nullptr ? std::string() : *body;
    };
    EXPECT_EQ(bodyAround({0, 0.72, 0}), "desk");
    EXPECT_EQ(bodyAround({0, 0.8, 0}), "");
    EXPECT_EQ(bodyAround({0, 0.1, 0}), "");
    // On its top it is outside, on its underside too, each as its normal looks.
    EXPECT_EQ(bodyAround({0, 0.74, 0}), "");
    EXPECT_EQ(bodyAround({0, 0.7, 0}), "desk");
    EXPECT_EQ(bodyAround({0, 0.7, 0}, {0, -1, 0}), "");
    // Through corners and edges of the ball's triangles, too.
    EXPECT_EQ(bodyAround({3, 0.5, 0}), "ball");
    EXPECT_EQ(bodyAround({3, 0.05, 0}), "ball");
    EXPECT_EQ(bodyAround({3.4, 0.5, 0}), "ball");
    EXPECT_EQ(bodyAround({3.4, 0.9, 0}), "");
}

TEST(ClosedBodiesTest, LeaveOutRoomsAndOpenThings) {
    SceneBuilder builder("room");
    builder.place("room", builder.mesh("room", room({4, 3, 4}), glm::vec3(0.5f)), at({0, 1.5f, 0}));
    builder.place("tube", builder.mesh("tube", cylinder(0.3f, 1, 24, Ends::open), glm::vec3(0.5f)),
                  at({1, 0.5f, 1}));
    builder.light(rectLight("key", 1, 1, {0, 2.9f, 0}, {0, 0, 0}, 500));
    const Scene scene = std::move(builder).build();
    const std::vector<MeasuringPoint> points = {{{0, 1, 0}}, {{1, 0.5, 1}}};
    const ClosedBodies bodies(scene, scene.at(0), points);
    EXPECT_EQ(bodies.around(points[0]), nullptr);
    EXPECT_EQ(bodies.around(points[1]), nullptr);
}

}  // namespace
}  // namespace penumbra::studio
