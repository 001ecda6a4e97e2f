// SPDX-License-Identifier: Apache-2.0
// E. Chan, F. Durand, "Rendering Fake Soft Shadows with Smoothies", Eurographics Symposium on Rendering,
// 2003.
#include <array>

#include "studio/papers/recipe.h"

namespace penumbra::studio {
namespace {

// The paper's smoothies: outwards alone, alpha remapped, stored and filtered, with a sinusoidal falloff.
const Settings published = {{"buffer", "alpha"}, {"falloff", "sinusoidal"}};

Settings with(Settings settings, const std::string& name, const std::string& value) {
    settings.emplace_back(name, value);
    return settings;
}

Panel smoothies(std::string caption, Situation situation, Settings settings = published) {
    return {.caption = std::move(caption),
            .situation = std::move(situation),
            .technique = "smoothies",
            .settings = std::move(settings)};
}

Panel buffer(std::string caption, Situation situation, std::string name, Settings settings = published) {
    Panel panel = smoothies(std::move(caption), std::move(situation), std::move(settings));
    panel.show = Show::buffer;
    panel.buffer = std::move(name);
    return panel;
}

Panel truth(Situation situation) {
    return {.caption = "ray-traced", .situation = std::move(situation), .technique = "reference"};
}

Figure edges() {
    Figure figure{
        .id = "Figure 7",
        .title = "The cylinder's shadow edge by method and map size",
        .note =
            "The paper's times are printed in its pictures alone and are not repeated here. From t = 0.02 "
            "to 0.2 its scenes took some 15 % longer."};
    const Situation cylinder{.scene = "primitives", .camera = "cylinder", .zoom = 2};
    for (const char* size : {"256", "512", "1024"}) {
        const Settings map = {{"map_size", size}};
        const std::string at = std::string(", ") + size;
        figure.panels.push_back({.caption = "hard" + at,
                                 .situation = cylinder,
                                 .technique = "hard",
                                 .settings = map,
                                 .timed = true});
        figure.panels.push_back({.caption = "bicubic PCF" + at,
                                 .situation = cylinder,
                                 .technique = "pcf",
                                 .settings = with(map, "kernel", "bicubic"),
                                 .timed = true});
        for (const char* t : {"0.02", "0.2"}) {
            figure.panels.push_back({.caption = std::string("smoothies, t = ") + t + at,
                                     .situation = cylinder,
                                     .technique = "smoothies",
                                     .settings = with(with(published, "map_size", size), "t", t),
                                     .timed = true});
        }
    }
    figure.columns = 4;
    figure.claims = {{"bicubic filtering costs more than a plain map (256)", Quantity::cost, 0, 1},
                     {"smoothies cost more than a plain map (256)", Quantity::cost, 0, 2},
                     {"smoothies cost less than bicubic filtering (1024)", Quantity::cost, 10, 9},
                     {"a wider t costs more (1024)", Quantity::cost, 10, 11}};
    return figure;
}

Figure lightSizes() {
    Figure figure{.id = "Figure 8", .title = "Smoothies against ray tracing as the light grows"};
    for (const float scale : {0.1f, 0.3f, 1.0f}) {
        const Situation cylinder{.scene = "cylinder", .lightScale = scale};
        const std::string name = "light of " + std::to_string(2 * scale).substr(0, 3) + " m";
        figure.panels.push_back(
            smoothies("smoothies, " + name, cylinder, with(published, "map_size", "1024")));
        figure.panels.push_back(truth(cylinder));
    }
    figure.columns = 2;
    figure.claims = {{"the method works best where the light is small against the blocker",
                      Quantity::penumbraError, 0, 4}};
    return figure;
}

struct Model {
    const char* title;
    Situation situation;
    std::array<double, 3> ms;  ///< at 256, 512 and 1024
};

// Models of like size; without them, built-in scenes.
const std::vector<Model>& models() {
    static const std::vector<Model> all = {
        {"boat (5664 triangles)", {.scene = "two-boxes", .model = "models/ship_pirate.glb"}, {20, 22, 26}},
        {"primitives (9424)", {.scene = "primitives"}, {20, 22, 26}},
        {"flamingo (26,370)", {.scene = "torus", .model = "models/bird_seagull.glb"}, {21, 22, 25}},
        {"elephant (39,290)",
         {.scene = "overlapping-blockers", .model = "models/spot_23k.glb"},
         {26, 27, 32}},
        {"motorbike (50,648)", {.scene = "moving", .model = "models/bicycle_48k.glb"}, {37, 50, 53}}};
    return all;
}

Figure gallery() {
    Figure figure{.id = "Figure 12",
                  .title = "Complex blockers and receivers: plain maps, smoothies, ray tracing",
                  .note = "In the paper's models' places: a pirate ship, a seagull, a cow and a bicycle."};
    for (const Model& model : models()) {
        if (model.situation.model.empty()) continue;
        figure.panels.push_back({.caption = std::string("hard, for the ") + model.title,
                                 .situation = model.situation,
                                 .technique = "hard",
                                 .settings = {{"map_size", "1024"}}});
        figure.panels.push_back(smoothies(std::string("smoothies, for the ") + model.title, model.situation,
                                          with(published, "map_size", "1024")));
        figure.panels.push_back(truth(model.situation));
    }
    figure.columns = 3;
    for (std::size_t i = 0; i < figure.panels.size(); i += 3) {
        figure.claims.push_back({"smoothies are nearer to the truth than a plain map (" +
                                     figure.panels[i].caption.substr(14) + ")",
                                 Quantity::penumbraError, i + 1, i});
    }
    return figure;
}

Table performance() {
    Table table{.id = "Table 1",
                .title = "Cost by scene and buffer size",
                .unit = "ms",
                .baselineRow = "256",
                .note =
                    "The paper times whole frames, of which the map is a small part; we time the shadows "
                    "alone, of the "
                    "models of Figure 12."};
    constexpr std::array sizes = {"256", "512", "1024"};
    for (const Model& model : models()) {
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            table.cells.push_back({.row = sizes[i],
                                   .column = model.title,
                                   .situation = model.situation,
                                   .technique = "smoothies",
                                   .settings = with(published, "map_size", sizes[i]),
                                   .paper = model.ms[i]});
        }
    }
    return table;
}

}  // namespace

Paper smoothies2003() {
    Paper paper{
        .name = "smoothies2003",
        .citation =
            "E. Chan, F. Durand, Rendering Fake Soft Shadows with Smoothies, Eurographics Symposium on "
            "Rendering, 2003",
        .hardware = "GeForce FX"};
    const Situation primitives{.scene = "primitives"}, boxes{.scene = "two-boxes"},
        close{.scene = "primitives", .camera = "cylinder"};
    const Settings fixed = with(published, "remap", "false");
    paper.figures.push_back(
        {.id = "Figure 1",
         .title = "Overview",
         .panels = {buffer("shadow map", primitives, "depth map"),
                    buffer("smoothie buffer: alpha in red, depth in green", primitives, "smoothie"),
                    smoothies("final picture", primitives), truth(primitives)}});
    paper.figures.push_back(
        {.id = "Figure 4",
         .title = "Alpha as it is, and remapped by the distances of blocker and receiver",
         .panels = {smoothies("linear alpha of a fixed width", close, with(fixed, "t", "0.05")),
                    smoothies("remapped", close, with(published, "t", "0.05")), truth(close)},
         .claims = {{"remapping brings the shadow nearer to the truth", Quantity::penumbraError, 1, 0}}});
    paper.figures.push_back({.id = "Figure 6",
                             .title = "Corners of smoothies",
                             .panels = {buffer("smoothie buffer", boxes, "smoothie"),
                                        smoothies("shadow of a corner", {.scene = "two-boxes", .zoom = 3})},
                             .judged = false});
    paper.figures.push_back(edges());
    paper.figures.push_back(lightSizes());
    paper.figures.push_back(
        {.id = "Figure 9",
         .title = "One blocker, two receivers",
         .panels = {buffer("alpha of a fixed width", boxes, "smoothie", fixed),
                    buffer("remapped", boxes, "smoothie"), smoothies("final picture", boxes),
                    smoothies("without remapping", boxes, fixed)},
         .claims = {{"remapping brings the shadow nearer to the truth", Quantity::penumbraError, 2, 3}}});
    const Situation overlapping{.scene = "overlapping-blockers"},
        zoomed{.scene = "overlapping-blockers", .zoom = 3};
    paper.figures.push_back({.id = "Figure 10",
                             .title = "Overlapping penumbrae",
                             .panels = {smoothies("smoothies", overlapping),
                                        smoothies("smoothies, close", zoomed), truth(zoomed)}});
    paper.figures.push_back(gallery());
    paper.tables.push_back(performance());
    paper.leftOut = {{"Figures 2, 3 and 5", "Diagrams."},
                     {"Figure 11", "The shaders' text and its numbers of instructions on one device."},
                     {"Section 6.1", "Penumbra maps are another method, which is not here."}};
    return paper;
}

}  // namespace penumbra::studio
