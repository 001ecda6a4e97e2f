// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/window.h"

#include <fmt/format.h>

#include <algorithm>

#include <utility>

// Before anything that includes OpenGL's own header.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include "src/gl/gl.h"
#include "src/gl/raster_state.h"

#include "studio/context/headless_context.h"
#include "studio/viewer/theme.h"

namespace penumbra::studio::viewer {
namespace {

std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "unknown reason" : text;
}

}  // namespace

/// GLFW itself, for as long as a window needs it.
class Window::Library {
  public:
    Library() {
        if (glfwInit() == GLFW_FALSE) {
            throw NoOpenGLError(
                fmt::format("no window can be opened: {}\nWithout a display use 'penumbra "
                            "render'.",
                            lastError()));
        }
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { glfwTerminate(); }
};

Window::Window(const WindowOptions& options) : library_(std::make_unique<Library>()) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        throw NoOpenGLError(
            fmt::format("no window with OpenGL 4.5 can be opened: {}\nInstall a driver; the "
                        "software renderer of the package libgl1-mesa-dri will do.",
                        lastError()));
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(options.vsync ? 1 : 0);
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        auto& dropped = static_cast<Window*>(glfwGetWindowUserPointer(window))->dropped_;
        dropped.insert(dropped.end(), paths, paths + count);
    });

    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // panels have their places; there is nothing to keep
    ImGui::GetIO().ConfigDragClickToInputText = true;
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
        static_cast<Window*>(glfwGetWindowUserPointer(window))->onKey(key, scancode, action, mods);
    });
    ImGui_ImplOpenGL3_Init("#version 450");
    measure();
    applyTheme(contentScale());
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
}

bool Window::closeRequested() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::requestClose() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::cancelClose() {
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
}

void Window::onKey(int key, int scancode, int action, int mods) {
    if (action == GLFW_RELEASE) {
        releases_.push_back({key, scancode, mods});
        return;
    }
    keys_.push_back({key, mods});
    ImGui_ImplGlfw_KeyCallback(window_, key, scancode, action, mods);
}

void Window::pollEvents(double longest_s) {
    // A frame has begun since these keys went down, so that none of them is missed.
    for (const auto& [key, scancode, mods] : std::exchange(releases_, {})) {
        ImGui_ImplGlfw_KeyCallback(window_, key, scancode, GLFW_RELEASE, mods);
    }
    if (longest_s > 0) {
        glfwWaitEventsTimeout(longest_s);
    } else {
        glfwPollEvents();
    }
    measure();
}

void Window::measure() {
    glfwGetFramebufferSize(window_, &width_px_, &height_px_);
}

void Window::beginFrame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::draw() {
    ImGui::Render();
    drawInterface();
}

void Window::drawInterface() {
    gl::beginPass(0, {.width_px = width_px_, .height_px = height_px_});
    constexpr float background[4] = {0.075f, 0.08f, 0.09f, 1};
    glClearNamedFramebufferfv(0, GL_COLOR, 0, background);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show() {
    glfwSwapBuffers(window_);
}

Image Window::read() {
    drawInterface();
    Image image(width_px_, height_px_, 3);
    std::vector<float> bottomUp(image.values.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_px_, height_px_, GL_RGB, GL_FLOAT, bottomUp.data());
    const std::size_t row = std::size_t(width_px_) * 3;
    for (std::size_t y = 0; y < std::size_t(height_px_); ++y) {
        std::copy_n(&bottomUp[y * row], row, &image.values[(std::size_t(height_px_) - 1 - y) * row]);
    }
    return image;
}

float Window::pixelsPerCoordinate() const {
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    return width > 0 ? float(width_px_) / float(width) : 1.0f;
}

float Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x / pixelsPerCoordinate();
}

std::vector<KeyPress> Window::takeKeys() {
    return std::exchange(keys_, {});
}

std::vector<std::filesystem::path> Window::takeDroppedFiles() {
    return std::exchange(dropped_, {});
}

bool Window::isDown(int key) const {
    return glfwGetKey(window_, key) == GLFW_PRESS;
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::size(int& width, int& height) const {
    glfwGetWindowSize(window_, &width, &height);
}

void Window::setSize(int width, int height) {
    glfwSetWindowSize(window_, width, height);
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(window_);
    return text == nullptr ? "" : text;
}

}  // namespace penumbra::studio::viewer
