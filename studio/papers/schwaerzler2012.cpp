// SPDX-License-Identifier: Apache-2.0
// M. Schwaerzler, O. Mattausch, D. Scherzer, M. Wimmer, "Fast Accurate Soft Shadows with Adaptive Light
// Source Sampling", Vision, Modeling, and Visualization, 2012.
#include "studio/papers/recipe.h"

namespace penumbra::studio {
namespace {

// 17 x 17 samples with the light's corners; the paper's own test, weights and maps.
const Settings fixedSamples = {
    {"samples", "17"}, {"pattern", "corners"}, {"weights", "equal"}, {"map_size", "512"}};
const Settings published = {{"max_samples", "289"}, {"max_depth", "4"},  {"min_depth", "0"},
                            {"weights", "paper"},   {"smooth", "false"}, {"reuse", "false"},
                            {"map_size", "512"}};
const Settings pcssSettings = {{"search_samples", "64"}, {"filter_samples", "64"}, {"map_size", "512"}};

Settings reduced(int filter) {
    Settings settings = published;
    settings.emplace_back("comparison_scale", "0.5");
    settings.emplace_back("filter", std::to_string(filter));
    return settings;
}

Panel uniform(Situation situation, std::optional<double> fps = {}) {
    return {.caption = "289 fixed samples",
            .situation = std::move(situation),
            .technique = "uniform",
            .settings = fixedSamples,
            .paper = fps};
}

Panel adaptive(std::string caption, Situation situation, std::optional<double> fps = {},
               Settings settings = published) {
    return {.caption = std::move(caption),
            .situation = std::move(situation),
            .technique = "adaptive",
            .settings = std::move(settings),
            .paper = fps};
}

Panel difference(Panel panel, std::string caption, float gain) {
    panel.caption = std::move(caption);
    panel.show = Show::difference;
    panel.gain = gain;
    panel.against = 0;
    panel.paper.reset();
    return panel;
}

}  // namespace

Paper schwaerzler2012() {
    Paper paper{.name = "schwaerzler2012",
                .citation =
                    "M. Schwaerzler, O. Mattausch, D. Scherzer, M. Wimmer, Fast Accurate Soft Shadows with "
                    "Adaptive Light Source Sampling, VMV 2012",
                .hardware = "Core i7-920, GeForce 580 GTX, 1024 x 768"};
    const Situation far{.scene = "primitives", .zoom = 0.5f}, near{.scene = "primitives", .zoom = 1.5f},
        torus{.scene = "torus"},
        sponza{.scene = "columns",
               .model = "sponza/Sponza.gltf",
               // Inside the atrium, under a light in its open roof.
               .placement = Placement{.eye = {-11, 3, 0.5f},
                                      .target = {2, 2.5f, -0.5f},
                                      .light = {-5, 13, 1.2f},
                                      .lightTarget = {4, 1, -0.5f},
                                      .lightSize_m = 1}};
    paper.figures.push_back(
        {.id = "Figure 1",
         .title = "Fewer maps from afar, more from nearby",
         .panels = {uniform(far, 10), adaptive("adaptive, from afar (the paper's: 25 maps)", far, 67),
                    uniform(near, 10), adaptive("adaptive, nearer (the paper's: 105 maps)", near, 18)},
         .claims = {{"adaptive sampling draws fewer maps than 289", Quantity::maps, 1, 0},
                    {"fewer maps are needed from afar", Quantity::maps, 1, 3},
                    {"adaptive sampling is faster than fixed (from afar)", Quantity::cost, 1, 0},
                    {"adaptive sampling is faster than fixed (nearer)", Quantity::cost, 3, 2}}});
    const auto buffer = [&](const char* caption, const char* name) {
        Panel panel = adaptive(caption, torus);
        panel.show = Show::buffer;
        panel.buffer = name;
        return panel;
    };
    paper.figures.push_back(
        {.id = "Figure 6",
         .title = "The test for a further subdivision",
         .panels = {buffer("sums of four corners' shadows", "sums"),
                    buffer("fragments that fail the test", "failing"),
                    buffer("the light's subdivision", "subdivision"), adaptive("final picture", torus)},
         .judged = false});
    Panel pcss{.caption = "pcss, 64/64 samples",
               .situation = torus,
               .technique = "pcss",
               .settings = pcssSettings,
               .paper = 370};
    paper.figures.push_back(
        {.id = "Figure 7",
         .title = "Fixed sampling, adaptive sampling and PCSS, with differences x5",
         .panels = {uniform(torus, 8), adaptive("adaptive (the paper's: 93 maps)", torus, 17),
                    difference(adaptive("", torus), "adaptive - fixed, x5", 5), pcss,
                    difference(pcss, "pcss - fixed, x5", 5)},
         .claims = {{"adaptive sampling is faster than fixed", Quantity::cost, 1, 0},
                    {"pcss is faster still", Quantity::cost, 3, 1},
                    {"adaptive sampling is nearer to the truth than pcss", Quantity::penumbraError, 1, 3}}});
    Settings coarse = published;
    coarse.emplace_back("comparison_scale", "0.25");
    Settings smoothed = coarse;
    smoothed.emplace_back("filter", "3");
    paper.figures.push_back({.id = "Figure 8",
                             .title = "Bands of a small comparison target, and a filter that hides them",
                             .panels = {adaptive("comparison target of a quarter", torus, {}, coarse),
                                        adaptive("with a 3 x 3 filter", torus, {}, smoothed),
                                        adaptive("full comparison target", torus)},
                             .claims = {{"the full target is nearer to the truth than a quarter",
                                         Quantity::penumbraError, 2, 0}}});
    paper.figures.push_back(
        {.id = "Figures 9 and 10",
         .title = "The Sponza atrium, with differences x40",
         .panels = {uniform(sponza, 2.5), adaptive("adaptive (the paper's: 163 maps)", sponza, 5),
                    adaptive("half a comparison target, 3 x 3 filter (the paper's: 14 maps)", sponza, 40,
                             reduced(3)),
                    difference(adaptive("", sponza), "adaptive - fixed, x40", 40),
                    difference(adaptive("", sponza, {}, reduced(3)), "half target, filtered - fixed, x40",
                               40)},
         .claims = {{"adaptive sampling is faster than fixed", Quantity::cost, 1, 0},
                    {"the reduced target is faster still", Quantity::cost, 2, 1},
                    {"the full target is nearer to the truth", Quantity::penumbraError, 1, 2}}});
    return paper;
}

}  // namespace penumbra::studio
