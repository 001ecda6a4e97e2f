// SPDX-License-Identifier: Apache-2.0
// What panels are made of: Dear ImGui's widgets, each of which leaves word where it lies, and what the user
// asks for that is more than a choice.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/viewer/session.h"
#include "studio/viewer/settings.h"

namespace penumbra::studio::viewer {

/// Asked for in a panel or by a key, done when all panels are drawn.
struct Requests {
    std::optional<std::string> open;
    std::optional<std::string> profile;  ///< a luminaire's file, for the light that is chosen
    std::optional<std::string> problem;  ///< to be shown
    bool undo = false, redo = false, saveLights = false, copyCommand = false, savePicture = false,
         saveCanvas = false, record = false, stopRecording = false, frameAll = false, resetCamera = false,
         reloadShaders = false, quit = false;
};

/// A widget of the frame that was drawn last, in screen coordinates: where a test clicks, and a reader is
/// pointed to.
struct PlacedWidget {
    std::string label;
    ImVec2 min, max;
};

class Ui {
  public:
    explicit Ui(float scale) : scale_(scale) {}

    void begin() { placed_.clear(); }
    float scale() const { return scale_; }
    const std::vector<PlacedWidget>& placed() const { return placed_; }

    bool header(const char* label, bool open = true);
    bool button(const char* label);
    bool checkbox(const char* label, bool& value);
    bool radio(const char* label, bool chosen);
    /// As ImGui::BeginMenu: where it returns true, ImGui::EndMenu() must follow.
    bool beginMenu(const char* label, bool enabled = true);
    bool menuItem(const char* label, const char* keys = nullptr, bool chosen = false, bool enabled = true);
    /// The index chosen, where another one is.
    bool combo(const char* label, int& index, const std::vector<std::string>& names);
    bool slider(const char* label, float& value, float min, float max, const char* format = "%.3g",
                bool logarithmic = false);
    bool slider(const char* label, int& value, int min, int max, bool logarithmic = false);
    /// A number without an upper end.
    bool drag(const char* label, float& value, float speed, float min, float max,
              const char* format = "%.4g");
    bool color(const char* label, glm::vec3& value);
    bool text(const char* label, std::string& value);
    /// Grey, wrapped.
    void note(const std::string& text);
    /// Explains the widget before when the mouse rests on it.
    void tip(std::string_view text);

  private:
    bool placed(const char* label, bool result);

    float scale_;
    std::vector<PlacedWidget> placed_;
};

}  // namespace penumbra::studio::viewer
