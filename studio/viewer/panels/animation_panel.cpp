// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {

void drawAnimationPanel(Ui& ui, Session& session, WindowState& windowState, const Recorder& recorder,
                        Requests& requests) {
    const Document& document = session.document();
    if (document.duration_s() <= 0) {
        windowState.playing = false;
        return;
    }
    if (!ui.header("Animation")) return;
    if (ui.button(windowState.playing ? "Pause" : "Play")) windowState.playing = !windowState.playing;
    ImGui::SameLine();
    float time_s = float(document.time_s());
    ImGui::SetNextItemWidth(-1);
    if (ui.slider("##time", time_s, 0, float(document.duration_s()), "%.2f s")) {
        windowState.playing = false;
        session.setTime(time_s);
    }
    ui.tip("Space plays and pauses; comma and full stop go one frame back and on");

    std::string folder = windowState.recording.folder.string();
    if (ui.text("folder", folder)) windowState.recording.folder = folder;
    ImGui::PushItemWidth(70 * ui.scale());
    int first = windowState.recording.first, last = windowState.recording.last;
    if (ImGui::DragInt("from", &first, 1, 0, 100000)) windowState.recording.first = first;
    ImGui::SameLine();
    if (ImGui::DragInt("to frame", &last, 1, 0, 100000)) windowState.recording.last = last;
    ImGui::SameLine();
    auto framesPerSecond = float(windowState.recording.framesPerSecond);
    if (ImGui::DragFloat("a second", &framesPerSecond, 1, 1, 240, "%.0f", ImGuiSliderFlags_AlwaysClamp)) {
        windowState.recording.framesPerSecond = framesPerSecond;
    }
    ImGui::PopItemWidth();
    if (!recorder.active()) {
        if (ui.button("Record")) requests.record = true;
    } else {
        if (ui.button("Stop recording")) requests.stopRecording = true;
        ImGui::SameLine();
        ImGui::ProgressBar(float(recorder.fraction()));
    }
}

}  // namespace penumbra::studio::viewer
