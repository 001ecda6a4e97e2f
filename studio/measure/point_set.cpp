// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/point_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "studio/errors.h"

namespace penumbra::studio {

glm::dvec3 GridFrame::cellMiddle(int column, int row) const {
    return cornerWorld + (column + 0.5) * cellWidth_m() * acrossWorld +
           (row + 0.5) * cellDepth_m() * alongWorld;
}

void PointSet::keepRows(int first, int last, const std::string& where) {
    if (first < 1 || last < first || last > rows) {
        throw InputError(
            fmt::format("{}: there are rows 1 to {}, and not {} to {}", where, rows, first, last));
    }
    std::erase_if(points,
                  [&](const MeasuringPoint& point) { return point.row < first - 1 || point.row >= last; });
    if (points.empty()) throw InputError(fmt::format("{}: in these rows there is no point", where));
}

glm::dmat4 worldFromStated(const Scene& scene) {
    const double unit_m = glm::length(glm::dvec3(scene.worldFromFile[0]));
    glm::dmat4 matrix = scene.worldFromFile;
    for (int axis = 0; axis < 3; ++axis) matrix[axis] /= unit_m;
    return matrix;
}

}  // namespace penumbra::studio
