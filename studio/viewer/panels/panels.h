// SPDX-License-Identifier: Apache-2.0
// The panels, top to bottom. Each shows what a session has and changes its choices; what takes longer is
// requested.
#pragma once

#include "studio/viewer/export.h"
#include "studio/viewer/gizmo.h"
#include "studio/viewer/panels/file_browser.h"
#include "studio/viewer/panels/ui.h"

namespace penumbra::studio::viewer {

/// What belongs to the window and not to the picture.
struct WindowState {
    bool showsHelp = false;
    bool showsWelcome = false;
    bool showsPanel = true;
    bool playing = false;
    Gizmo::Mode gizmoMode = Gizmo::Mode::move;
    FileBrowser browser;
    std::string message;  ///< of the last thing done; shown for a while
    bool messageIsError = false;
    double messageUntil_s = 0;
    Recorder::Plan recording{"penumbra-frames", 0, 47, 24};
    std::size_t buffer = 0;  ///< of Session::inspected()
    int bufferLayer = 0;
    bool bufferStretched = true;
    std::string presetName;
    glm::vec3 aim_m{0};       ///< where a light shall shine
    bool placesGrid = false;  ///< the next drag over the picture lays a grid
    bool canUndo = false, canRedo = false;
    std::optional<Requests> leaving;  ///< what shall be done once it is known what becomes of unsaved lights
};

/// The library's techniques and the reference, in the order of the keys 1 to 9 and 0.
std::vector<std::string> techniqueChoices();
void chooseTechnique(Session& session, const std::string& name);
void chooseOther(Session& session, const std::string& name);
/// They have keys of their own.
inline constexpr std::string_view exactName = "exact", automaticName = "auto";
/// Where the scene's lights would be saved.
std::filesystem::path lightsPathOf(const Document& document);
/// Where a measured grid would be.
std::filesystem::path gridPathOf(const Document& document);

void drawMenuBar(Ui& ui, Session& session, Settings& settings, WindowState& windowState, Requests& requests);
void drawTechniquePanel(Ui& ui, Session& session, Settings& settings, WindowState& windowState);
void drawLightsPanel(Ui& ui, Session& session, WindowState& windowState, Requests& requests);
/// A distant light's; returns whether it is another now. At night it stays where it was, and why is said.
bool editSun(Ui& ui, Light& light, Requests& requests);
void drawMeasurePanel(Ui& ui, Session& session, WindowState& windowState);
void drawComparePanel(Ui& ui, Session& session);
void drawColorsPanel(Ui& ui, Session& session);
void drawInsightPanel(Ui& ui, Session& session, WindowState& windowState,
                      const std::vector<float>& frameTimes_ms);
void drawAnimationPanel(Ui& ui, Session& session, WindowState& windowState, const Recorder& recorder,
                        Requests& requests);
void drawHelp(Ui& ui, WindowState& windowState);

/// Of the frame: median, 95th and 99th percentile.
struct Percentiles {
    float p50 = 0, p95 = 0, p99 = 0;
};
Percentiles percentilesOf(std::vector<float> values);

/// A texture of ours for Dear ImGui.
ImTextureID imageId(const gl::Texture& texture);

}  // namespace penumbra::studio::viewer
