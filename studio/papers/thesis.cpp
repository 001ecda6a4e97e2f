// SPDX-License-Identifier: Apache-2.0
// The thesis on an OpenGL implementation of U. Assarsson and T. Akenine-Moeller's soft shadow volumes
// (SIGGRAPH 2003).
#include "studio/papers/recipe.h"

namespace penumbra::studio {
namespace {

const Settings published = {{"method", "wedges"}};

/// A picture of the published method beside ours and the truth.
Figure screenshot(std::string id, std::string title, Situation situation, std::string note = "") {
    return {.id = std::move(id),
            .title = std::move(title),
            .panels = {{.caption = "published: wedges",
                        .situation = situation,
                        .technique = "soft-volumes",
                        .settings = published},
                       {.caption = "improved: layers", .situation = situation, .technique = "soft-volumes"},
                       {.caption = "ray-traced", .situation = situation, .technique = "reference"}},
            .claims = {{"layers are nearer to the truth than wedges", Quantity::penumbraError, 1, 0}},
            .note = std::move(note)};
}

Figure resized() {
    const Situation scene{.scene = "primitives"};
    const auto panel = [&](const char* caption, const char* size, double fps) {
        return Panel{.caption = caption,
                     .situation = scene,
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"v_buffer", size}},
                     .paper = fps};
    };
    return {.id = "Figures 20 to 22",
            .title = "A V-buffer of full, half and quarter resolution",
            .panels = {panel("full (the paper's 1024 x 1024)", "full", 16),
                       panel("half (512 x 512)", "half", 45), panel("quarter (256 x 256)", "quarter", 85)},
            .claims = {{"half the resolution costs less", Quantity::cost, 1, 0},
                       {"a quarter costs less still", Quantity::cost, 2, 1}}};
}

}  // namespace

Paper thesis() {
    Paper paper{.name = "thesis",
                .citation =
                    "An OpenGL implementation of soft shadow volumes (a Swedish Master's thesis, after "
                    "Assarsson and Akenine-Moeller 2003)",
                .hardware = "not named"};
    const Situation boxes{.scene = "two-boxes"}, primitives{.scene = "primitives"};
    const auto buffer = [&](const char* caption, const char* name) {
        return Panel{.caption = caption,
                     .situation = primitives,
                     .technique = "soft-volumes",
                     .settings = published,
                     .show = Show::buffer,
                     .buffer = name};
    };
    paper.figures.push_back({.id = "Figure 4",
                             .title = "The position buffer",
                             .panels = {buffer("receivers' depth", "receiver depth")},
                             .judged = false,
                             .note = "Positions are made from the depth; no buffer holds them."});
    paper.figures.push_back(
        {.id = "Figure 8",
         .title = "The V-buffer from the additive and subtractive contributions",
         .panels = {buffer("additive (red) and subtractive (green) layers", "additive and subtractive"),
                    {.caption = "their sum, the V-buffer",
                     .situation = primitives,
                     .technique = "soft-volumes",
                     .settings = published,
                     .show = Show::visibility}},
         .judged = false});
    paper.figures.push_back(
        {.id = "Figure 9",
         .title = "Penumbra wedges",
         .panels = {{.caption = "wedges, outlined",
                     .situation = boxes,
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"wireframe", "true"}},
                     .show = Show::buffer,
                     .buffer = "wireframe"}},
         .judged = false,
         .note =
             "A wedge has six sides and a cap here; the thesis's has eight triangles and eight of caps."});
    const auto marked = [&](const char* caption, const char* marking) {
        return Panel{.caption = caption,
                     .situation = boxes,
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"marking", marking}},
                     .timed = true};
    };
    paper.figures.push_back({.id = "Figures 10 and 11",
                             .title = "Pixels marked in the stencil before wedges are evaluated",
                             .panels = {marked("marked", "stencil"), marked("not marked", "none")},
                             .claims = {{"marking costs less than it saves", Quantity::cost, 0, 1}},
                             .note = "A mark is up to two draws for each half of each wedge, and what it "
                                     "saves an evaluation that finds "
                                     "nothing, which costs little."});
    paper.figures.push_back(
        {.id = "Figures 15 and 16",
         .title = "Lighting and colour added to the V-buffer",
         .panels = {{.caption = "visibility",
                     .situation = boxes,
                     .technique = "soft-volumes",
                     .settings = published,
                     .show = Show::visibility},
                    {.caption = "times lighting and colour",
                     .situation = boxes,
                     .technique = "soft-volumes",
                     .settings = published}},
         .judged = false,
         .note = "Our lighting and colour come in one pass; built-in scenes have colours, no textures."});
    paper.figures.push_back(
        {.id = "Figure 19",
         .title = "Shadow bleeding at a resized V-buffer",
         .panels = {{.caption = "full",
                     .situation = {.scene = "two-boxes", .zoom = 3},
                     .technique = "soft-volumes",
                     .settings = published},
                    {.caption = "quarter, point-sampled, as published: it bleeds",
                     .situation = {.scene = "two-boxes", .zoom = 3},
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"v_buffer", "quarter"}, {"upsampling", "point"}}},
                    {.caption = "quarter, from texels on the same plane",
                     .situation = {.scene = "two-boxes", .zoom = 3},
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"v_buffer", "quarter"}}},
                    {.caption = "point-sampled - truth, x5",
                     .situation = {.scene = "two-boxes", .zoom = 3},
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"v_buffer", "quarter"}, {"upsampling", "point"}},
                     .show = Show::difference}},
         .claims = {{"the full V-buffer is nearer to the truth", Quantity::penumbraError, 0, 1},
                    {"texels on the same plane are nearer than point samples", Quantity::penumbraError, 2,
                     1}},
         .note = "The cure is ours."});
    paper.figures.push_back(resized());
    paper.figures.push_back(screenshot("Figure 23", "Several coloured lights", {.scene = "many-lights"}));
    paper.figures.push_back(screenshot("Figure 24", "Several shadow casters", primitives));
    paper.figures.push_back(screenshot("Figure 25", "A rectangular light", boxes));
    paper.figures.push_back(screenshot("Figure 26", "Arbitrary shadow receivers", {.scene = "torus"}));
    paper.figures.push_back(screenshot("Figure 27", "Arbitrary shadow receivers", {.scene = "columns"}));
    paper.figures.push_back(
        screenshot("Figure 28", "Several shadow casters", {.scene = "overlapping-blockers"}));
    paper.figures.push_back(
        screenshot("Figure 29", "A dynamic coloured light", {.scene = "moving", .time_s = 0.7}));
    paper.leftOut = {
        {"Figures 1 and 2", "Diagrams of hard and soft shadows."},
        {"Figure 3", "A diagram of a wedge."},
        {"Figures 5 to 7",
         "Diagrams of a value of 12 bits in four bytes. Our layers are of 32-bit floats, which the thesis "
         "expected of later hardware; nothing is split."},
        {"Figures 12 to 14", "Diagrams of coverage, which is in closed form here."},
        {"Figures 17 and 18", "Diagrams of capping; hard-volumes has it with open_meshes=capped."}};
    return paper;
}

}  // namespace penumbra::studio
