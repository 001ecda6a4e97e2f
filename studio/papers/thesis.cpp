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

/// A model with what it has of triangles, and the scene that stands in for it.
Situation model(const char* file, const char* standIn) {
    return {.scene = standIn, .model = file};
}

/// Four bytes a layer, as published (figures 5 to 7).
Figure splitBytes(const Situation& situation) {
    const Settings split = {{"method", "wedges"}, {"layer_format", "split"}};
    const auto bytes = [&](const char* caption, const char* buffer) {
        return Panel{.caption = caption,
                     .situation = situation,
                     .technique = "soft-volumes",
                     .settings = split,
                     .show = Show::buffer,
                     .buffer = buffer};
    };
    const auto visibility = [&](const char* caption, const Settings& settings) {
        return Panel{.caption = caption,
                     .situation = situation,
                     .technique = "soft-volumes",
                     .settings = settings,
                     .show = Show::visibility};
    };
    Figure figure{
        .id = "Figures 5 to 7",
        .title = "12 bits in four bytes of three, added up and put together again",
        .panels = {bytes("wedges that add: the three upper bytes as red, green, blue",
                         "additive layer's bytes"),
                   bytes("wedges that subtract", "subtractive layer's bytes"),
                   visibility("put together", split), visibility("floats", published)},
        .judged = false,
        .note =
            "The umbra of the light's centre is counted in floats in both. The last picture is black "
            "where the two agree to a thousandth."};
    figure.panels.push_back({.caption = "bytes - floats, x100",
                             .situation = situation,
                             .technique = "soft-volumes",
                             .settings = split,
                             .show = Show::difference,
                             .gain = 100,
                             .against = 3});
    return figure;
}

/// Holes closed with triangles that nobody draws (figures 17 and 18).
Figure capping() {
    const Situation ship = model("models/ship_pirate.glb", "moving");
    const auto panel = [&](const char* caption, const char* method, const char* openMeshes) {
        return Panel{.caption = caption,
                     .situation = ship,
                     .technique = "soft-volumes",
                     .settings = {{"method", method}, {"open_meshes", openMeshes}}};
    };
    return {
        .id = "Figures 17 and 18",
        .title = "Capping of open meshes",
        .panels = {panel("published: wedges of a capped mesh", "wedges", "capped"),
                   panel("layers of a capped mesh", "layers", "capped"),
                   panel("layers of the mesh as it is, edges signed", "layers", "signed"),
                   {.caption = "ray-traced", .situation = ship, .technique = "reference"}},
        .claims = {{"signed edges are nearer to the truth than caps", Quantity::penumbraError, 2, 1}},
        .note =
            "The figures are diagrams. A pirate ship of 9,498 triangles, 866 of whose edges are open and "
            "2,452 have more than two faces: a sail is meant to be open, and its cap is a caster. Capping "
            "takes 8 ns an edge of 4,000 and 24 of 4,000,000: linear, as the thesis says, but for caches."};
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
    const Situation boxes{.scene = "two-boxes"}, primitives{.scene = "primitives"},
        figureInCloth = model("models/cesium_man.glb", "moving");
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
    paper.figures.push_back(splitBytes(primitives));
    paper.figures.push_back(
        {.id = "Figure 8",
         .title = "The V-buffer from the additive and subtractive contributions",
         .panels = {buffer("additive (red, from 1 on) and subtractive (green) layer, stretched",
                           "additive and subtractive"),
                    {.caption = "the one less the other: the V-buffer",
                     .situation = primitives,
                     .technique = "soft-volumes",
                     .settings = published,
                     .show = Show::visibility}},
         .judged = false,
         .note =
             "The additive layer starts from one, the subtractive one from the umbra of the light's centre. "
             "What the thesis adds and subtracts of that umbra, side by side, is one number here."});
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
    const auto marked = [&](const char* caption, const Situation& situation, const char* marking) {
        return Panel{.caption = caption,
                     .situation = situation,
                     .technique = "soft-volumes",
                     .settings = {{"method", "wedges"}, {"marking", marking}},
                     .timed = true};
    };
    const Situation torus{.scene = "torus"};
    paper.figures.push_back(
        {.id = "Figures 10 and 11",
         .title = "Pixels marked in the stencil before wedges are evaluated",
         .panels = {marked("two boxes, marked", boxes, "stencil"), marked("not marked", boxes, "none"),
                    marked("a torus, marked", torus, "stencil"), marked("not marked", torus, "none")},
         .claims = {{"marking costs less than it saves, of two boxes", Quantity::cost, 0, 1},
                    {"marking costs less than it saves, of a torus", Quantity::cost, 2, 3}},
         .note = "Every edge that may be a silhouette takes up to six draws, since how many are is not read "
                 "back. What a mark saves is an evaluation that finds nothing, which costs little: so it is "
                 "for few and large wedges."});
    paper.figures.push_back(
        {.id = "Figures 15 and 16",
         .title = "Lighting and colour added to the V-buffer",
         .panels = {{.caption = "visibility",
                     .situation = figureInCloth,
                     .technique = "soft-volumes",
                     .settings = published,
                     .show = Show::visibility},
                    {.caption = "times lighting and a texture",
                     .situation = figureInCloth,
                     .technique = "soft-volumes",
                     .settings = published}},
         .judged = false,
         .note = "A textured character of 4,672 triangles. Lighting and texture come in one pass here."});
    paper.figures.push_back(capping());
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
    paper.figures.push_back(screenshot("Figure 25", "A rectangular light",
                                       model("models/boat_viking_closed.glb", "two-boxes"),
                                       "A boat of 1,640 triangles."));
    paper.figures.push_back(screenshot("Figure 26", "Arbitrary shadow receivers", figureInCloth,
                                       "A character of 4,672 triangles, on itself."));
    paper.figures.push_back(screenshot("Figure 27", "Arbitrary shadow receivers",
                                       model("models/tree_lowpoly_closed.glb", "columns"),
                                       "A tree of 9,436 triangles, on itself."));
    paper.figures.push_back(screenshot("Figure 28", "Several shadow casters",
                                       model("models/horse_skinned.glb", "torus"),
                                       "A horse of 2,182 triangles in several closed parts."));
    paper.figures.push_back(
        screenshot("Figure 29", "A dynamic coloured light", {.scene = "moving", .time_s = 0.7}));
    paper.figures.push_back(screenshot("Chapter 5, overlapping edges", "Too much shadow where edges overlap",
                                       {.scene = "overlapping-blockers"},
                                       "The thesis admits it: wedges darken independently."));
    paper.leftOut = {
        {"Figures 1 and 2", "Diagrams of hard and soft shadows."},
        {"Figure 3", "A diagram of a wedge."},
        {"Figures 12 to 14", "Diagrams of coverage, which is in closed form here."},
        {"Section 3.1.1: Z-fail where the eye is in shadow",
         "The technique takes Z-pass or Z-fail by itself; that the eye's place changes nothing is tested, "
         "not shown."},
        {"Section 4.2.7: coverage of a textured rectangle from a table of four dimensions",
         "A table of two dimensions is enough here, what is radiated beyond a place in the direction from "
         "the light's "
         "centre, and edges are followed through it."},
        {"Section 4.4: one full buffer, drawn in part",
         "The thesis names two ways and builds the first, as we do: buffers of three sizes, chosen by "
         "frame_budget_ms."},
        {"Chapter 5: popping where the centre's silhouette changes",
         "It is seen in motion: `penumbra compare moving --flicker animation -t "
         "soft-volumes:method=wedges,soft-volumes` "
         "measures it."},
        {"Chapter 5: real-time frame rates, in games",
         "Of another machine; costs stand beside the figures that have them."},
        {"Chapter 6: shared depth buffers, lightmaps", "Future work there; depth is the host's here, once."}};
    return paper;
}

}  // namespace penumbra::studio
