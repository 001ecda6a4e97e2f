// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

struct Row {
    const char* keys;
    const char* what;
};

constexpr Row rows[] = {
    {"left drag", "turn around what is looked at"},
    {"wheel, middle drag", "nearer and farther, sideways"},
    {"right drag + W A S D Q E", "fly; Shift is faster"},
    {"click", "ask about a pixel; Esc lets go"},
    {"F, R, B", "frame all, back to the scene's camera, keep this view"},
    {"1 ... 9, 0", "technique, with the mouse over the picture; 0 is the ray-traced reference"},
    {"E, A", "exact, auto"},
    {"Shift + 1 ... 9, 0, E, A", "what it is compared with"},
    {"M", "place a grid to measure on: drag over a surface"},
    {"C, hold Tab", "wipe between the two, flip to the other"},
    {"P, X, Y, V, I", "picture, difference, its amount, visibility, illuminance"},
    {"G, T, S, L", "move, turn, resize lights by hand; next light"},
    {"Ctrl while dragging a light", "in steps of 0.1 m or 15 degrees"},
    {"Ctrl+D, Delete", "double a light, take it away"},
    {"Space, comma, full stop", "play or pause, a frame back, a frame on"},
    {"Ctrl+Z, Ctrl+Shift+Z", "undo and redo what was done to lights, techniques, kept views and grids"},
    {"Ctrl+S, Ctrl+Shift+S, Ctrl+C", "save the lights, save them as ..., copy the command for this picture"},
    {"F2, F3", "save the picture, save what is shown"},
    {"Ctrl+O, drop a file", "open a scene"},
    {"F1, F5, H or ?", "panel, read shaders again, this page"},
};

}  // namespace

void drawHelp(Ui& ui, WindowState& windowState) {
    if (!windowState.showsHelp) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("Keys and mouse", &windowState.showsHelp,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    if (ImGui::BeginTable("keys", 2)) {
        for (const Row& row : rows) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(row.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", row.what);
        }
        ImGui::EndTable();
    }
    if (ui.button("Close help")) windowState.showsHelp = false;
    ImGui::End();
}

}  // namespace penumbra::studio::viewer
