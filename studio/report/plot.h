// SPDX-License-Identifier: Apache-2.0
// Plots as SVG: points of several series, with their spread, on linear or logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace penumbra::studio {

struct PlotPoint {
    double x = 0, y = 0;
    double low = 0, high = 0;  ///< spread of y; drawn where they differ
    std::string label = {};    ///< written beside the point; may be empty
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  ///< joined by a line, in this order
};

struct PlotAxis {
    std::string title;
    bool logarithmic = false;  ///< values that are not positive are then left out
};

struct Plot {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;     ///< colours go by their order; those without points are not shown
    bool joined = true;                 ///< false: points without lines
    std::vector<PlotPoint> front = {};  ///< drawn as a dashed line under the series
};

/// A whole SVG document that can stand in a page, too. Values that are not finite are left out.
std::string toSvg(const Plot& plot);

}  // namespace penumbra::studio
