// SPDX-License-Identifier: Apache-2.0
// What a paper shows, as data: situations, what is drawn of them, the paper's own numbers, and what the
// numbers ought to say. One file a paper fills these in; reproduction.h turns them into measurements.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "studio/image/image.h"
#include "studio/report/plot.h"

namespace penumbra::studio {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Where a model has neither camera nor light of its own that would do: in its units.
struct Placement {
    glm::vec3 eye, target;         ///< the camera, and what it looks at
    glm::vec3 light, lightTarget;  ///< a square light, and where it shines
    float lightSize_m = 1;
    bool operator==(const Placement&) const = default;
};

/// A scene and how it is looked at.
struct Situation {
    std::string scene;  ///< a built-in one
    std::string model =
        {};  ///< a file below the folder of models that stands over a ground instead, where it is there
    /// Of a model: a place to stand in, which gets no ground. Nothing can stand in for the model then.
    std::optional<Placement> placement = {};
    std::string camera = {};  ///< by name; empty: the first
    float zoom = 1;           ///< of the camera: the tangent of its field of view divided by this
    float lightScale = 1;     ///< of every light's size
    bool blockersReceive = true;
    double time_s = 0;
    bool operator==(const Situation&) const = default;
};

enum class Show {
    picture,     ///< the lit scene
    visibility,  ///< of the first light
    buffer,      ///< an intermediate one, its values stretched from black to white
    difference,  ///< to the truth or to another panel's visibility, in diverging colours
};

/// A picture of a figure.
struct Panel {
    std::string caption;
    Situation situation;
    std::string technique;
    Settings settings = {};
    Show show = Show::picture;
    std::string buffer = {};  ///< a part of an inspected texture's name
    float gain = 5;           ///< of a difference
    std::optional<std::size_t> against =
        {};  ///< the panel that a difference is to; none: the ray-traced truth
    /// Frames a second of the paper, or milliseconds where `Figure::paperUnit` says so; its cost is measured
    /// here.
    std::optional<double> paper = {};
    bool timed = false;                    ///< its cost is measured although the paper gives no number
    std::optional<double> paperMaps = {};  ///< shadow maps that the paper says it took
    /// The panel that ratios of cost are to; none: the figure's first that has a cost.
    std::optional<std::size_t> base = {};
};

enum class Quantity {
    cost,
    penumbraError,
    maps,
    passShare,  ///< of panel `less` alone: what part of its device time passes named like `pass` take
};

/// That panel `less` has less of something than panel `more`, which the paper says or shows. Where it has
/// numbers of both, the claim is their ratio, and holds where ours is within `factor` of it; where it has
/// none, the order is.
struct Claim {
    std::string text;
    Quantity quantity = Quantity::cost;
    std::size_t less = 0, more = 1;
    double factor = 1.5;
    std::string pass = {};             ///< a part of passes' names
    std::optional<double> paper = {};  ///< the ratio, where the text states it and no panel's numbers do
};

/// A figure, table or statement of the paper that has no panel here, and why.
struct LeftOut {
    std::string what, why;
};

struct Figure {
    std::string id;     ///< "Figure 7"
    std::string title;  ///< what it shows, in our words
    std::vector<Panel> panels = {};
    std::vector<Claim> claims = {};
    int columns = 0;        ///< panels side by side; 0: as many as fit
    bool judged = true;     ///< errors against the ray-traced truth are measured
    std::string note = {};  ///< how it differs from the paper's
    /// A figure that is a plot: of the panels' visibilities, of the first light.
    std::function<Plot(std::span<const Image>)> plot = {};
};

/// A cell of a table of costs, or of maps.
struct Cell {
    std::string row, column;
    Situation situation;
    std::string technique;
    Settings settings;
    double paper = 0;
};

struct Table {
    std::string id, title;
    std::string unit;         ///< of the paper's numbers: "fps" or "ms"; "maps": maps are counted, not costs
    std::string baselineRow;  ///< ratios are to this row in the same column; empty: to the first cell
    std::vector<Cell> cells = {};
    std::string note = {};
};

struct Paper {
    std::string name;  ///< as on the command line
    std::string citation;
    std::string hardware;  ///< the paper's
    std::vector<Figure> figures = {};
    std::vector<Table> tables = {};
    std::vector<LeftOut> leftOut = {};
};

Paper kirsch2003();
Paper thesis();
Paper smoothies2003();
Paper schwaerzler2012();

}  // namespace penumbra::studio
