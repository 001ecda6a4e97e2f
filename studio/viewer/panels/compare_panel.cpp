// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

void drawReference(Ui& ui, Session& session) {
    Choices& choices = session.choices();
    if (ui.checkbox("ray-trace in the background", choices.referenceRuns)) session.changedView();
    ImGui::SetNextItemWidth(130 * ui.scale());
    if (ui.slider("rays a pixel", choices.referenceSamples, 4, 65536, true)) session.changedView();
    const ProgressiveReference::Status status = session.reference().status();
    const auto truth = session.truth();
    std::string said =
        truth ? fmt::format("truth so far: {} rays a pixel", truth->samples) : std::string("truth: none yet");
    if (truth && session.choices().light < truth->lights.size()) {
        said += fmt::format(", noise {:.4f}", truth->lights[session.choices().light].noise_rms);
    }
    ui.note(said);
    if (!status.error.empty()) return ui.note("ray tracing failed: " + status.error);
    ImGui::ProgressBar(status.working ? float(status.fraction)
                       : truth        ? 1.0f
                                      : 0.0f,
                       {-1, 6 * ui.scale()}, "");
}

/// The table of `compare`, for both sides.
void drawMetrics(Ui& ui, const Session& session) {
    const std::vector<Light>& lights = session.document().moment().lights;
    if (session.choices().light >= lights.size()) return;
    ui.note(fmt::format("error against the truth, light '{}'", lights[session.choices().light].name));
    if (!ImGui::BeginTable("errors", 3, ImGuiTableFlags_SizingStretchSame)) return;
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(session.techniqueOf(lights[session.choices().light]).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(session.choices().other.c_str());
    const auto row = [&](const char* name, double VisibilityMetrics::*member) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", name);
        for (std::size_t side = 0; side < 2; ++side) {
            ImGui::TableNextColumn();
            const auto& metrics = session.metrics(side);
            const std::string text = metrics ? fmt::format("{:.4f}", (*metrics).*member) : "-";
            // Grey: the truth's own noise is as large as a tenth of it, or larger.
            if (metrics && session.isCertain((*metrics).*member))
                ImGui::TextUnformatted(text.c_str());
            else
                ImGui::TextDisabled("%s", text.c_str());
        }
    };
    row("rmse", &VisibilityMetrics::rmse);
    row("penumbra", &VisibilityMetrics::penumbra_rmse);
    row("p99", &VisibilityMetrics::p99);
    row("max", &VisibilityMetrics::max);
    row("leak", &VisibilityMetrics::leak);
    row("false shadow", &VisibilityMetrics::false_shadow);
    ImGui::EndTable();
}

void drawExposure(Ui& ui, Session& session) {
    std::optional<float>& value = session.choices().exposureValue;
    bool isAutomatic = !value;
    if (ui.checkbox("automatic exposure", isAutomatic)) {
        value = isAutomatic ? std::nullopt : std::optional(session.exposureValue());
        session.changedLighting();
    }
    ui.tip("Off: brightness stays as it is now, however lights and view change");
    if (value && ui.slider("exposure (EV)", *value, -10, 20, "%.2f")) session.changedLighting();
}

}  // namespace

void drawComparePanel(Ui& ui, Session& session) {
    if (!ui.header("Compare")) return;
    Choices& choices = session.choices();
    if (ui.checkbox("wipe between two (C)", choices.comparing)) session.changedCanvas();
    const std::vector<std::string> names = techniqueChoices();
    int index = int(std::ranges::find(names, choices.other) - names.begin());
    ImGui::SetNextItemWidth(150 * ui.scale());
    if (ui.combo("with", index, names)) chooseOther(session, names[std::size_t(index)]);
    ui.tip("The right side. Hold Tab to see it whole. Shift and a number choose it too.");
    drawReference(ui, session);
    drawMetrics(ui, session);
}

void drawColorsPanel(Ui& ui, Session& session) {
    if (!ui.header("Show")) return;
    Choices& choices = session.choices();
    const auto radio = [&](const char* label, Shown shown) {
        if (!ui.radio(label, choices.shown == shown) || choices.shown == shown) return;
        choices.shown = shown;
        session.changedCanvas();
        if (shown == Shown::illuminance) session.fitIlluminance();
    };
    radio("Picture (P)", Shown::picture);
    radio("Difference, A - B (X)", Shown::difference);
    radio("Amount of the difference (Y)", Shown::error);
    radio("Visibility (V)", Shown::visibility);
    radio("Illuminance (I)", Shown::illuminance);
    ImGui::PushItemWidth(130 * ui.scale());
    if (choices.shown == Shown::picture) drawExposure(ui, session);
    if (choices.shown == Shown::difference || choices.shown == Shown::error) {
        if (ui.slider("colours end at", choices.differenceRange, 0.005f, 1, "%.3f", true))
            session.changedCanvas();
    }
    if (choices.shown == Shown::illuminance) {
        float lux = session.canvasOptions().range.max;
        if (ui.drag("colours end at (lux)", lux, 0.01f * lux, 0.1f, 1e6f)) {
            choices.largestLux = lux;
            session.changedCanvas();
        }
        if (ui.button("Fit")) {
            choices.largestLux = 0;
            session.fitIlluminance();
        }
        ImGui::SameLine();
        if (ui.checkbox("logarithmic", choices.logarithmic)) session.fitIlluminance();
        ImGui::SameLine();
        if (ui.checkbox("isolines", choices.isolines)) session.changedCanvas();
    }
    ImGui::PopItemWidth();
}

}  // namespace penumbra::studio::viewer
