// SPDX-License-Identifier: Apache-2.0
// The one seam between C++ and shaders: a pass has a program, gets what that reads and writes by the names in
// its shaders, and runs. Nothing is numbered, no memory barrier is placed by hand; what a shader writes
// follows from its own `readonly` and `writeonly`.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "src/gl/buffer.h"
#include "src/gl/program.h"
#include "src/gl/raster_state.h"
#include "src/gl/texture.h"

namespace penumbra::gl {

class Framebuffer;

/// A buffer that is not ours: the host's, or one known by name alone. Passes may read it.
struct HostBuffer {
    GLuint name = 0;
};

/// Where a vertex shader's input comes from.
struct VertexSource {
    GLuint buffer = 0;  ///< 0: nowhere, the input is 0
    std::size_t offset_bytes = 0;
    std::size_t stride_bytes = 0;  ///< 0: tightly packed
    bool perInstance = false;
};

enum class Primitive : GLenum { points = GL_POINTS, triangles = GL_TRIANGLES };

/// From its construction until the next pass's. Its dispatches and draws do not see what each other write,
/// unless `inOrder` says so. Mistakes in names and sizes, which are ours, throw std::logic_error with the
/// program's file.
class Pass {
  public:
    explicit Pass(const Program& program);
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

    Pass& bind(std::string_view name, const Buffer& buffer);
    /// A part of a buffer, as a uniform block; the offset is a multiple of 256.
    Pass& bind(std::string_view name, const Buffer& buffer, std::size_t offset_bytes, std::size_t size_bytes);
    Pass& bind(std::string_view name, HostBuffer buffer);
    template <typename T>
    Pass& bind(std::string_view name, const ConstantBuffer<T>& constants) {
        requireSize(name, sizeof(T));
        return bind(name, constants.buffer());
    }
    template <typename T>
    Pass& bind(std::string_view name, const StorageArray<T>& array) {
        requireSize(name, sizeof(T));
        return bind(name, array.buffer());
    }
    /// As a texture or as an image, whatever the shader has declared.
    Pass& bind(std::string_view name, const TextureRef& texture) { return bind(name, 0, texture); }
    Pass& bind(std::string_view name, const Texture& texture) { return bind(name, 0, texture.ref()); }
    /// An element of an array of textures.
    Pass& bind(std::string_view name, std::size_t element, const TextureRef& texture);
    /// What several passes get alike: `group.bindTo(*this)`.
    template <typename Group>
    Pass& bind(const Group& group) {
        group.bindTo(*this);
        return *this;
    }

    /// Whether the shaders declare the name, for groups of which a shader wants a part.
    bool has(std::string_view name) const;

    /// Fills the program's uniform block `Constants`, for the dispatches and draws that follow.
    template <typename T>
    Pass& constants(const T& value) {
        requireSize("Constants", sizeof(T));
        setConstants(std::as_bytes(std::span(&value, 1)));
        return *this;
    }

    /// Each dispatch or draw from now on sees what those before it have written.
    Pass& inOrder() {
        isInOrder_ = true;
        return *this;
    }

    void dispatch(std::size_t groupsX, std::size_t groupsY = 1, std::size_t groupsZ = 1);
    /// One invocation a pixel, in groups of 8 x 8.
    void dispatchPixels(int width_px, int height_px);
    /// As many groups as three unsigned integers in the buffer say.
    void dispatchIndirect(const Buffer& arguments, std::size_t offset_bytes = 0);

    /// Draws go there, with this state; clearing obeys the state's masks.
    Pass& into(const Framebuffer& target, const RasterState& state);
    /// Changes the state for the draws that follow; the viewport stays.
    Pass& state(const RasterState& state);
    Pass& clearColor(int attachment, const std::array<float, 4>& value);
    Pass& clearColor(int attachment, const std::array<std::uint32_t, 4>& value);
    Pass& clearDepth(float value);
    Pass& clearStencil(int value);

    Pass& vertices(std::string_view input, const VertexSource& source);
    Pass& vertices(std::string_view input, const Buffer& buffer, VertexSource layout = {});
    Pass& indices(GLuint buffer);  ///< 32 bits each
    void draw(Primitive primitive, std::size_t count, std::size_t first = 0, std::size_t instances = 1);
    void drawIndexed(std::size_t count, std::size_t instances = 1, std::size_t firstInstance = 0);
    /// Arguments as glDrawArraysIndirect's and glDrawElementsIndirect's.
    void drawIndirect(Primitive primitive, const Buffer& arguments, std::size_t offset_bytes = 0);
    void drawIndexedIndirect(const Buffer& arguments, std::size_t offset_bytes = 0);

  private:
    struct Use {
        WriteRecord* record;  ///< null: what no shader of ours writes
        GLbitfield kind;      ///< glMemoryBarrier's bit
        bool isWritten;
    };

    const ProgramResource* resource(std::string_view name,
                                    std::initializer_list<ProgramResource::Kind> kinds);
    void bindBlock(std::string_view name, GLuint buffer, WriteRecord* record, std::size_t offset_bytes,
                   std::size_t size_bytes);
    void requireSize(std::string_view name, std::size_t size_bytes) const;
    void setConstants(std::span<const std::byte> bytes);
    void note(const ProgramResource& resource, std::size_t element, const Use& use);
    /// Before a dispatch or draw: everything is bound, and what it reads is there.
    void begin(const Buffer* arguments = nullptr);
    void beginDrawing(const Buffer* arguments = nullptr);
    void end();
    [[noreturn]] void fail(std::string_view name, std::string_view what) const;

    ProgramState& program_;
    const ProgramInterface& interface_;
    WriteOrder& order_;
    WriteOrder::Serial serial_;
    GLuint target_ = 0;  ///< framebuffer
    RasterState raster_;
    bool isInOrder_ = false;
    std::uint64_t bound_ = 0;
    static constexpr std::size_t mostUses = 64;
    std::array<Use, mostUses> uses_{};  ///< by resource; of an array of textures, its last
};

}  // namespace penumbra::gl
