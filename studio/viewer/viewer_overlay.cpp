// SPDX-License-Identifier: Apache-2.0
// The canvas and what is written over it.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "studio/metrics/false_color.h"
#include "studio/viewer/grid_overlay.h"
#include "studio/viewer/numbers.h"
#include "studio/viewer/viewer.h"

#include <GLFW/glfw3.h>

namespace penumbra::studio::viewer {
namespace {

constexpr ImU32 white = IM_COL32(255, 255, 255, 255);

/// Text on a dark box, so that it reads over whatever is shown.
void boxed(ImDrawList& list, ImVec2 at, const std::string& text, float scale, float alignX = 0,
           ImU32 background = IM_COL32(12, 13, 16, 200)) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = 6 * scale;
    at.x -= alignX * (size.x + 2 * pad);
    list.AddRectFilled(at, {at.x + size.x + 2 * pad, at.y + size.y + pad}, background, 4 * scale);
    list.AddText({at.x + pad, at.y + 0.5f * pad}, white, text.c_str());
}

/// Values at which a legend has its marks.
std::vector<float> marksOf(const CanvasOptions& options) {
    if (options.logarithmic) return niceLevels(options.range.min, options.range.max);
    std::vector<float> marks;
    for (int i = 0; i <= 4; ++i) {
        marks.push_back(options.range.min + 0.25f * float(i) * (options.range.max - options.range.min));
    }
    return marks;
}

float placeOf(float value, const CanvasOptions& options) {
    const auto [min, max] = options.range;
    return options.logarithmic ? std::log(value / min) / std::log(max / min) : (value - min) / (max - min);
}

/// What the colours mean; a difference is `left` minus `right`.
std::string titleOf(Shown shown, const std::string& light, const std::string& left,
                    const std::string& right) {
    switch (shown) {
        case Shown::picture:
            break;
        case Shown::difference:
            return fmt::format("visibility of '{}', {} minus {}", light, left, right);
        case Shown::error:
            return fmt::format("visibility of '{}', how far {} and {} differ", light, left, right);
        case Shown::visibility:
            return fmt::format("visibility of '{}'", light);
        case Shown::illuminance:
            return "illuminance (lux)";
    }
    return "";
}

}  // namespace

void Viewer::drawCanvas() {
    const gl::Texture& canvas = session_.shown();
    if (canvas.name() == 0) return;
    ImGui::GetBackgroundDrawList()->AddImage(imageId(canvas), place_.min,
                                             {place_.min.x + place_.size.x, place_.min.y + place_.size.y},
                                             {0, 1}, {1, 0});
    drawGridOverlay(place_, session_, ui_.scale());
    mouse_.draw(place_, session_, windowState_, ui_.scale());
}

void Viewer::drawOverlay() {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float scale = ui_.scale(), line = ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 min = place_.min, max(min.x + place_.size.x, min.y + place_.size.y);
    const Choices& choices = session_.choices();
    const auto named = [&](std::size_t side, const std::string& technique) {
        std::string text = technique;
        if (technique == referenceName) {
            text += session_.truth() ? fmt::format(", {} rays", session_.truth()->samples) : ", tracing ...";
        } else if (const auto& metrics = session_.metrics(side)) {
            text += session_.isCertain(metrics->rmse)
                        ? fmt::format(", rmse {:.4f}", metrics->rmse)
                        : fmt::format(", rmse about {:.4f} so far", metrics->rmse);
        }
        return text;
    };
    const float margin = 10 * scale;
    // Beneath a legend, which takes the middle.
    const float top = min.y + margin + (choices.shown == Shown::picture ? 0 : 80 * scale);
    if (choices.flipped) {
        boxed(list, {min.x + margin, top}, named(1, choices.other), scale);
    } else {
        boxed(list, {min.x + margin, top}, named(0, choices.technique), scale);
        if (choices.comparing) boxed(list, {max.x - margin, top}, named(1, choices.other), scale, 1);
    }
    drawIsolineNumbers();
    drawLegend();
    if (const auto& pick = session_.picker().result(); pick && pick->hasSurface) {
        std::string text = plainNumber(pick->illuminance_lux) + " lux";
        if (pick->truth) text += fmt::format("\nvisibility {:.3f}", *pick->truth);
        boxed(list,
              {min.x + (float(pick->x) + 0.5f) / float(session_.width_px()) * place_.size.x + 12 * scale,
               min.y + (float(pick->y) + 0.5f) / float(session_.height_px()) * place_.size.y - 10 * scale},
              text, scale);
    }

    float y = max.y - margin - line;
    const auto write = [&](const std::string& text, ImU32 background) {
        y -= ImGui::CalcTextSize(text.c_str()).y;
        boxed(list, {min.x + margin, y}, text, scale, 0, background);
        y -= 8 * scale;
    };
    if (windowState_.showsWelcome) {
        write(
            "Drag to turn, wheel to come nearer, right button and WASD to fly\n"
            "1 to 9 choose the technique; C compares it with the ray-traced truth\n"
            "Drop a glTF file to open it; H shows every key",
            IM_COL32(12, 13, 16, 215));
    }
    if (!windowState_.message.empty() && glfwGetTime() < windowState_.messageUntil_s) {
        write(windowState_.message + (windowState_.messageIsError ? "\n(Esc closes this)" : ""),
              windowState_.messageIsError ? IM_COL32(120, 24, 20, 230) : IM_COL32(28, 60, 34, 225));
    }
    if (!session_.problem().empty()) write(session_.problem(), IM_COL32(120, 24, 20, 230));
    if (!session_.shaderProblem().empty()) {
        write("The last good shaders are in use:\n" + session_.shaderProblem(), IM_COL32(120, 24, 20, 230));
    }
}

void Viewer::drawIsolineNumbers() {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const IsolineNumber& number : session_.isolineNumbers()) {
        const std::string text = plainNumber(number.lux, 2);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const float x = place_.min.x + (float(number.x) + 0.5f) / float(session_.width_px()) * place_.size.x;
        const float y = place_.min.y + (float(number.y) + 0.5f) / float(session_.height_px()) * place_.size.y;
        const float pad = 2 * ui_.scale();
        const ImVec2 at(x - 0.5f * size.x, y - 0.5f * size.y);
        if (at.x < place_.min.x) continue;
        list.AddRectFilled({at.x - pad, at.y}, {at.x + size.x + pad, at.y + size.y},
                           IM_COL32(12, 13, 16, 190), 3 * ui_.scale());
        list.AddText(at, white, text.c_str());
    }
}

void Viewer::drawLegend() {
    const CanvasOptions options = session_.canvasOptions();
    if (options.shown == Shown::picture) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float scale = ui_.scale(), line = ImGui::GetTextLineHeight();
    const float width = std::min(360 * scale, place_.size.x - 60 * scale), height = 14 * scale;
    const ImVec2 at(place_.min.x + 0.5f * (place_.size.x - width), place_.min.y + 14 * scale + line);
    list.AddRectFilled({at.x - 22 * scale, place_.min.y + 6 * scale},
                       {at.x + width + 22 * scale, at.y + height + line + 10 * scale},
                       IM_COL32(12, 13, 16, 215), 4 * scale);
    const bool diverging = options.shown == Shown::difference;
    const ColorTable colors = diverging ? divergingColors() : orderedColors();
    for (std::size_t i = 0; i < 256; ++i) {
        const float x0 = at.x + width * float(i) / 256, x1 = at.x + width * float(i + 1) / 256;
        list.AddRectFilled({x0, at.y}, {x1 + 0.5f, at.y + height},
                           IM_COL32(colors[4 * i], colors[4 * i + 1], colors[4 * i + 2], 255));
    }
    CanvasOptions scaleOf = options;
    if (diverging) scaleOf.range = {-options.range.max, options.range.max};
    float freeFrom = -1e9f;
    for (const float mark : marksOf(scaleOf)) {
        const float x = at.x + width * placeOf(mark, scaleOf);
        const std::string text = plainNumber(mark, 3);
        const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
        list.AddLine({x, at.y + height}, {x, at.y + height + 3 * scale}, white);
        if (x - half < freeFrom) continue;
        list.AddText({x - half, at.y + height + 3 * scale}, white, text.c_str());
        freeFrom = x + half + 4 * scale;
    }
    const std::vector<Light>& lights = session_.document().moment().lights;
    const bool known = options.light < lights.size();
    const std::string title =
        titleOf(options.shown, known ? lights[options.light].name : "",
                known ? session_.techniqueOf(lights[options.light]) : "", session_.choices().other);
    list.AddText({place_.min.x + 0.5f * (place_.size.x - ImGui::CalcTextSize(title.c_str()).x),
                  place_.min.y + 9 * scale},
                 white, title.c_str());
}

}  // namespace penumbra::studio::viewer
