// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

/// "map_size", "texels" -> "map size (texels)"; what follows ## tells widgets apart and is not shown.
std::string labelOf(const ParameterInfo& info) {
    std::string label(info.name);
    std::ranges::replace(label, '_', ' ');
    if (!info.unit.empty()) label += fmt::format(" ({})", info.unit);
    return fmt::format("{}##{}", label, info.name);
}

/// Draws the right widget for each parameter as the technique describes itself.
class ParameterWidgets final : public ParameterVisitor {
  public:
    ParameterWidgets(Ui& ui, const ParameterValues& defaults) : ui_(ui), defaults_(defaults) {}

    void boolean(const ParameterInfo& info, bool& value) override {
        changed_ |= ui_.checkbox(labelOf(info).c_str(), value);
        finish(info, value ? "true" : "false", [&](const std::string& text) { value = text == "true"; });
    }
    void integer(const ParameterInfo& info, int& value, Range<int> range) override {
        const bool wide = range.min >= 0 && range.max > 256;
        changed_ |= ui_.slider(labelOf(info).c_str(), value, range.min, range.max, wide);
        finish(info, fmt::format("{}", value), [&](const std::string& text) { value = std::stoi(text); });
    }
    void real(const ParameterInfo& info, float& value, Range<float> range) override {
        // A slider needs both ends near enough to be told apart.
        const bool slides =
            std::isfinite(range.min) && std::isfinite(range.max) && range.max - range.min <= 1000;
        changed_ |= slides ? ui_.slider(labelOf(info).c_str(), value, range.min, range.max)
                           : ui_.drag(labelOf(info).c_str(), value, 0.01f * std::max(1.0f, std::abs(value)),
                                      std::max(range.min, -1e30f), std::min(range.max, 1e30f));
        finish(info, fmt::format("{}", value), [&](const std::string& text) { value = std::stof(text); });
    }
    void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) override {
        const std::vector<std::string> all(names.begin(), names.end());
        changed_ |= ui_.combo(labelOf(info).c_str(), value, all);
        finish(info, all[std::size_t(value)],
               [&](const std::string& text) { value = int(std::ranges::find(all, text) - all.begin()); });
    }

    bool changed() const { return changed_; }

  private:
    /// The parameter's help, and a way back to its default where it has left it.
    template <typename Reset>
    void finish(const ParameterInfo& info, const std::string& value, const Reset& reset) {
        ui_.tip(info.help);
        const auto known =
            std::ranges::find(defaults_, info.name, [](const auto& entry) { return entry.first; });
        if (known == defaults_.end() || known->second == value) return;
        ImGui::SameLine();
        if (ui_.button(fmt::format("x##reset {}", info.name).c_str())) {
            reset(known->second);
            changed_ = true;
        }
        ui_.tip("back to " + known->second);
    }

    Ui& ui_;
    const ParameterValues& defaults_;
    bool changed_ = false;
};

void drawPresets(Ui& ui, Session& session, Settings& settings, WindowState& windowState,
                 const std::string& name) {
    auto& presets = settings.presets[name];
    std::vector<std::string> names = {"(the defaults)"};
    for (const auto& [preset, values] : presets) names.push_back(preset);
    const ParameterValues current = session.techniques().changes(name);
    int index = current.empty() ? 0 : -1;
    for (int i = 1; i < int(names.size()); ++i) {
        if (presets[names[std::size_t(i)]] == current) index = i;
    }
    if (ui.combo("preset", index, names)) {
        session.techniques().set(name, index == 0 ? ParameterValues() : presets[names[std::size_t(index)]]);
        session.changedLighting();
    }
    ImGui::SetNextItemWidth(120 * ui.scale());
    ui.text("##preset name", windowState.presetName);
    ImGui::SameLine();
    if (ui.button("Keep as preset") && !windowState.presetName.empty())
        presets[windowState.presetName] = current;
    ui.tip("Keeps the parameters under the name to the left. They are there again after a restart.");
    if (index > 0) {
        ImGui::SameLine();
        if (ui.button("Forget")) presets.erase(names[std::size_t(index)]);
    }
}

}  // namespace

std::vector<std::string> techniqueChoices() {
    std::vector<std::string> names;
    for (const TechniqueInfo& info : allTechniques()) names.emplace_back(info.name);
    return names;
}

void chooseTechnique(Session& session, const std::string& name) {
    session.choices().technique = name;
    session.changedLighting();
}

void chooseOther(Session& session, const std::string& name) {
    session.choices().other = name;
    session.changedLighting();
}

void drawTechniquePanel(Ui& ui, Session& session, Settings& settings, WindowState& windowState) {
    if (!ui.header("Technique")) return;
    const std::vector<std::string> names = techniqueChoices();
    int index = int(std::ranges::find(names, session.choices().technique) - names.begin());
    if (ui.combo("technique", index, names)) chooseTechnique(session, names[std::size_t(index)]);
    ui.tip("Keys 1 to 9; 0 is the reference");
    const std::string name = session.choices().technique;
    const std::vector<TechniqueInfo> infos = allTechniques();
    ui.note(std::string(infos[std::size_t(index)].summary));
    if (name == referenceName) return ui.note("Its rays are set under Compare.");

    Technique& technique = session.techniques().get(name);
    ImGui::PushID(name.c_str());
    ImGui::PushItemWidth(130 * ui.scale());
    ParameterWidgets widgets(ui, session.techniques().defaults(name));
    technique.describe(widgets);
    if (widgets.changed()) session.changedLighting();
    drawPresets(ui, session, settings, windowState, name);
    ImGui::PopItemWidth();
    ImGui::PopID();
}

}  // namespace penumbra::studio::viewer
