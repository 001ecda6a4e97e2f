// SPDX-License-Identifier: Apache-2.0
// A window with OpenGL 4.5 and Dear ImGui in it, and what came in through it since the last frame.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "studio/image/image.h"

struct GLFWwindow;

namespace penumbra::studio::viewer {

struct WindowOptions {
    std::string title = "Penumbra";
    int width = 1280, height = 800;  ///< in screen coordinates
    bool vsync = true;
};

/// Key presses in their order. Dear ImGui 1.86 knows only which keys are down when a frame begins, so that
/// taps between two slow frames would be lost.
struct KeyPress {
    int key = 0;   ///< GLFW_KEY_...
    int mods = 0;  ///< GLFW_MOD_...
};

/// One at a time in a process, on the main thread (GLFW's rule).
class Window {
  public:
    /// Throws NoOpenGLError, naming display or driver.
    explicit Window(const WindowOptions& options);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    bool closeRequested() const;
    void requestClose();
    void cancelClose();

    /// Takes in what has happened; waits up to `longest_s` for something to happen.
    void pollEvents(double longest_s);
    /// Begins a frame of Dear ImGui.
    void beginFrame();
    /// Draws Dear ImGui's frame over `background`; show() makes it visible.
    void draw();
    void show();

    /// What draw() has drawn, drawn again: what lies in the window's buffers once it is shown, nobody knows.
    /// Waits for the device.
    Image read();

    int width_px() const { return width_px_; }    ///< of the framebuffer
    int height_px() const { return height_px_; }  ///< 0 while minimised
    /// Framebuffer pixels to a screen coordinate, in which the mouse is told; 1 but on some systems.
    float pixelsPerCoordinate() const;
    /// How much larger than on an ordinary display things must be drawn to be as large: 2 on a "HiDPI" one.
    float contentScale() const;

    std::vector<KeyPress> takeKeys();
    std::vector<std::filesystem::path> takeDroppedFiles();
    bool isDown(int key) const;

    void setTitle(const std::string& title);
    void size(int& width, int& height) const;  ///< in screen coordinates
    void setSize(int width, int height);
    void setClipboard(const std::string& text);
    std::string clipboard() const;
    GLFWwindow* handle() const { return window_; }

  private:
    class Library;
    void measure();
    void drawInterface();
    void onKey(int key, int scancode, int action, int mods);

    std::unique_ptr<Library> library_;
    GLFWwindow* window_ = nullptr;
    int width_px_ = 0, height_px_ = 0;
    std::vector<KeyPress> keys_;
    struct Release {
        int key, scancode, mods;
    };
    std::vector<Release> releases_;  ///< that Dear ImGui is yet to hear of
    std::vector<std::filesystem::path> dropped_;
};

}  // namespace penumbra::studio::viewer
