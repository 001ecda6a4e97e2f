// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace penumbra {

/// Thrown by the library on bad input and on what the driver refuses; our own mistakes are asserted.
class Error : public std::runtime_error {
  public:
    enum class Kind {
        noOpenGL,     ///< no current context, or one that lacks what Penumbra needs
        badArgument,  ///< a value outside its documented range
        unknownName,  ///< no technique or parameter of that name
        shader,       ///< a shader does not compile or link; the message names file and line
        outOfMemory,  ///< the device has no room for a resource; the message says for what and how large
    };
    Error(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

enum class LogLevel { debug, info, warning, error };

struct DeviceOptions {
    /// Called on the thread that calls the library, with messages of Penumbra and of the driver (KHR_debug).
    /// Without it nothing is logged.
    std::function<void(LogLevel, std::string_view)> log;

    /// Where to read shaders from instead of the embedded copies: the `src` folder of a source tree. Empty:
    /// embedded.
    std::filesystem::path shaderSourceDirectory;
};

/// Penumbra on one OpenGL 4.5 context, which must be current on the calling thread whenever a call of the
/// library is made on this device or on what was made with it. Several devices, each on its own context, may
/// live in a process.
class Device {
  public:
    /// Throws Error::Kind::noOpenGL unless an OpenGL 4.5 core (or compatibility) context is current.
    explicit Device(DeviceOptions options = {});
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    const std::string& renderer() const;  ///< GL_RENDERER
    const std::string& version() const;   ///< GL_VERSION
    bool isSoftware() const;              ///< a CPU rasteriser such as llvmpipe: GPU timers mean CPU time
    int maxTextureSize_px() const;

    /// Number of driver messages of high severity, or of type error or undefined behaviour, since the device
    /// was made.
    int severeMessageCount() const;

    /// Reads all shaders again (see DeviceOptions::shaderSourceDirectory). A program that no longer compiles
    /// keeps its last good version and throws Error::Kind::shader; the others are not affected.
    void reloadShaders();

    struct Internals;
    Internals& internals() const { return *internals_; }

  private:
    std::unique_ptr<Internals> internals_;
};

}  // namespace penumbra
