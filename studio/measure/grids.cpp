// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "studio/errors.h"
#include "studio/measure/instance_triangles.h"
#include "studio/measure/point_set.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/wildcard.h"

namespace penumbra::studio {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void requireCells(int columns, int rows) {
    if (columns >= 1 && rows >= 1 && std::size_t(columns) * std::size_t(rows) <= mostPoints) return;
    throw InputError(fmt::format("--grid: {}x{} points; at most {} fit: measure it in several pieces",
                                 columns, rows, mostPoints));
}

/// In a frame's own axes: across, along, up.
struct Extent {
    glm::dvec3 low{infinity}, high{-infinity};
    void include(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// Rows are the axes.
glm::dmat3 axesOf(const GridFrame& frame) {
    return glm::transpose(glm::dmat3(frame.acrossWorld, frame.alongWorld, frame.normalWorld));
}

void requireInScene(const GridFrame& frame, const Scene& scene, const SceneMoment& moment) {
    Extent plane, bounds;
    for (const double u : {0.0, frame.width_m}) {
        for (const double v : {0.0, frame.depth_m})
            plane.include(frame.cornerWorld + u * frame.acrossWorld + v * frame.alongWorld);
    }
    const bool isInScene = !moment.bounds.empty() &&
                           glm::all(glm::lessThanEqual(plane.low, glm::dvec3(moment.bounds.max))) &&
                           glm::all(glm::greaterThanEqual(plane.high, glm::dvec3(moment.bounds.min)));
    if (isInScene) return;
    if (moment.bounds.empty()) throw InputError("--plane: the scene is empty");
    const glm::dmat4 statedFromWorld = glm::inverse(worldFromStated(scene));
    for (const glm::vec3& corner : {moment.bounds.min, moment.bounds.max})
        bounds.include(glm::dvec3(statedFromWorld * glm::dvec4(corner, 1)));
    throw InputError(fmt::format(
        "--plane: it lies beside the scene, which reaches from {:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}",
        bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z));
}

using Triangle = std::array<glm::dvec3, 3>;

/// Of all nodes of the name, or pattern (`*`, `?`). Throws InputError with the names that are near.
std::vector<Triangle> trianglesOf(const std::string& node, const Scene& scene, const SceneMoment& moment) {
    std::vector<Triangle> triangles;
    std::set<std::string_view> names;
    for (const Instance& instance : moment.instances) {
        const std::string& name = scene.nodeNames[std::size_t(instance.node)];
        names.insert(name);
        if (!matchesWildcard(name, node)) continue;
        forEachTriangle(scene, instance, [&](const Triangle& triangle) { triangles.push_back(triangle); });
    }
    if (!triangles.empty()) return triangles;
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string hint = didYouMean(node, known);
    throw InputError(fmt::format("--surface: no node with a mesh is named '{}'{}", node,
                                 hint.empty() ? "; 'penumbra info SCENE --nodes' lists them" : hint));
}

glm::dvec3 doubleArea(const Triangle& triangle) {
    return glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

/// How many lights stand before a plane, less those behind it.
int lightsBefore(const glm::dvec3& place, const glm::dvec3& normal, const std::vector<Light>& lights) {
    int before = 0;
    for (const Light& light : lights) {
        const auto& matrix = light.shape.worldFromLight.columns;
        const std::size_t column = light.shape.shape == LightShape::distant ? 2 : 3;
        const glm::dvec3 vector(matrix[column][0], matrix[column][1], matrix[column][2]);
        const glm::dvec3 towards = column == 2 ? vector : vector - place;
        before += glm::dot(normal, towards) > 0 ? 1 : -1;
    }
    return before;
}

/// The direction that the most area faces, either way: opposite sides count together. Of the two that one
/// before which more lights stand; where they are alike, the upper.
glm::dvec3 mainDirection(const std::vector<Triangle>& triangles, const std::vector<Light>& lights) {
    constexpr double alike = 0.99;
    struct Side {
        glm::dvec3 direction;
        double area;
    };
    constexpr std::size_t mostSides = 64;  // of what is rounder, the largest facets are as good
    std::vector<Side> sides;
    glm::dvec3 middle(0);
    double sum = 0;
    for (const Triangle& triangle : triangles) {
        const glm::dvec3 across = doubleArea(triangle);
        const double area = glm::length(across);
        if (!(area > 0)) continue;
        middle += area * (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        sum += area;
        const glm::dvec3 direction = across / area;
        const auto same = std::ranges::find_if(
            sides, [&](const Side& side) { return std::abs(glm::dot(side.direction, direction)) > alike; });
        if (same != sides.end())
            same->area += area;
        else if (sides.size() < mostSides)
            sides.push_back({direction, area});
    }
    if (sides.empty()) throw InputError("--surface: it has no extent");
    const glm::dvec3 direction = std::ranges::max_element(sides, {}, &Side::area)->direction;
    const int before = lightsBefore(middle / sum, direction, lights);
    return before < 0 || (before == 0 && direction.y < 0) ? -direction : direction;
}

/// The file's axis that is not up beside X: along a plan.
glm::dvec3 planAlong(const glm::dmat4& worldFromStated) {
    return glm::abs(worldFromStated[1].y) > glm::abs(worldFromStated[2].y) ? worldFromStated[2]
                                                                           : worldFromStated[1];
}

/// All cells' middles, in the frame's plane.
PointSet middlesOf(const GridFrame& frame) {
    PointSet set{.grid = frame, .rows = frame.rows};
    set.points.reserve(std::size_t(frame.columns) * std::size_t(frame.rows));
    for (int row = 0; row < frame.rows; ++row) {
        for (int column = 0; column < frame.columns; ++column)
            set.points.push_back({frame.cellMiddle(column, row), frame.normalWorld, column, row});
    }
    return set;
}

/// Of a floor, as on a plan; of a wall rows go up.
GridFrame frameFacing(const glm::dvec3& normal, const glm::dmat3& statedAxes, const glm::dvec3& alongPlan) {
    GridFrame frame{.normalWorld = normal};
    constexpr double steep = 0.7;
    if (std::abs(normal.y) > steep) {
        frame.acrossWorld = glm::normalize(statedAxes[0] - glm::dot(statedAxes[0], normal) * normal);
        frame.alongWorld = glm::cross(frame.acrossWorld, normal);
        if (glm::dot(frame.alongWorld, alongPlan) < 0) frame.alongWorld = -frame.alongWorld;
    } else {
        frame.acrossWorld = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), normal));
        frame.alongWorld = glm::cross(normal, frame.acrossWorld);
    }
    return frame;
}

/// What of a surface is nearest to who looks at its grid.
struct Facet {
    double height = -infinity;
    glm::dvec3 normal{0};
};

/// Visits the cells whose middles a triangle covers.
void cover(const Triangle& triangle, const GridFrame& frame, std::vector<Facet>& facets) {
    const glm::dmat3 axes = axesOf(frame);
    std::array<glm::dvec3, 3> p;
    Extent extent;
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = axes * (triangle[i] - frame.cornerWorld);
        extent.include(p[i]);
    }
    const double doubled = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    const double size = (frame.width_m + frame.depth_m) * (frame.width_m + frame.depth_m);
    if (std::abs(doubled) <= 1e-12 * size) return;  // seen from its edge
    const auto firstOf = [](double low, double cell) {
        return std::max(int(std::ceil(low / cell - 0.5)), 0);
    };
    const auto lastOf = [](double high, double cell, int count) {
        return std::min(int(std::floor(high / cell - 0.5)), count - 1);
    };
    glm::dvec3 normal = glm::normalize(doubleArea(triangle));
    if (glm::dot(normal, frame.normalWorld) < 0) normal = -normal;
    const double width = frame.cellWidth_m(), depth = frame.cellDepth_m();
    for (int row = firstOf(extent.low.y, depth); row <= lastOf(extent.high.y, depth, frame.rows); ++row) {
        for (int column = firstOf(extent.low.x, width); column <= lastOf(extent.high.x, width, frame.columns);
             ++column) {
            const double x = (column + 0.5) * width - p[0].x, y = (row + 0.5) * depth - p[0].y;
            const double s = (x * (p[2].y - p[0].y) - y * (p[2].x - p[0].x)) / doubled;
            const double t = (y * (p[1].x - p[0].x) - x * (p[1].y - p[0].y)) / doubled;
            constexpr double rounding = 1e-9;
            if (s < -rounding || t < -rounding || s + t > 1 + rounding) continue;
            const double height = p[0].z + s * (p[1].z - p[0].z) + t * (p[2].z - p[0].z);
            Facet& facet = facets[std::size_t(row) * std::size_t(frame.columns) + std::size_t(column)];
            if (height > facet.height) facet = {height, normal};
        }
    }
}

}  // namespace

PointSet planeGrid(const PlaneOption& plane, int columns, int rows, const Scene& scene,
                   const SceneMoment& moment) {
    if (!(plane.width_m > 0) || !(plane.depth_m > 0)) {
        throw InputError(fmt::format("--plane: {:g} x {:g} m is no extent: width and depth must be above 0",
                                     plane.width_m, plane.depth_m));
    }
    requireCells(columns, rows);
    const glm::dmat4 world = worldFromStated(scene);
    GridFrame frame{.cornerWorld = glm::dvec3(world * glm::dvec4(plane.corner, 1)),
                    .acrossWorld = glm::dvec3(world[0]),
                    .alongWorld = planAlong(world),
                    .width_m = plane.width_m,
                    .depth_m = plane.depth_m,
                    .columns = columns,
                    .rows = rows};
    requireInScene(frame, scene, moment);
    return middlesOf(frame);
}

PointSet rectangleGrid(const glm::dvec3& fromWorld, const glm::dvec3& toWorld, const glm::dvec3& normalWorld,
                       int columns, int rows, const Scene& scene) {
    requireCells(columns, rows);
    const glm::dmat4 world = worldFromStated(scene);
    GridFrame frame = frameFacing(glm::normalize(normalWorld), glm::dmat3(world), planAlong(world));
    const glm::dvec3 from = axesOf(frame) * fromWorld, to = axesOf(frame) * toWorld;
    const glm::dvec3 low = glm::min(from, to), high = glm::max(from, to);
    frame.cornerWorld = glm::transpose(axesOf(frame)) * glm::dvec3(low.x, low.y, from.z);
    frame.width_m = high.x - low.x;
    frame.depth_m = high.y - low.y;
    frame.columns = columns;
    frame.rows = rows;
    if (!(frame.width_m > 0) || !(frame.depth_m > 0))
        throw InputError(fmt::format("the grid of {:g} x {:g} m has no extent: draw it from corner to corner",
                                     frame.width_m, frame.depth_m));
    return middlesOf(frame);
}

PointSet surfaceGrid(const std::string& node, int columns, int rows, const Scene& scene,
                     const SceneMoment& moment) {
    requireCells(columns, rows);
    const std::vector<Triangle> triangles = trianglesOf(node, scene, moment);
    const glm::dmat4 world = worldFromStated(scene);
    GridFrame frame =
        frameFacing(mainDirection(triangles, moment.lights), glm::dmat3(world), planAlong(world));
    Extent extent;
    for (const Triangle& triangle : triangles) {
        for (const glm::dvec3& corner : triangle) extent.include(axesOf(frame) * corner);
    }
    // Its plane is that of the surface's nearest point.
    frame.cornerWorld = glm::transpose(axesOf(frame)) * glm::dvec3(extent.low.x, extent.low.y, extent.high.z);
    frame.width_m = extent.high.x - extent.low.x;
    frame.depth_m = extent.high.y - extent.low.y;
    frame.columns = columns;
    frame.rows = rows;
    if (!(frame.width_m > 0) || !(frame.depth_m > 0))
        throw InputError(fmt::format("--surface: '{}' has no extent", node));

    std::vector<Facet> facets(std::size_t(columns) * std::size_t(rows));
    for (const Triangle& triangle : triangles) cover(triangle, frame, facets);
    PointSet set{.grid = frame, .rows = rows};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Facet& facet = facets[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
            if (facet.height == -infinity) {
                ++set.cellsBeside;
                continue;
            }
            set.points.push_back({frame.cellMiddle(column, row) + facet.height * frame.normalWorld,
                                  facet.normal, column, row});
        }
    }
    if (set.points.empty())
        throw InputError(fmt::format("--surface: no cell's middle lies on '{}': take a finer grid", node));
    return set;
}

}  // namespace penumbra::studio
