// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/panels/ui.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "studio/viewer/numbers.h"

namespace penumbra::studio::viewer {

bool Ui::placed(const char* label, bool result) {
    placed_.push_back({label, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    return result;
}

bool Ui::header(const char* label, bool open) {
    return placed(label, ImGui::CollapsingHeader(
                             label, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None));
}

bool Ui::button(const char* label) {
    return placed(label, ImGui::Button(label));
}

bool Ui::checkbox(const char* label, bool& value) {
    return placed(label, ImGui::Checkbox(label, &value));
}

bool Ui::radio(const char* label, bool chosen) {
    return placed(label, ImGui::RadioButton(label, chosen));
}

bool Ui::beginMenu(const char* label, bool enabled) {
    // Once a menu is open, the last item is one of its own.
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(label);
    placed_.push_back({label, at, {at.x + size.x, at.y + size.y}});
    return ImGui::BeginMenu(label, enabled);
}

bool Ui::selectable(const char* label, bool chosen) {
    return placed(label, ImGui::Selectable(label, chosen, ImGuiSelectableFlags_DontClosePopups));
}

bool Ui::menuItem(const char* label, const char* keys, bool chosen, bool enabled) {
    return placed(label, ImGui::MenuItem(label, keys, chosen, enabled));
}

bool Ui::combo(const char* label, int& index, const std::vector<std::string>& names) {
    const bool known = index >= 0 && index < int(names.size());
    const bool isOpen =
        ImGui::BeginCombo(label, known ? names[std::size_t(index)].c_str() : "", ImGuiComboFlags_HeightLarge);
    if (!isOpen) return placed(label, false);
    bool changed = false;
    for (int i = 0; i < int(names.size()); ++i) {
        if (placed(names[std::size_t(i)].c_str(),
                   ImGui::Selectable(names[std::size_t(i)].c_str(), i == index))) {
            changed = i != index;
            index = i;
        }
    }
    ImGui::EndCombo();
    return changed;
}

template <typename Number, typename Widget>
bool Ui::entered(const char* label, Number& value, const Widget& widget) {
    const ImGuiID id = ImGui::GetID(label);
    const int frame = ImGui::GetFrameCount();
    if (typing_ && typing_->frame < frame - 1) typing_.reset();  // it went away before it was entered
    const bool wasTyped = typing_ && typing_->id == id;
    Number shown = wasTyped ? Number(typing_->value) : value;
    const bool changed = placed(label, widget(shown));
    if (ImGui::TempInputIsActive(id)) {
        typing_ = Typing{id, frame, double(shown)};
        return false;
    }
    if (wasTyped) {
        typing_.reset();
        if (shown == value || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) return false;
    } else if (!changed) {
        return false;
    }
    value = shown;
    return true;
}

bool Ui::slider(const char* label, float& value, float min, float max, const char* format, bool logarithmic) {
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    constexpr int digits = 3;
    const std::string plain = plainFormat(std::max(std::abs(value), 0.01f * max), digits);
    return entered(label, value, [&](float& shown) {
        return ImGui::SliderFloat(label, &shown, min, max, format != nullptr ? format : plain.c_str(), flags);
    });
}

bool Ui::slider(const char* label, int& value, int min, int max, bool logarithmic) {
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    return entered(label, value,
                   [&](int& shown) { return ImGui::SliderInt(label, &shown, min, max, "%d", flags); });
}

bool Ui::drag(const char* label, float& value, float speed, float min, float max, const char* format) {
    const std::string plain = plainFormat(value);
    return entered(label, value, [&](float& shown) {
        return ImGui::DragFloat(label, &shown, speed, min, max, format != nullptr ? format : plain.c_str(),
                                ImGuiSliderFlags_AlwaysClamp);
    });
}

bool Ui::color(const char* label, glm::vec3& value) {
    const ImGuiID id = ImGui::GetID(label);
    const bool wasTyped = typedColor_ && typedColor_->first == id;
    glm::vec3 shown = wasTyped ? typedColor_->second : value;
    const bool changed = placed(label, ImGui::ColorEdit3(label, &shown[0], ImGuiColorEditFlags_Float));
    if (ImGui::IsItemActive() && ImGui::GetIO().WantTextInput) {
        typedColor_ = std::pair(id, shown);
        return false;
    }
    if (wasTyped) typedColor_.reset();
    if (!changed && (!wasTyped || shown == value)) return false;
    value = shown;
    return true;
}

bool Ui::text(const char* label, std::string& value) {
    return placed(label, ImGui::InputText(label, &value));
}

void Ui::note(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

void Ui::tip(std::string_view text) {
    if (text.empty() || !ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(360 * scale_);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace penumbra::studio::viewer
