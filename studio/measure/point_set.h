// SPDX-License-Identifier: Apache-2.0
// Where light is measured: points of a list, of a plane, or of a surface of the scene.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// A rectangle of equal cells, whose middles are measured: `columns` along `acrossWorld`, `rows` along
/// `alongWorld`, beginning at a corner.
struct GridFrame {
    glm::dvec3 cornerWorld{0};
    glm::dvec3 acrossWorld{1, 0, 0}, alongWorld{0, 0, 1};  ///< unit, at right angles
    glm::dvec3 normalWorld{0, 1, 0};                       ///< unit, the side that is measured
    double width_m = 0, depth_m = 0;
    int columns = 0, rows = 0;

    double cellWidth_m() const { return width_m / columns; }
    double cellDepth_m() const { return depth_m / rows; }
    glm::dvec3 cellMiddle(int column, int row) const;
};

struct MeasuringPoint {
    glm::dvec3 posWorld{0}, normalWorld{0, 1, 0};  ///< the normal is unit
    int column = 0, row = 0;                       ///< of the grid; of a list the row is the point's number
};

struct PointSet {
    std::vector<MeasuringPoint> points;  ///< row by row
    std::optional<GridFrame> grid;       ///< none: a list
    int rows = 0;
    std::size_t cellsBeside = 0;  ///< cells of a surface's grid under which the surface is not

    /// Leaves rows `first` to `last` (from 1), for who works on a part. Throws InputError "WHERE: ...".
    void keepRows(int first, int last, const std::string& where);
};

/// More than any plan has; so many, and what is said of them, fit into memory.
constexpr std::size_t mostPoints = std::size_t(1) << 20;

/// From where points are stated, the file's axes and origin in metres, to the world of the scene's moments.
glm::dmat4 worldFromStated(const Scene& scene);

/// A CSV file of x,y,z,nx,ny,nz in metres, a point a line, under a header line or none; lines that begin with
/// '#' are comments. Throws InputError with file and line.
PointSet readPoints(const std::filesystem::path& file, const Scene& scene);

/// A horizontal rectangle that looks up, in the file's axes and metres.
struct PlaneOption {
    glm::dvec3 corner{0};  ///< the one whose coordinates are least
    double width_m = 0;    ///< along X
    double depth_m = 0;    ///< along the other horizontal axis
};

/// Throws InputError "--plane: ..." for a plane without extent, or one that lies beside the scene, and
/// "--grid: ..." for more cells than `mostPoints`.
PointSet planeGrid(const PlaneOption& plane, int columns, int rows, const Scene& scene,
                   const SceneMoment& moment);

/// The surface of the nodes of that name, seen from the direction that most of its area faces (of two
/// opposite ones, that with more lights), in cells of the rectangle around it; points lie on its nearest
/// triangle, whose normal they have. Throws InputError with the nearest names.
PointSet surfaceGrid(const std::string& node, int columns, int rows, const Scene& scene,
                     const SceneMoment& moment);

/// A rectangle across `normalWorld` between two opposite corners of it, with rows and columns as a plan of a
/// floor or a wall has them; points lie in it. Throws InputError where it has no extent, and as planeGrid
/// does.
PointSet rectangleGrid(const glm::dvec3& fromWorld, const glm::dvec3& toWorld, const glm::dvec3& normalWorld,
                       int columns, int rows, const Scene& scene);

}  // namespace penumbra::studio
