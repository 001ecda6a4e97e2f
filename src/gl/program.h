// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/gl/gl.h"

namespace penumbra::gl {

class ShaderLibrary;

inline void deleteProgram(GLuint name) {
    glDeleteProgram(name);
}

/// What a program is made of, kept so that it can be made again.
struct ProgramState {
    std::vector<std::string> files;
    std::vector<std::string> defines;
    Handle<deleteProgram> handle;

    /// Compiles and links; keeps the last good program and throws Error::Kind::shader if that fails.
    void build(const ShaderLibrary& library);
};

/// A linked program. The stage of each file follows from its name: `.vert.glsl`, `.frag.glsl`, `.comp.glsl`.
class Program {
  public:
    Program() = default;
    /// `files` are paths from the repository's root. Throws Error::Kind::shader; its message names file and
    /// line.
    Program(ShaderLibrary& library, std::vector<std::string> files, std::vector<std::string> defines = {});

    void use() const { glUseProgram(name()); }
    GLuint name() const { return state_->handle.name(); }

  private:
    std::shared_ptr<ProgramState> state_;
};

/// Runs the current compute program with one invocation a pixel, in groups of 8 x 8.
void dispatchPixels(int width_px, int height_px);

class Buffer;

/// Runs the current compute program with as many groups as the device has written into the buffer. The caller
/// orders it behind the writing (GL_COMMAND_BARRIER_BIT).
void dispatchIndirect(const Buffer& buffer, std::size_t offset_bytes = 0);

}  // namespace penumbra::gl
