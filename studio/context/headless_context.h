// SPDX-License-Identifier: Apache-2.0
// OpenGL without a window, through EGL.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra::studio {

/// No usable OpenGL 4.5: exit code 4.
struct NoOpenGLError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct HeadlessDevice {
    std::string name;     ///< what EGL says of the device, and GL_RENDERER where a context could be made
    bool usable = false;  ///< an OpenGL 4.5 core context can be made
    std::string whyNot;   ///< where it is not usable
};

/// Everything that can be given as `--device`: EGL's devices in the driver's order, GPUs before software
/// ones, then Mesa's surfaceless platform. Empty where the machine has no EGL.
std::vector<HeadlessDevice> listHeadlessDevices();

/// Hosts have either; everything of our own needs core alone.
enum class ContextProfile { core, compatibility };

/// An OpenGL 4.5 debug context with robust access, current on the calling thread from construction to
/// destruction.
class HeadlessContext {
  public:
    /// `device` is an index into listHeadlessDevices(); without one the first usable device is taken. Throws
    /// NoOpenGLError, naming what was tried. Objects are shared with `shared`, which lives on the same
    /// device.
    explicit HeadlessContext(std::optional<int> device = std::nullopt,
                             ContextProfile profile = ContextProfile::core,
                             const HeadlessContext* shared = nullptr);
    HeadlessContext(HeadlessContext&&) noexcept;
    HeadlessContext& operator=(HeadlessContext&&) noexcept;
    ~HeadlessContext();

    /// Makes this context current on the calling thread.
    void makeCurrent() const;
    /// Leaves the calling thread without a context.
    void makeNoneCurrent() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::studio
