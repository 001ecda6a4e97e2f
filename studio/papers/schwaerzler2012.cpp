// SPDX-License-Identifier: Apache-2.0
// M. Schwaerzler, O. Mattausch, D. Scherzer, M. Wimmer, "Fast Accurate Soft Shadows with Adaptive Light
// Source Sampling", Vision, Modeling, and Visualization, 2012.
#include <fmt/format.h>

#include "studio/papers/recipe.h"

namespace penumbra::studio {
namespace {

// Fixed and adaptive samples lie on one lattice, with the light's corners.
const Settings fixedSamples = {
    {"samples", "17"}, {"pattern", "corners"}, {"weights", "equal"}, {"map_size", "512"}};
const Settings published = {{"published", "true"}, {"map_size", "512"}};
const Settings pcssSettings = {{"search_samples", "64"}, {"filter_samples", "64"}, {"map_size", "512"}};
constexpr double allMaps = 289;

Settings with(std::initializer_list<std::pair<std::string, std::string>> more) {
    Settings settings = published;
    settings.insert(settings.end(), more);
    return settings;
}

const Settings halfTarget = with({{"comparison_scale", "0.5"}, {"filter", "3"}});

Panel uniform(Situation situation, std::optional<double> fps = {}) {
    return {.caption = "289 fixed samples",
            .situation = std::move(situation),
            .technique = "uniform",
            .settings = fixedSamples,
            .paper = fps,
            .timed = true,
            .paperMaps = allMaps};
}

Panel adaptive(std::string caption, Situation situation, std::optional<double> fps = {},
               std::optional<double> maps = {}, Settings settings = published) {
    return {.caption = std::move(caption),
            .situation = std::move(situation),
            .technique = "adaptive",
            .settings = std::move(settings),
            .paper = fps,
            .timed = true,
            .paperMaps = maps};
}

Panel onBase(std::size_t base, Panel panel) {
    panel.base = base;
    return panel;
}

Panel difference(Panel panel, std::string caption, float gain) {
    panel.caption = std::move(caption);
    panel.show = Show::difference;
    panel.gain = gain;
    panel.against = 0;
    panel.paper.reset();
    return panel;
}

/// Inside the Sponza atrium, under a square light in its open roof.
Situation sponza(float lightSize_m) {
    return {.scene = "columns",
            .model = "sponza/Sponza.gltf",
            .placement = Placement{.eye = {-11, 3, 0.5f},
                                   .target = {2, 2.5f, -0.5f},
                                   .light = {-5, 13, 1.2f},
                                   .lightTarget = {4, 1, -0.5f},
                                   .lightSize_m = lightSize_m}};
}

/// Of the sizes searched, the one whose numbers of maps are nearest to the paper's (at 480 x 270).
constexpr float sponzaLight_m = 0.12f;

const Situation torus{.scene = "torus"};

Figure farAndNear() {
    const Situation far{.scene = "primitives", .zoom = 0.5f}, near{.scene = "primitives", .zoom = 1.5f};
    return {.id = "Figure 1",
            .title = "Fewer maps from afar, more from nearby",
            .panels = {uniform(far, 10), adaptive("adaptive, from afar", far, 67, 25),
                       onBase(2, uniform(near, 10)), onBase(2, adaptive("adaptive, nearer", near, 18, 105))},
            .claims = {{"from afar a twelfth of the maps will do", Quantity::maps, 1, 0},
                       {"nearer a third of the maps will do", Quantity::maps, 3, 2},
                       {"fewer maps are needed from afar", Quantity::maps, 1, 3},
                       {"adaptive sampling is faster than fixed (from afar)", Quantity::cost, 1, 0},
                       {"adaptive sampling is faster than fixed (nearer)", Quantity::cost, 3, 2}},
            .note = "Costs are compared within a view. The paper's scene is not named."};
}

Figure theTest() {
    const auto buffer = [&](const char* caption, const char* name) {
        Panel panel = adaptive(caption, torus);
        panel.show = Show::buffer;
        panel.buffer = name;
        return panel;
    };
    return {.id = "Figure 6",
            .title = "The test for a further subdivision",
            .panels = {buffer("sums of four corners' shadows", "sums"),
                       buffer("fragments that fail the test", "failing"),
                       buffer("the light's subdivision", "subdivision"), adaptive("final picture", torus)},
            .judged = false};
}

Figure besidePcss() {
    const Panel pcss{.caption = "pcss, 64/64 samples",
                     .situation = torus,
                     .technique = "pcss",
                     .settings = pcssSettings,
                     .paper = 370};
    return {
        .id = "Figure 7",
        .title = "Fixed sampling, adaptive sampling and PCSS, with differences x5",
        .panels = {uniform(torus, 8), adaptive("adaptive", torus, 17, 93),
                   difference(adaptive("", torus), "adaptive - fixed, x5", 5), pcss,
                   difference(pcss, "pcss - fixed, x5", 5)},
        .claims = {{"a third of the maps will do", Quantity::maps, 1, 0},
                   {"adaptive sampling is faster than fixed", Quantity::cost, 1, 0},
                   {"pcss is faster still", Quantity::cost, 3, 1},
                   {.text = "adaptive sampling is as near to the truth as fixed",
                    .quantity = Quantity::penumbraError,
                    .less = 1,
                    .more = 0,
                    .paper = 1},
                   {"adaptive sampling is nearer to the truth than pcss", Quantity::penumbraError, 1, 3}}};
}

Figure bandsAndFilter() {
    return {.id = "Figure 8",
            .title = "Bands of a small comparison target, and a filter that hides them",
            .panels = {adaptive("comparison target of a quarter", torus, {}, {},
                                with({{"comparison_scale", "0.25"}})),
                       adaptive("with a 3 x 3 filter", torus, {}, {},
                                with({{"comparison_scale", "0.25"}, {"filter", "3"}})),
                       adaptive("full comparison target", torus)},
            .claims = {{"the small target needs fewer maps", Quantity::maps, 0, 2},
                       {"the filter makes up for bands: nearer to the truth with it than without",
                        Quantity::penumbraError, 1, 0},
                       {"what is filtered is not right: the full target is nearer to the truth",
                        Quantity::penumbraError, 2, 1}}};
}

Figure sponzaFigure() {
    const Situation place = sponza(sponzaLight_m);
    return {
        .id = "Figures 9 and 10",
        .title = "The Sponza atrium, with differences x40",
        .panels = {uniform(place, 2.5), adaptive("adaptive", place, 5, 163),
                   adaptive("half a comparison target, 3 x 3 filter", place, 40, 14, halfTarget),
                   difference(adaptive("", place), "adaptive - fixed, x40", 40),
                   difference(adaptive("", place, {}, {}, halfTarget), "half target, filtered - fixed, x40",
                              40)},
        .claims = {{"half of the maps will do", Quantity::maps, 1, 0},
                   {"a twentieth of the maps will do with half a target", Quantity::maps, 2, 0},
                   {"adaptive sampling is faster than fixed", Quantity::cost, 1, 0},
                   {"the reduced target is faster still", Quantity::cost, 2, 1},
                   {.text = "adaptive sampling is as near to the truth as fixed",
                    .quantity = Quantity::penumbraError,
                    .less = 1,
                    .more = 0,
                    .paper = 1},
                   {"the full target is nearer to the truth than the reduced one", Quantity::penumbraError, 1,
                    2}},
        .note = fmt::format("A square light of {:g} m in the open roof: of the sizes in the table below, the "
                            "one whose numbers of maps are nearest to the paper's, which does not say where "
                            "its light is.",
                            sponzaLight_m)};
}

Table sponzaSearch() {
    Table table{.id = "The search for figure 9",
                .title = "Maps by the size of the light in Sponza's roof",
                .unit = "maps"};
    for (const float size_m : {1.0f, 0.25f, 0.12f, 0.08f}) {
        const std::string row = fmt::format("{:g} m", size_m);
        table.cells.push_back({row, "full target", sponza(size_m), "adaptive", published, 163});
        table.cells.push_back(
            {row, "half a target, 3 x 3 filter", sponza(size_m), "adaptive", halfTarget, 14});
    }
    return table;
}

/// What the text says without a figure.
std::vector<Figure> statements() {
    const Situation plane{.scene = "half-plane"};
    return {
        {.id = "Section 3.3.3",
         .title = "A few fragments that fail are let pass",
         .panels = {adaptive("none", torus),
                    adaptive("30 a quad", torus, {}, {}, with({{"tolerated", "30"}}))},
         .claims = {{"tolerating failing fragments needs fewer maps", Quantity::maps, 1, 0},
                    {"at the cost of accuracy", Quantity::penumbraError, 0, 1}}},
        {.id = "Section 3.4.2",
         .title = "All maps in one pass over an array, or one pass a map",
         .panels = {adaptive("array", torus),
                    adaptive("accumulation buffer", torus, {}, {}, with({{"evaluation", "accumulation"}}))},
         .claims = {{.text = "the array is a tenth faster (section 4.1)",
                     .quantity = Quantity::cost,
                     .less = 0,
                     .more = 1,
                     .factor = 1.1,
                     .paper = 1 / 1.1}}},
        {.id = "Section 3.4.3",
         .title = "Kernels over a map's texels",
         .panels = {adaptive("no kernel", torus), adaptive("2 x 2", torus, {}, {}, with({{"filter", "2"}})),
                    adaptive("3 x 3", torus, {}, {}, with({{"filter", "3"}}))},
         .claims = {{.text = "a kernel of 2 x 2 texels costs nothing",
                     .quantity = Quantity::cost,
                     .less = 1,
                     .more = 0,
                     .factor = 1.1,
                     .paper = 1},
                    {"a kernel of 2 x 2 texels is nearer to the truth than none", Quantity::penumbraError, 1,
                     0}},
         .note =
             "The paper's is the hardware's comparison of four texels; ours is computed, on a processor."},
        {.id = "Section 4.3",
         .title = "The price of the comparison, and the worst case: a penumbra that fills the picture",
         .panels = {adaptive("a small penumbra", torus), onBase(1, uniform(plane)),
                    onBase(1, adaptive("a penumbra that needs all samples", plane, {}, allMaps))},
         .claims = {{.text = "comparing takes about 30 % of the frame",
                     .quantity = Quantity::passShare,
                     .less = 0,
                     .pass = "queries",
                     .paper = 0.3},
                    {"where all samples are needed, the method is slower than fixed sampling", Quantity::cost,
                     1, 2}}},
        {.id = "Section 5, randomised subdivision",
         .title = "Future work: samples at random places within their cells",
         .panels = {adaptive("a lattice", plane),
                    adaptive("jittered", plane, {}, {}, with({{"jitter", "1"}}))},
         .claims = {{"randomised samples are nearer to the truth", Quantity::penumbraError, 1, 0}}},
        {.id = "Section 5, volumetric lights",
         .title = "Future work: a ball that shines from its surface, and from all of its inside",
         .panels = {adaptive("its surface", {.scene = "sphere"}),
                    adaptive("its inside", {.scene = "sphere"}, {}, {}, with({{"emission", "volume"}}))},
         .judged = false,
         .note =
             "Octants take the place of quads. The truth traced here is a surface's; that of the volume is "
             "tested against a closed form."}};
}

}  // namespace

Paper schwaerzler2012() {
    Paper paper{.name = "schwaerzler2012",
                .citation =
                    "M. Schwaerzler, O. Mattausch, D. Scherzer, M. Wimmer, Fast Accurate Soft Shadows with "
                    "Adaptive Light Source Sampling, VMV 2012",
                .hardware = "Core i7-920, GeForce 580 GTX, 1024 x 768"};
    paper.figures = {farAndNear(), theTest(), besidePcss(), bandsAndFilter(), sponzaFigure()};
    for (Figure& figure : statements()) paper.figures.push_back(std::move(figure));
    paper.tables = {sponzaSearch()};
    paper.leftOut = {
        {"Figure 2", "A diagram of umbra and penumbra."},
        {"Figure 3", "A diagram of shadow mapping."},
        {"Figure 4", "A diagram of a penumbra that grows with the receiver's tilt."},
        {"Figure 5", "A diagram of the subdivision; figure 6 shows a real one."},
        {"Section 3.4.1", "That weights all alike would darken penumbrae: there is no setting for it."},
        {"Section 4.4", "That the frame rate varies: figure 1 shows by how much the number of maps does."}};
    return paper;
}

}  // namespace penumbra::studio
