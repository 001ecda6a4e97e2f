// SPDX-License-Identifier: Apache-2.0
// `penumbra view`: a window, a session, panels.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "studio/viewer/canvas_mouse.h"
#include "studio/viewer/history.h"
#include "studio/viewer/settings.h"
#include "studio/viewer/shader_watch.h"

namespace penumbra::studio::viewer {

struct ViewerOptions {
    std::string scene;  ///< as openScene takes it; empty: one that shows what this is about
    OpenOptions open;
    std::string technique;       ///< of side A; empty: that of the settings
    ParameterValues parameters;  ///< of that technique
    double time_s = 0;
    /// Where one looks from first; null: through the scene's first camera.
    std::function<Camera(const Scene&, const SceneMoment&)> camera;
    std::filesystem::path shaderSourceDirectory;  ///< read shaders from this tree, and again when they change
    std::filesystem::path settings = settingsFile();
    bool keepsSettings = true;  ///< writes them when it ends
    std::filesystem::path data = dataFolder();
    /// Where pictures of built-in scenes are saved; those of files lie beside them.
    std::filesystem::path pictures = std::filesystem::current_path();
    double late_ms = 120;     ///< a picture that takes longer while hands move is drawn with fewer pixels
    double refine_ms = 1500;  ///< at rest a picture is drawn once more, as finely as takes no longer
};

class Viewer {
  public:
    /// Throws NoOpenGLError without a display or OpenGL 4.5, InputError for a scene that cannot be opened.
    explicit Viewer(ViewerOptions options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Takes events in, updates what they changed and shows it. `wait`: for the next event, where there is
    /// nothing to do. False once the window shall close.
    bool frame(bool wait = true);

    Session& session() { return session_; }
    Window& window() { return window_; }
    const WindowState& windowState() const { return windowState_; }
    WindowState& windowState() { return windowState_; }
    const Settings& settings() const { return settings_; }
    const std::vector<PlacedWidget>& widgets() const { return ui_.placed(); }
    const CanvasPlace& canvasPlace() const { return place_; }
    const Recorder& recorder() const { return recorder_; }
    const std::string& shownTitle() const { return shownTitle_; }
    /// The window as it was drawn last.
    Image screenshot() { return window_.read(); }

  private:
    /// What the options say of technique, moment and camera. Throws Error for parameters that there are not.
    void startAsAsked();
    void takeFiles();
    /// Makes the light that is chosen the luminaire of this file.
    void loadProfile(const std::string& file);
    void takeKeys();
    void chooseByKey(int key, int mods);
    void nextLight();
    void changeSelectedLight(int key);
    void stepTime(int frames);
    void advanceTime();
    void drawPanels(Requests& requests);
    /// Leaving the scene with lights that are not saved: whether, and how.
    void drawLeavingDialog(Requests& requests);
    void carryOut(const Requests& requests);
    bool saveLights();
    void saveLightsAs(const std::string& file);
    /// The light that is chosen shows this picture.
    void loadTexture(const std::string& file);
    /// Pictures and commands: as `requests` ask.
    void takeAway(const Requests& requests);
    /// What is open now: recent, and in the title.
    void follow();
    RecentFile openFile() const;
    std::string title() const;
    PictureSize keptSize() const;
    void undo(const Requests& requests);
    void open(const std::string& nameOrPath, const std::string& lights);
    void updatePicture();
    /// Draws the picture anew where that is needed; true if it was.
    bool drawPicture();
    /// Whatever is kept of a picture is kept as it is at rest.
    void restoreResolution();
    void drawCanvas();
    void drawOverlay();
    void drawIsolineNumbers();
    void drawLegend();
    void record();
    void keepSettings();
    void say(const std::string& message, bool isError = false);
    /// Runs what may fail for reasons of the user's; the window says why.
    template <typename Action>
    void attempt(const Action& action);
    std::filesystem::path freshPictureName() const;

    ViewerOptions options_;
    Settings settings_;
    Window window_;
    Session session_;
    Ui ui_;
    WindowState windowState_;
    CanvasMouse mouse_;
    Recorder recorder_;
    std::optional<double> recordedTime_s_;  ///< that is being shown for the recorder
    ShaderWatch shaderWatch_;
    History<Work> history_;
    std::string shownTitle_;
    Requests keyRequests_;
    CanvasPlace place_;
    std::vector<float> frameTimes_ms_;  ///< of frames that had something to draw
    double playedAt_s_ = 0, movedAt_s_ = -1, drawnAt_s_ = 0;
    float slowDown_ = 1;  ///< of the resolution while hands move and frames are late
};

}  // namespace penumbra::studio::viewer
