// SPDX-License-Identifier: Apache-2.0
// What panels are made of: Dear ImGui's widgets, each of which leaves word where it lies, and what the user
// asks for that is more than a choice.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studio/viewer/session.h"
#include "studio/viewer/settings.h"

namespace penumbra::studio::viewer {

/// Asked for in a panel or by a key, done when all panels are drawn.
struct Requests {
    std::optional<std::string> open;
    std::string openLights;  ///< a file of lights for it; empty: its own
    std::optional<std::string> saveLightsAs;
    std::optional<std::string> saveGrid;
    std::optional<std::string> texture;  ///< a picture's file, for the light that is chosen
    std::optional<std::string> profile;  ///< a luminaire's file, for the light that is chosen
    std::optional<std::string> problem;  ///< to be shown
    bool undo = false, redo = false, saveLights = false, copyCommand = false, savePicture = false,
         saveCanvas = false, addLight = false, keepView = false, record = false, stopRecording = false,
         frameAll = false, resetCamera = false, reloadShaders = false, quit = false;
};

/// A widget of the frame that was drawn last, in screen coordinates: where a test clicks, and a reader is
/// pointed to.
struct PlacedWidget {
    std::string label;
    ImVec2 min, max;
};

/// What is typed into a number counts once it is entered: on the way there, "0." of "0.6" would be a light of
/// size zero.
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
    bool selectable(const char* label, bool chosen);
    bool menuItem(const char* label, const char* keys = nullptr, bool chosen = false, bool enabled = true);
    /// The index chosen, where another one is.
    bool combo(const char* label, int& index, const std::vector<std::string>& names);
    bool slider(const char* label, float& value, float min, float max, const char* format = nullptr,
                bool logarithmic = false);
    bool slider(const char* label, int& value, int min, int max, bool logarithmic = false);
    /// A number without an upper end; without a format as plainNumber() writes it.
    bool drag(const char* label, float& value, float speed, float min, float max,
              const char* format = nullptr);
    bool color(const char* label, glm::vec3& value);
    bool text(const char* label, std::string& value);
    /// Grey, wrapped.
    void note(const std::string& text);
    /// Explains the widget before when the mouse rests on it.
    void tip(std::string_view text);

  private:
    bool placed(const char* label, bool result);
    /// `widget` draws and changes a number.
    template <typename Number, typename Widget>
    bool entered(const char* label, Number& value, const Widget& widget);

    struct Typing {
        ImGuiID id = 0;
        int frame = 0;  ///< in which it was seen last
        double value = 0;
    };
    std::optional<Typing> typing_;
    std::optional<std::pair<ImGuiID, glm::vec3>> typedColor_;
    float scale_;
    std::vector<PlacedWidget> placed_;
};

}  // namespace penumbra::studio::viewer
