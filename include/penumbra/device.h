// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "penumbra/export.h"

namespace penumbra {

/// The one way in which the library reports failure: on bad input, and on what the driver refuses. Its
/// message says what was wrong and what would be right. Whatever throws has changed nothing that the host can
/// see but the contents of a VisibilityBuffer that was to be rendered, and the host's OpenGL state is
/// restored all the same. (`std::bad_alloc` may be thrown besides; our own mistakes are asserted.)
class PENUMBRA_API Error : public std::runtime_error {
  public:
    enum class Kind {
        noOpenGL,  ///< no current context, another than the device's, or one that lacks what Penumbra needs
        badArgument,  ///< a value outside its documented range
        unknownName,  ///< no technique or parameter of that name
        shader,       ///< a shader does not compile or link; the message names file and line
        outOfMemory,  ///< the device has no room for a resource; the message says for what and how large
        lostContext,  ///< the device was given up with Device::abandon, destroyed, or moved from
    };
    Error(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

enum class LogLevel { debug, info, warning, error };

struct DeviceOptions {
    /// Called on the thread that calls the library, with messages of Penumbra and, where the host has set no
    /// KHR_debug callback of its own, of the driver. It must not throw. Without it nothing is logged.
    std::function<void(LogLevel, std::string_view)> log{};

    /// Where to read shaders from instead of the embedded copies: the `src` folder of a source tree. Empty:
    /// embedded.
    std::filesystem::path shaderSourceDirectory{};

    /// True: every call leaves the OpenGL state as it found it, which costs some hundred queries of state a
    /// call. False: nothing is put back, for hosts that set all their state for each pass anyway. Neither way
    /// does the library depend on what it finds.
    bool keepHostState = true;

    /// True: the first call of each technique's is looked at by penumbra::diagnose, and what that finds is
    /// logged as a warning. For debug builds.
    bool diagnose = false;

    /// A device on a context that shares objects with this one's, as the host has made them: meshes of either
    /// are then casters for the techniques of both. Needed while the new device is made, no longer.
    const class Device* shared = nullptr;
};

/// Penumbra on one OpenGL 4.5 context, which must be current on the calling thread whenever a call of the
/// library is made on this device or on what was made with it: where another one is, or none, calls throw
/// Error::Kind::noOpenGL. Several devices, each on its own context, may live in a process.
///
/// Threads: a device and all that was made on it are used by one thread at a time, that on which the context
/// is current; different devices by different threads at the same time. Reading what `describe`,
/// `techniqueCatalog` and the like have given needs no context and no thread of its own.
///
/// Destroying needs no context: what was made on a context that is not current when it is destroyed is
/// deleted the next time the device is used, or goes with the context.
class PENUMBRA_API Device {
  public:
    /// Throws Error::Kind::noOpenGL unless an OpenGL 4.5 core (or compatibility) context is current.
    explicit Device(DeviceOptions options = {});
    /// What was made on a device follows it when it is moved. Of one that was moved from, or destroyed, the
    /// techniques, meshes and visibility buffers can be destroyed, and throw Error::Kind::lostContext when
    /// used.
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    const std::string& renderer() const;       ///< GL_RENDERER
    const std::string& openGLVersion() const;  ///< GL_VERSION; Penumbra's own is in penumbra/version.h
    bool isSoftware() const;  ///< a CPU rasteriser such as llvmpipe: GPU timers mean CPU time
    int maxTextureSize_px() const;

    /// Number of driver messages of high severity, or of type error or undefined behaviour, since the device
    /// was made.
    int severeMessageCount() const;

    /// What the library's buffers and textures take on this device, those of meshes, techniques and
    /// visibility buffers included. Programs, which the device keeps for whichever technique needs them
    /// again, hold some hundred bytes of constants each.
    std::size_t memory_bytes() const;

    /// For a context that is lost, or that was destroyed before the device: from now on OpenGL is not called
    /// for anything made on this device. What there is can be destroyed, with any or no context current;
    /// `render`, `deform` and making anything new throw Error::Kind::lostContext.
    void abandon();

    /// Reads all shaders again (see DeviceOptions::shaderSourceDirectory). A program that no longer compiles
    /// keeps its last good version and throws Error::Kind::shader; the others are not affected.
    void reloadShaders();

    struct Internals;

  private:
    explicit Device(std::shared_ptr<Internals> internals);
    /// Throws Error::Kind::lostContext where the device was moved from.
    Internals& internals() const;
    std::shared_ptr<Internals> internals_;
    bool isTheHosts_ = true;  ///< what is made on a device may have a Device of its own, to the same end
};

}  // namespace penumbra
