// SPDX-License-Identifier: Apache-2.0
// Recipes name only what there is, and the reproduction says what there is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "studio/papers/paper_report.h"
#include "studio/scene/builtin/builtin.h"

namespace penumbra::studio {
namespace {

std::vector<Paper> papers() {
    return {kirsch2003(), thesis(), smoothies2003(), schwaerzler2012()};
}

std::set<std::string> builtinNames() {
    std::set<std::string> names;
    for (const BuiltinInfo& info : builtinScenes()) names.emplace(info.name);
    return names;
}

TEST(Recipes, NameScenesAndPanelsThatExist) {
    const std::set<std::string> scenes = builtinNames();
    for (const Paper& paper : papers()) {
        for (const Figure& figure : paper.figures) {
            SCOPED_TRACE(paper.name + " " + figure.id);
            for (const Panel& panel : figure.panels) {
                EXPECT_TRUE(scenes.contains(panel.situation.scene)) << panel.situation.scene;
                EXPECT_FALSE(panel.caption.empty());
                EXPECT_EQ(panel.show == Show::buffer, !panel.buffer.empty());
                EXPECT_LT(panel.against.value_or(0), figure.panels.size());
                EXPECT_LT(panel.base.value_or(0), figure.panels.size());
            }
            for (const Claim& claim : figure.claims) {
                ASSERT_LT(claim.less, figure.panels.size());
                ASSERT_LT(claim.more, figure.panels.size());
                // A claim about cost needs both panels' costs.
                for (const std::size_t panel : {claim.less, claim.more}) {
                    EXPECT_TRUE(claim.quantity != Quantity::cost || figure.panels[panel].timed ||
                                figure.panels[panel].paper)
                        << claim.text;
                    EXPECT_TRUE(claim.quantity != Quantity::penumbraError || figure.judged) << claim.text;
                }
            }
        }
        for (const Table& table : paper.tables) {
            for (const Cell& cell : table.cells) {
                EXPECT_TRUE(scenes.contains(cell.situation.scene)) << cell.situation.scene;
                EXPECT_GT(cell.paper, 0);
                EXPECT_TRUE(table.baselineRow.empty() ||
                            std::ranges::any_of(table.cells, [&](const Cell& other) {
                                return other.row == table.baselineRow && other.column == cell.column;
                            }));
            }
        }
    }
}

TEST(Recipes, NameTechniquesAndParametersThatExist) {
    Workbench workbench;
    for (const Paper& paper : papers()) {
        const auto check = [&](const std::string& name, const Settings& settings) {
            const std::unique_ptr<Technique> technique = workbench.makeTechnique(name);
            for (const auto& [key, value] : settings)
                EXPECT_NO_THROW(setParameter(*technique, key, value)) << key;
        };
        for (const Figure& figure : paper.figures)
            for (const Panel& panel : figure.panels) check(panel.technique, panel.settings);
        for (const Table& table : paper.tables)
            for (const Cell& cell : table.cells) check(cell.technique, cell.settings);
    }
}

/// Of figures and tables alone.
Paper paperOf(std::vector<Figure> figures, std::vector<Table> tables = {}) {
    return {.name = "paper",
            .citation = "none",
            .hardware = "none",
            .figures = std::move(figures),
            .tables = std::move(tables)};
}

const ReproductionOptions tiny{.size = {48, 27}, .samples = 4, .rounds = 1};

TEST(Reproduction, SaysNotYetForWhatIsMissing) {
    const Situation boxes{.scene = "two-boxes"};
    const Paper paper = paperOf(
        {{.id = "Figure 1",
          .title = "missing things",
          .panels = {{.caption = "technique", .situation = boxes, .technique = "magic", .paper = 1},
                     {.caption = "parameter",
                      .situation = boxes,
                      .technique = "hard",
                      .settings = {{"magic", "1"}}},
                     {.caption = "buffer",
                      .situation = boxes,
                      .technique = "hard",
                      .show = Show::buffer,
                      .buffer = "magic"},
                     {.caption = "there", .situation = boxes, .technique = "hard", .timed = true}},
          .claims = {{"nothing costs less", Quantity::cost, 0, 3}}}},
        {{.id = "Table 1",
          .title = "missing, too",
          .unit = "ms",
          .cells = {{.row = "r", .column = "c", .situation = boxes, .technique = "hard", .paper = 1},
                    {.row = "s", .column = "c", .situation = boxes, .technique = "magic", .paper = 2}}}});
    Workbench workbench;
    const PaperResult result = reproduce(workbench, paper, tiny);
    const std::vector<PanelResult>& panels = result.figures[0].panels;
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(panels[i].missing.starts_with("not yet")) << panels[i].missing;
    EXPECT_TRUE(panels[3].missing.empty());
    EXPECT_GT(panels[3].cost_ms.value().median, 0);
    EXPECT_EQ(panels[3].image.width_px, 48);
    EXPECT_FALSE(result.figures[0].claims[0].ours.has_value());
    EXPECT_TRUE(result.tables[0].cells[1].missing.starts_with("not yet"));
    EXPECT_DOUBLE_EQ(result.tables[0].cells[0].ours, 1);
    EXPECT_DOUBLE_EQ(result.tables[0].cells[1].paper, 2);
    const std::string page = toHtml(result, thisMachine(workbench), tiny, "command");
    EXPECT_NE(page.find("not yet"), std::string::npos);
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
}

TEST(Reproduction, JudgesClaimsByTheNumbers) {
    const Situation plane{.scene = "half-plane"};
    const Paper paper =
        paperOf({{.id = "Figure 1",
                  .title = "a half-plane",
                  .panels = {{.caption = "hard", .situation = plane, .technique = "hard"},
                             {.caption = "pcss", .situation = plane, .technique = "pcss"}},
                  .claims = {{"soft is nearer to the truth", Quantity::penumbraError, 1, 0},
                             {"hard is nearer to the truth", Quantity::penumbraError, 0, 1}}}});
    Workbench workbench;
    const PaperResult result = reproduce(workbench, paper, {.size = {48, 27}, .samples = 64, .rounds = 1});
    EXPECT_TRUE(result.figures[0].claims[0].holds());
    EXPECT_FALSE(result.figures[0].claims[1].holds());
    EXPECT_NE(judgements(result).find("Does not hold here: hard"), std::string::npos) << judgements(result);
}

TEST(Reproduction, AClaimHoldsNearThePapersRatioNotWheneverLess) {
    const ClaimResult near{.text = "t", .ours = 0.5, .paper = 0.4};
    EXPECT_TRUE(near.holds());
    // Faster than the paper says is another number than the paper's.
    const ClaimResult better{.text = "t", .ours = 0.1, .paper = 0.4};
    EXPECT_FALSE(better.holds());
    EXPECT_TRUE(better.hasOrder());
    const ClaimResult wider{.text = "t", .ours = 0.1, .paper = 0.4, .factor = 5};
    EXPECT_TRUE(wider.holds());
    const ClaimResult broken{.text = "t", .ours = 0.5, .paper = {}, .isBroken = true};
    EXPECT_FALSE(broken.holds());
    EXPECT_FALSE((ClaimResult{.text = "t", .ours = {}, .paper = {}}).holds());
}

TEST(Reproduction, CountsMapsAndSharesOfPasses) {
    const Situation boxes{.scene = "two-boxes"};
    const Settings published = {{"published", "true"}, {"map_size", "64"}};
    Settings corners = published;
    corners.emplace_back("max_depth", "0");
    const Paper paper = paperOf(
        {{.id = "Figure 1",
          .title = "t",
          .panels = {{.caption = "a", .situation = boxes, .technique = "adaptive", .settings = published}},
          .claims = {{.text = "comparing takes a part",
                      .quantity = Quantity::passShare,
                      .less = 0,
                      .factor = 100,
                      .pass = "queries",
                      .paper = 0.3}},
          .judged = false}},
        {{.id = "Table 1",
          .title = "t",
          .unit = "maps",
          .cells = {{"all", "c", boxes, "adaptive", published, 289},
                    {"corners", "c", boxes, "adaptive", corners, 4}}}});
    Workbench workbench;
    const PaperResult result = reproduce(workbench, paper, tiny);
    const ClaimResult& share = result.figures[0].claims[0];
    ASSERT_TRUE(share.ours.has_value());
    EXPECT_GT(*share.ours, 0);
    EXPECT_LT(*share.ours, 1);
    EXPECT_EQ(result.tables[0].cells[1].ours, 4);
    EXPECT_NE(judgements(result).find("Nearest to the paper's: corners, 4"), std::string::npos)
        << judgements(result);
}

TEST(Reproduction, SkipsPlacesInModelsThatAreNotThere) {
    const Situation place{.scene = "two-boxes",
                          .model = "models/nowhere.glb",
                          .placement = Placement{.eye = {1, 1, 1}, .target = {0, 0, 0}}};
    const Paper paper = paperOf({{.id = "Figure 1",
                                  .title = "t",
                                  .panels = {{.caption = "c", .situation = place, .technique = "hard"}}}},
                                {{.id = "Table 1",
                                  .title = "t",
                                  .unit = "maps",
                                  .cells = {{"row", "column", place, "adaptive", {}, 1}}}});
    Workbench workbench;
    const PaperResult result = reproduce(workbench, paper, tiny);
    EXPECT_NE(result.figures[0].panels[0].missing.find("models/nowhere.glb"), std::string::npos);
    EXPECT_NE(result.tables[0].cells[0].missing.find("models/nowhere.glb"), std::string::npos);
    EXPECT_TRUE(result.figures[0].standIns.empty());
}

TEST(Reproduction, ShowsOfTheLightsBuffersWhatIsInThem) {
    const Paper paper = paperOf({{.id = "Figure 1",
                                  .title = "a sphere, small in its map",
                                  .panels = {{.caption = "depth map",
                                              .situation = {.scene = "sphere"},
                                              .technique = "shadow-width",
                                              .show = Show::buffer,
                                              .buffer = "depth map"}},
                                  .judged = false}});
    Workbench workbench;
    const PaperResult result = reproduce(workbench, paper, tiny);
    const Image& picture = result.figures[0].panels[0].image;
    EXPECT_NEAR(double(picture.width_px) / picture.height_px, 48.0 / 27, 0.02) << "whole texels";
    // A disk across 1 / 1.15 of the height, in a picture of 16:9.
    const auto shown = std::ranges::count_if(picture.values, [](float value) { return value > 0; });
    EXPECT_NEAR(double(shown) / double(picture.pixelCount()), 0.785 / (1.15 * 1.15) * 9 / 16, 0.03);
}

TEST(Reproduction, SaysWhatStandsInForAModel) {
    const Situation model{.scene = "two-boxes", .model = "models/nowhere.glb"};
    const Paper paper = paperOf({{.id = "Figure 1",
                                  .title = "t",
                                  .panels = {{.caption = "c", .situation = model, .technique = "hard"}}}});
    Workbench workbench;
    const PaperResult result = reproduce(workbench, paper, tiny);
    EXPECT_EQ(result.figures[0].standIns, std::vector<std::string>{"two-boxes for models/nowhere.glb"});
}

}  // namespace
}  // namespace penumbra::studio
