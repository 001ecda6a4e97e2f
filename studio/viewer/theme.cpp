// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/theme.h"

#include <imgui.h>

#include <cmath>
#include <filesystem>

namespace penumbra::studio::viewer {
namespace {

/// The system's own font; Dear ImGui's built-in bitmap font where it is missing.
void addFont(float scale) {
    constexpr const char* file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    static const ImWchar ranges[] = {0x20, 0xff, 0x2190, 0x21ff, 0x25a0, 0x25ff, 0};  // Latin, arrows, shapes
    std::error_code error;
    if (std::filesystem::exists(file, error)) {
        fonts.AddFontFromFileTTF(file, std::round(14 * scale), nullptr, ranges);
    } else {
        ImFontConfig config;
        config.SizePixels = std::round(13 * scale);
        fonts.AddFontDefault(&config);
    }
}

}  // namespace

void applyTheme(float scale) {
    addFont(scale);
    ImGuiStyle& style = ImGui::GetStyle();
    ImGui::StyleColorsDark();
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.WindowBorderSize = 0;
    style.WindowPadding = {10, 8};
    style.ItemSpacing = {7, 5};
    style.ScaleAllSizes(scale);

    const ImVec4 panel(0.105f, 0.11f, 0.125f, 1), field(0.17f, 0.18f, 0.205f, 1),
        accent(0.93f, 0.68f, 0.27f, 1);
    const auto tinted = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_WindowBg] = panel;
    colors[ImGuiCol_PopupBg] = {0.13f, 0.135f, 0.15f, 0.98f};
    colors[ImGuiCol_TitleBgActive] = {0.085f, 0.09f, 0.1f, 1};
    colors[ImGuiCol_MenuBarBg] = {0.085f, 0.09f, 0.1f, 1};
    colors[ImGuiCol_FrameBg] = field;
    colors[ImGuiCol_FrameBgHovered] = {0.22f, 0.235f, 0.265f, 1};
    colors[ImGuiCol_FrameBgActive] = {0.26f, 0.275f, 0.31f, 1};
    colors[ImGuiCol_Button] = {0.2f, 0.215f, 0.245f, 1};
    colors[ImGuiCol_ButtonHovered] = tinted(0.45f);
    colors[ImGuiCol_ButtonActive] = tinted(0.7f);
    colors[ImGuiCol_Header] = {0.155f, 0.165f, 0.19f, 1};
    colors[ImGuiCol_HeaderHovered] = tinted(0.3f);
    colors[ImGuiCol_HeaderActive] = tinted(0.45f);
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = tinted(0.75f);
    colors[ImGuiCol_SliderGrabActive] = accent;
    colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_PlotLines] = accent;
    colors[ImGuiCol_TextDisabled] = {0.58f, 0.6f, 0.64f, 1};
}

}  // namespace penumbra::studio::viewer
