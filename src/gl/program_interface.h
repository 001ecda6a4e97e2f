// SPDX-License-Identifier: Apache-2.0
// What a program asks for, by the names in its shaders: nobody else numbers a binding.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/gl/gl.h"

namespace penumbra::gl {

/// Bindings that a program may use, over all of its stages: of each, what OpenGL 4.5 has at least. A host's
/// are kept up to there.
inline constexpr GLuint textureUnits = 16;
inline constexpr GLuint imageUnits = 8;
inline constexpr GLuint storageBlocks = 8;
inline constexpr GLuint uniformBlocks = 8;

/// Something that is bound to a program.
struct ProgramResource {
    enum class Kind { uniformBlock, storageBlock, texture, image, vertexInput };

    std::string name;
    Kind kind{};
    bool isRead = true;      ///< by the shaders' own words: `writeonly` if not
    bool isWritten = false;  ///< likewise: `readonly` if not; buffers and images alone
    bool isActive = false;   ///< declared, and used by what is left after optimisation
    GLuint unit = 0;         ///< binding, texture or image unit, attribute; the first of an array
    GLuint count = 1;        ///< of an array of textures
    /// Uniform blocks: of the whole; storage blocks: of an element of an array at their start.
    GLuint size_bytes = 0;
    GLint components = 0;    ///< vertex inputs
    bool isInteger = false;  ///< vertex inputs
};

/// At most 64 resources.
class ProgramInterface {
  public:
    /// Reads declarations from the stages' expanded texts (`vertexStage` is the index of the vertex shader
    /// among them, or -1), asks the linked program what is left of them, and gives units to textures, images
    /// and blocks.
    ProgramInterface(GLuint program, std::span<const std::string> texts, int vertexStage);
    ProgramInterface() = default;

    /// Null where no shader declares the name.
    const ProgramResource* find(std::string_view name) const;
    /// A bit each, in the order of `all()`.
    std::uint64_t activeResources() const { return active_; }
    std::span<const ProgramResource> all() const { return resources_; }
    /// The first resource that is one too many of its kind; null where all are within what OpenGL 4.5
    /// promises.
    const ProgramResource* firstBeyondPromise() const;

  private:
    std::vector<ProgramResource> resources_;
    std::uint64_t active_ = 0;
};

}  // namespace penumbra::gl
