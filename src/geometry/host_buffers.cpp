// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/host_buffers.h"

#include <algorithm>
#include <string>

#include "src/geometry/gather_vertices_io.h"
#include "src/gl/pass.h"

namespace penumbra {
namespace {

constexpr std::size_t word_bytes = 4;
constexpr std::size_t group = 256;
constexpr std::size_t largestDispatch = 65535 * group;  // guaranteed to every OpenGL 4.5 program

void require(bool condition, std::string_view what, const std::string& message) {
    if (!condition) throw Error(Error::Kind::badArgument, "Mesh: " + std::string(what) + ": " + message);
}

void requireHolds(GLuint buffer, std::size_t needed_bytes, std::string_view what) {
    require(glIsBuffer(buffer), what, std::to_string(buffer) + " is no GL buffer of the current context");
    GLint64 size_bytes = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size_bytes);
    require(needed_bytes <= std::size_t(size_bytes), what,
            "buffer " + std::to_string(buffer) + " has " + std::to_string(size_bytes) + " bytes; " +
                std::to_string(needed_bytes) + " are needed");
}

struct Layout {
    std::size_t offset, stride, wordsEach;  ///< as gather_vertices.comp.glsl has them
};

void gather(Device::Internals& device, gl::HostBuffer source, std::size_t count, const Layout& layout,
            const gl::Buffer& target) {
    if (!device.gatherVertices) {
        device.gatherVertices.emplace(device.shaders,
                                      std::vector<std::string>{"src/geometry/gather_vertices.comp.glsl"});
    }
    gl::Pass pass(*device.gatherVertices);
    pass.bind("Source", source).bind("Target", target);
    for (std::size_t first = 0; first < count; first += largestDispatch) {
        const std::size_t now = std::min(count - first, largestDispatch);
        pass.constants(GatherConstants{.first = uint(first),
                                       .count = uint(count),
                                       .offset = uint(layout.offset),
                                       .stride = uint(layout.stride),
                                       .wordsEach = uint(layout.wordsEach)})
            .dispatch((now + group - 1) / group);
    }
    // Meshes hand their buffers out by name.
    target.record().makeVisible(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT |
                                GL_ELEMENT_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace

void gatherVectors(Device::Internals& device, const HostVectors& source, std::size_t count,
                   unsigned components, const gl::Buffer& target, std::string_view what) {
    const std::size_t tight_bytes = components * word_bytes;
    const std::size_t stride_bytes = source.stride_bytes == 0 ? tight_bytes : source.stride_bytes;
    require(source.offset_bytes % word_bytes == 0 && stride_bytes % word_bytes == 0, what,
            "offset and stride must be multiples of four bytes");
    if (count == 0) return;
    requireHolds(source.buffer, source.offset_bytes + (count - 1) * stride_bytes + tight_bytes, what);
    gather(device, {source.buffer}, count,
           {source.offset_bytes / word_bytes, stride_bytes / word_bytes, components}, target);
}

void gatherIndices(Device::Internals& device, const Mesh::HostSource& source, const gl::Buffer& target) {
    const bool isWide = source.indexType == Mesh::HostSource::IndexType::uint32;
    const std::size_t index_bytes = isWide ? 4 : 2;
    require(source.indexOffset_bytes % index_bytes == 0, "indices",
            "the offset must be a multiple of an index's size");
    if (source.indexCount == 0) return;
    requireHolds(source.indexBuffer, source.indexOffset_bytes + source.indexCount * index_bytes, "indices");
    // Shaders cannot read the last half of a buffer that does not end at a word.
    const std::size_t size_bytes = source.indexCount * index_bytes;
    const gl::Buffer words((size_bytes + word_bytes - 1) / word_bytes * word_bytes, "host's indices");
    glCopyNamedBufferSubData(source.indexBuffer, words.name(), GLintptr(source.indexOffset_bytes), 0,
                             GLsizeiptr(size_bytes));
    gather(device, {words.name()}, source.indexCount, {0, 1, std::size_t(isWide ? 1 : 0)}, target);
}

}  // namespace penumbra
