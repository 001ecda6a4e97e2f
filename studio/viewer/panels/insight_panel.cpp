// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "studio/viewer/numbers.h"
#include "studio/viewer/panels/panels.h"
#include "studio/workbench/settle.h"

namespace penumbra::studio::viewer {
namespace {

void drawTimes(Ui& ui, const Session& session, const std::vector<float>& frameTimes_ms) {
    const Percentiles times = percentilesOf(frameTimes_ms);
    const std::string overlay =
        fmt::format("median {:.1f}  p95 {:.1f}  p99 {:.1f} ms", times.p50, times.p95, times.p99);
    ImGui::PlotLines("##frame times", frameTimes_ms.data(), int(frameTimes_ms.size()), 0, overlay.c_str(), 0,
                     std::max(1.2f * times.p99, 1.0f), {ImGui::GetContentRegionAvail().x, 56 * ui.scale()});
    ui.note(fmt::format("{}x{} in {:.1f} ms on {}", session.width_px(), session.height_px(),
                        session.milliseconds(), session.device().renderer()));
}

void drawPasses(const Session& session) {
    for (const LightStatistics& light : session.side(0).statistics) {
        const Statistics& statistics = light.statistics;
        if (statistics.passes.empty() && statistics.counts.empty()) continue;
        if (!ImGui::TreeNodeEx(light.light.c_str(), ImGuiTreeNodeFlags_DefaultOpen, "%s: %s",
                               light.light.c_str(), light.technique.c_str())) {
            continue;
        }
        if (const std::string chosen = describe(statistics.chosen); !chosen.empty())
            ImGui::TextUnformatted(("takes " + chosen).c_str());
        double total_ms = 0;
        for (const PassTime& pass : statistics.passes) total_ms += pass.milliseconds;
        for (const PassTime& pass : statistics.passes) {
            const double share = total_ms > 0 ? pass.milliseconds / total_ms : 0;
            ImGui::ProgressBar(float(share), {-1, 0},
                               fmt::format("{}  {:.2f} ms", pass.name, pass.milliseconds).c_str());
        }
        for (const Statistic& count : statistics.counts) {
            ImGui::TextDisabled(
                "%s", fmt::format("{}: {} {}", count.name, plainNumber(count.value), count.unit).c_str());
        }
        ImGui::TreePop();
    }
}

void drawBuffers(Ui& ui, Session& session, WindowState& windowState) {
    const std::vector<InspectedTexture> buffers = session.inspected();
    std::vector<std::string> names;
    for (const InspectedTexture& buffer : buffers) names.emplace_back(buffer.name);
    windowState.buffer = std::min(windowState.buffer, names.empty() ? 0 : names.size() - 1);
    int index = int(windowState.buffer);
    ImGui::SetNextItemWidth(-1);
    if (ui.combo("##buffer", index, names)) windowState.buffer = std::size_t(index);
    ui.tip("What the technique of the light in question left behind, and the frame's own buffers");
    if (windowState.buffer < buffers.size() && buffers[windowState.buffer].layers > 1) {
        ui.slider("layer", windowState.bufferLayer, 0, buffers[windowState.buffer].layers - 1);
    } else {
        windowState.bufferLayer = 0;
    }
    if (windowState.buffer >= buffers.size()) return;
    ui.checkbox("stretch to what is in it", windowState.bufferStretched);
    session.inspect(buffers[windowState.buffer], windowState.bufferLayer, windowState.bufferStretched);
    const gl::Texture& shown = session.inspection().texture();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = std::min(width * float(shown.height_px()) / float(shown.width_px()), 1.2f * width);
    ImGui::Image(imageId(shown), {width, height}, {0, 1}, {1, 0});
    ui.note(fmt::format("{}x{}", shown.width_px(), shown.height_px()));
}

void drawPick(Ui& ui, Session& session) {
    const std::optional<Pick>& pick = session.picker().result();
    if (!pick) return ui.note("Click into the picture to ask about a pixel.");
    if (!pick->hasSurface) return ui.note(fmt::format("({}, {}): no surface there", pick->x, pick->y));
    // Above what grows, so that they stay where they are.
    const bool closes = ui.button("Close pick");
    if (session.picker().busy()) {
        ImGui::SameLine();
        if (ui.button("Stop asking")) session.picker().stop();
    }
    if (closes) return session.picker().clear();
    ui.note(fmt::format("pixel ({}, {}), at ({:.3f}, {:.3f}, {:.3f}) m", pick->x, pick->y, pick->posWorld.x,
                        pick->posWorld.y, pick->posWorld.z));
    ImGui::TextUnformatted((plainNumber(pick->illuminance_lux) + " lux").c_str());
    if (!session.document().moment().lights.empty()) {
        const std::string truth = pick->truth ? fmt::format("{:.4f}", *pick->truth) : "...";
        ImGui::TextUnformatted(fmt::format("visibility, truth: {}", truth).c_str());
        if (ImGui::BeginTable("visibilities", 3, ImGuiTableFlags_SizingStretchSame)) {
            for (const Pick::Answer& answer : pick->answers) {
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", answer.technique.c_str());
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(fmt::format("{:.4f}", answer.visibility).c_str());
                ImGui::TableNextColumn();
                if (pick->truth) {
                    ImGui::TextDisabled("%s",
                                        fmt::format("{:+.4f}", answer.visibility - *pick->truth).c_str());
                }
            }
            ImGui::EndTable();
        }
        if (const gl::Texture& view = session.picker().lightView(); view.name() != 0) {
            ui.note("the light as that point sees it (red: what blocks it)");
            const float width = 200 * ui.scale();
            ImGui::Image(imageId(view), {width, width}, {0, 1}, {1, 0});
        }
    }
}

}  // namespace

Percentiles percentilesOf(std::vector<float> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
    };
    return {at(0.5), at(0.95), at(0.99)};
}

ImTextureID imageId(const gl::Texture& texture) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t(texture.name()));
}

void drawInsightPanel(Ui& ui, Session& session, WindowState& windowState,
                      const std::vector<float>& frameTimes_ms) {
    if (ui.header("Pick")) drawPick(ui, session);
    if (ui.header("Times", false)) {
        drawTimes(ui, session, frameTimes_ms);
        drawPasses(session);
    }
    if (ui.header("Buffers", false)) drawBuffers(ui, session, windowState);
}

}  // namespace penumbra::studio::viewer
