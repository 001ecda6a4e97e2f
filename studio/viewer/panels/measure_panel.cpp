// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "studio/measure/measured_files.h"
#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

constexpr int mostCells = 200;  // along a side

void editGrid(Ui& ui, GridSpec& spec) {
    ImGui::PushItemWidth(130 * ui.scale());
    auto above_m = float(spec.above_m);
    if (ui.drag("above the surface (m)", above_m, 0.01f, 0, 1000)) spec.above_m = above_m;
    ui.tip("0.75 or 0.8: the height of desks");
    ui.slider("cells across", spec.columns, 1, mostCells, true);
    ui.slider("cells along", spec.rows, 1, mostCells, true);
    ui.checkbox("numbers on the cells", spec.showsNumbers);
    ui.checkbox("hours of sun over a day", spec.ofSunHours);
    ui.tip("Of the light that is the sun of a place and time: how long half of its disk is seen");
    if (spec.ofSunHours) ui.text("from-to/step", spec.over);
    ImGui::PopItemWidth();
}

}  // namespace

void drawMeasurePanel(Ui& ui, Session& session, WindowState& windowState) {
    if (!ui.header("Measure")) return;
    std::optional<GridSpec>& spec = session.choices().grid;
    if (ui.button(windowState.placesGrid ? "Now drag over a surface" : "Place a grid (M)"))
        windowState.placesGrid = !windowState.placesGrid;
    ui.tip("Then drag over a surface, from corner to corner");
    if (!spec) return;
    ImGui::SameLine();
    if (ui.button("Remove")) {
        spec.reset();
        return;
    }
    editGrid(ui, *spec);
    const MeasuredGrid& grid = session.grid();
    if (!grid.problem().empty()) ui.note(grid.problem());
    const Measurement* const measured = grid.measurement();
    if (measured == nullptr) return;
    ui.note(summaryText(*measured));
    if (!measured->times.empty()) ui.note(sunText(*measured));
    if (grid.isRough()) ui.note("with few samples while hands move");
    if (ui.button("Save as table or plan ..."))
        windowState.browser.open(FileBrowser::Wanted::grid, gridPathOf(session.document()));
}

}  // namespace penumbra::studio::viewer
