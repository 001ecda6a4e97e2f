// SPDX-License-Identifier: Apache-2.0
// F. Kirsch, J. Doellner, "Real-Time Soft Shadows Using a Single Light Sample", Journal of WSCG 11(1), 2003.
#include <array>

#include "studio/papers/recipe.h"

namespace penumbra::studio {
namespace {

const Settings published = {{"mode", "compositing"}, {"neighbours", "6"}, {"start_difference", "1/256"}};

// The paper's scene of the performance study is not known; one map is enough for this one, too.
const Situation studied{.scene = "overlapping-blockers", .zoom = 1.15f};

Settings with(Settings settings, const std::string& name, const std::string& value) {
    settings.emplace_back(name, value);
    return settings;
}

constexpr std::array depths = {0.25, 0.5, 0.75, 1.0};

// I(sd, sw), c_scale = 1 and c_bias = 0.05, as the device has it under a half-plane 2 m above the ground: by
// the paper's second property the same as with c_scale = 2 / sd.
Figure attenuation() {
    Figure figure{.id = "Figure 3",
                  .title = "The attenuation function, from the shadow of a half-plane",
                  .judged = false,
                  .note = "The paper plots a surface; these are sections through it. Points are pixels."};
    for (const double depth : depths) {
        figure.panels.push_back({.caption = "sd = " + std::to_string(depth).substr(0, 4),
                                 .situation = {.scene = "half-plane", .camera = "plan"},
                                 .technique = "shadow-width",
                                 .settings = {{"mode", "cpu-sweep"},
                                              {"physical", "false"},
                                              {"c_scale", std::to_string(2 / depth)},
                                              {"c_bias", "0.05"}},
                                 .show = Show::visibility});
    }
    figure.plot = [](std::span<const Image> visibilities) {
        Plot plot{.title = "I(sd, sw), c_scale = 1, c_bias = 0.05",
                  .x = {.title = "shadow width sw"},
                  .y = {.title = "intensity I"}};
        constexpr double height_m =
            3;  // of the camera's picture, whose middle is the geometric shadow's border
        for (std::size_t i = 0; i < visibilities.size(); ++i) {
            const Image& visibility = visibilities[i];
            PlotSeries& series = plot.series.emplace_back();
            series.name = "sd = " + std::to_string(depths[i]).substr(0, 4);
            for (int x = visibility.width_px / 2 - 1; x >= 0; --x) {
                const double width_m =
                    (0.5 * visibility.width_px - x - 0.5) * height_m / visibility.height_px;
                if (width_m > 1) break;
                series.points.push_back({.x = width_m, .y = visibility.at(x, visibility.height_px / 2)});
            }
        }
        return plot;
    };
    return figure;
}

Figure compositing() {
    Figure figure{.id = "Figure 4",
                  .title = "A sphere's shadow-width map after more and more steps of compositing",
                  .judged = false,
                  .note = "Six neighbours, the starting difference 1/256; widths are stretched to white."};
    const Situation sphere{.scene = "sphere"};
    figure.panels.push_back({.caption = "depth map, whose blockers are the inverted occlusion map",
                             .situation = sphere,
                             .technique = "shadow-width",
                             .settings = published,
                             .show = Show::buffer,
                             .buffer = "depth map"});
    for (const char* steps : {"4", "5", "6", "7", "8"}) {
        figure.panels.push_back({.caption = std::string("after ") + steps + " steps",
                                 .situation = sphere,
                                 .technique = "shadow-width",
                                 .settings = with(published, "steps", steps),
                                 .show = Show::buffer,
                                 .buffer = "shadow-width map"});
    }
    return figure;
}

Table performance() {
    Table table{
        .id = "Table 1",
        .title = "Cost by map size, everything updated every frame",
        .unit = "fps",
        .baselineRow = "hard shadows",
        .note =
            "The paper times whole frames of 512 x 512, we the shadows alone, so that our ratios must be "
            "larger. Its scene is not known; ours is Figure 8's."};
    struct Row {
        const char* name;
        std::string technique;
        Settings settings;
        std::array<double, 4> fps;
    };
    std::vector<Row> rows = {{"hard shadows", "hard", {}, {97.9, 79.8, 42.9, 17.0}},
                             {"software",
                              "shadow-width",
                              {{"mode", "cpu-sweep"}, {"reuse_maps", "false"}},
                              {61.6, 34.3, 12.6, 3.2}}};
    struct Start {
        const char* start;
        std::array<double, 4> three, six;
    };
    static const std::vector<Start> starts = {{"1/4", {86.1, 56.4, 22.4, 7.0}, {77.4, 43.6, 15.1, 4.4}},
                                              {"1/16", {77.5, 43.6, 15.2, 4.4}, {64.4, 30.0, 9.2, 2.5}},
                                              {"1/64", {70.3, 35.5, 11.4, 3.2}, {54.9, 22.9, 6.6, 1.7}},
                                              {"1/256", {64.0, 29.3, 8.8, 2.4}, {47.5, 17.8, 4.9, 1.3}}};
    static std::vector<std::string> names;
    names.clear();
    names.reserve(2 * starts.size());
    for (const Start& start : starts) {
        for (const char* neighbours : {"3", "6"}) {
            names.push_back(std::string("hardware ") + start.start + ", " + neighbours + " neighbours");
            rows.push_back({names.back().c_str(),
                            "shadow-width",
                            {{"mode", "compositing"},
                             {"neighbours", neighbours},
                             {"start_difference", start.start},
                             {"reuse_maps", "false"}},
                            neighbours[0] == '3' ? start.three : start.six});
        }
    }
    constexpr std::array sizes = {"256", "512", "1024", "2048"};
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            table.cells.push_back({.row = row.name,
                                   .column = sizes[i],
                                   .situation = studied,
                                   .technique = row.technique,
                                   .settings = with(row.settings, "map_size", sizes[i]),
                                   .paper = row.fps[i]});
        }
    }
    return table;
}

}  // namespace

Paper kirsch2003() {
    Paper paper{.name = "kirsch2003",
                .citation =
                    "F. Kirsch, J. Doellner, Real-Time Soft Shadows Using a Single Light Sample, Journal of "
                    "WSCG 11(1), 2003",
                .hardware = "Pentium IV 1.3 GHz, GeForce3 Ti200"};
    const Situation torus{.scene = "torus"}, overlapping = studied,
                                             disk{.scene = "disk-and-sphere", .zoom = 1.2f};
    paper.figures.push_back(
        {.id = "Figure 1",
         .title = "A torus with a soft shadow, its depth map and its shadow-width map",
         .panels = {{.caption = "published",
                     .situation = torus,
                     .technique = "shadow-width",
                     .settings = published},
                    {.caption = "depth map",
                     .situation = torus,
                     .technique = "shadow-width",
                     .settings = published,
                     .show = Show::buffer,
                     .buffer = "depth map"},
                    {.caption = "shadow-width map",
                     .situation = torus,
                     .technique = "shadow-width",
                     .settings = published,
                     .show = Show::buffer,
                     .buffer = "shadow-width map"},
                    {.caption = "improved (exact distances, both sides)",
                     .situation = torus,
                     .technique = "shadow-width"},
                    {.caption = "ray-traced", .situation = torus, .technique = "reference"}},
         .claims = {{"the improved maps are nearer to the truth than the published ones",
                     Quantity::penumbraError, 3, 0}}});
    paper.figures.push_back(attenuation());
    paper.figures.push_back(compositing());
    paper.figures.push_back(
        {.id = "Figure 5",
         .title = "Artifacts due to overlapping blockers",
         .panels = {{.caption = "published",
                     .situation = overlapping,
                     .technique = "shadow-width",
                     .settings = published},
                    {.caption = "improved", .situation = overlapping, .technique = "shadow-width"},
                    {.caption = "exact", .situation = overlapping, .technique = "exact"},
                    {.caption = "ray-traced", .situation = overlapping, .technique = "reference"}},
         .claims = {{"one depth a texel fails where blockers overlap: visibility from triangles is nearer to "
                     "the truth",
                     Quantity::penumbraError, 2, 0}}});
    Situation receiversOnly = overlapping;
    receiversOnly.blockersReceive = false;
    paper.figures.push_back(
        {.id = "Figure 6",
         .title = "Without self-shadowing, fewer artifacts",
         .panels = {{.caption = "blockers receive",
                     .situation = overlapping,
                     .technique = "shadow-width",
                     .settings = published},
                    {.caption = "blockers do not receive, front faces",
                     .situation = receiversOnly,
                     .technique = "shadow-width",
                     .settings = with(published, "back_faces", "false")},
                    {.caption = "blockers do not receive, back faces",
                     .situation = receiversOnly,
                     .technique = "shadow-width",
                     .settings = published}},
         .claims = {{"back faces in the depth map bring less error than front faces, on the same pixels",
                     Quantity::penumbraError, 2, 1}},
         .note =
             "Where blockers receive, other pixels are judged, so that the first error does not compare."});
    paper.figures.push_back(
        {.id = "Figure 7",
         .title = "Maps of 64 x 64 texels",
         .panels = {{.caption = "published, 64 x 64",
                     .situation = disk,
                     .technique = "shadow-width",
                     .settings = with(published, "map_size", "64")},
                    {.caption = "published, 1024 x 1024",
                     .situation = disk,
                     .technique = "shadow-width",
                     .settings = with(published, "map_size", "1024")},
                    {.caption = "improved, 64 x 64",
                     .situation = disk,
                     .technique = "shadow-width",
                     .settings = {{"map_size", "64"}}},
                    {.caption = "ray-traced", .situation = disk, .technique = "reference"}},
         .claims = {
             {"64 x 64 texels are as near to the truth as 1024 x 1024", Quantity::penumbraError, 0, 1}}});
    paper.figures.push_back({.id = "Figure 8",
                             .title = "The scene of the performance study",
                             .panels = {{.caption = "published",
                                         .situation = studied,
                                         .technique = "shadow-width",
                                         .settings = published},
                                        {.caption = "hard", .situation = studied, .technique = "hard"}},
                             .claims = {{"shadow widths are nearer to the truth than a plain map",
                                         Quantity::penumbraError, 0, 1}},
                             .note = "A stand-in: the paper's scene is not known."});
    paper.tables.push_back(performance());
    paper.leftOut = {{"Figure 2", "A diagram of shadow width and shadow depth."},
                     {"Section 5, united projections",
                      "Widths that grow where blockers' projections meet are seen in motion; one frame of "
                      "them is Figure 5."},
                     {"Section 6, the software method without its widths (+ 40 %)",
                      "The map is read back and swept in one pass, which no setting divides."},
                     {"Section 6, independence of the canvas and of the scene's complexity",
                      "bench --axes measures both for any technique."}};
    return paper;
}

}  // namespace penumbra::studio
