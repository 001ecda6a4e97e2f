// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/gl/buffer.h"
#include "src/gl/gl.h"
#include "src/gl/program_interface.h"
#include "src/gl/vertex_array.h"
#include "src/gl/write_order.h"

namespace penumbra::gl {

class ShaderLibrary;

inline void deleteProgram(GLuint name) {
    glDeleteProgram(name);
}

/// What a program is made of, kept so that it can be made again.
struct ProgramState {
    std::vector<std::string> files;
    std::vector<std::string> defines;
    std::shared_ptr<WriteOrder> order;  ///< the library's
    Handle<deleteProgram> handle;
    std::vector<std::string> texts;  ///< expanded, one a stage
    ProgramInterface interface;
    VertexArrayHandle vertices;  ///< of programs that draw
    Buffer constants;            ///< the uniform block `Constants`, if there is one
    std::vector<std::byte> lastConstants;

    /// Compiles and links; keeps the last good program and throws Error::Kind::shader if that fails.
    void build(const ShaderLibrary& library);
    /// What passes need; once.
    void prepareForPasses();
    void writeConstants(std::span<const std::byte> bytes);
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
    ProgramState& state() const { return *state_; }

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
