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
    ProgramInterface interface;
    VertexArrayHandle vertices;  ///< of programs that draw
    Buffer constants;            ///< the uniform block `Constants`, if there is one
    std::vector<std::byte> lastConstants;

    /// Compiles and links; keeps the last good program and throws Error::Kind::shader if that fails.
    void build(const ShaderLibrary& library);
    void writeConstants(std::span<const std::byte> bytes);
};

/// A linked program. The stage of each file follows from its name: `.vert.glsl`, `.frag.glsl`, `.comp.glsl`.
class Program {
  public:
    Program() = default;
    /// `files` are paths from the repository's root. Compiled once a library for the same files and defines,
    /// whoever asks. Throws Error::Kind::shader; its message names file and line.
    Program(ShaderLibrary& library, std::vector<std::string> files, std::vector<std::string> defines = {});

    GLuint name() const { return state_->handle.name(); }
    ProgramState& state() const { return *state_; }

  private:
    std::shared_ptr<ProgramState> state_;
};

}  // namespace penumbra::gl
