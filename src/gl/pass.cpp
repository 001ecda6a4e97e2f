// SPDX-License-Identifier: Apache-2.0
#include "src/gl/pass.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "src/gl/framebuffer.h"

namespace penumbra::gl {
namespace {

using Kind = ProgramResource::Kind;

const void* at(std::size_t offset_bytes) {
    return reinterpret_cast<const void*>(
        offset_bytes);  // NOLINT(performance-no-int-to-ptr): as OpenGL has it
}

}  // namespace

Pass::Pass(const Program& program)
    : program_(program.state()),
      interface_(program_.interface),
      order_(*program_.order),
      serial_(order_.beginPass()) {
    glUseProgram(program_.handle.name());
}

void Pass::fail(std::string_view name, std::string_view what) const {
    throw std::logic_error(program_.files.back() + ": '" + std::string(name) + "' " + std::string(what));
}

bool Pass::has(std::string_view name) const {
    return interface_.find(name) != nullptr;
}

const ProgramResource* Pass::resource(std::string_view name, std::initializer_list<Kind> kinds) {
    const ProgramResource* const found = interface_.find(name);
    if (found == nullptr) fail(name, "is bound, and no shader declares it");
    if (std::ranges::find(kinds, found->kind) == kinds.end()) fail(name, "is of another kind in the shader");
    return found;
}

void Pass::requireSize(std::string_view name, std::size_t size_bytes) const {
    const ProgramResource* const found = interface_.find(name);
    if (found == nullptr || !found->isActive || found->size_bytes == 0) return;
    if (found->size_bytes == size_bytes) return;
    // std140 rounds a struct up to 16 bytes, C++ need not.
    const bool isRounded =
        found->kind == Kind::uniformBlock && (size_bytes + 15) / 16 * 16 == found->size_bytes;
    if (!isRounded)
        fail(name, "has " + std::to_string(size_bytes) + " bytes in C++ and " +
                       std::to_string(found->size_bytes) + " in the shader");
}

void Pass::note(const ProgramResource& resource, std::size_t element, const Use& use) {
    const auto index = std::size_t(&resource - interface_.all().data());
    // Elements of an array of textures are read, never written.
    if (element == 0 || uses_[index].record == nullptr) uses_[index] = use;
    bound_ |= std::uint64_t(1) << index;
}

void Pass::bindBlock(std::string_view name, GLuint buffer, WriteRecord* record, std::size_t offset_bytes,
                     std::size_t size_bytes) {
    const ProgramResource* const block = resource(name, {Kind::uniformBlock, Kind::storageBlock});
    if (!block->isActive) return;
    const bool isUniform = block->kind == Kind::uniformBlock;
    const GLenum target = isUniform ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER;
    if (size_bytes == 0) {
        glBindBufferBase(target, block->unit, buffer);
    } else {
        glBindBufferRange(target, block->unit, buffer, GLintptr(offset_bytes), GLsizeiptr(size_bytes));
    }
    note(*block, 0,
         {record, GLbitfield(isUniform ? GL_UNIFORM_BARRIER_BIT : GL_SHADER_STORAGE_BARRIER_BIT),
          block->isWritten});
}

Pass& Pass::bind(std::string_view name, const Buffer& buffer) {
    bindBlock(name, buffer.name(), &buffer.record(), 0, 0);
    return *this;
}

Pass& Pass::bind(std::string_view name, const Buffer& buffer, std::size_t offset_bytes,
                 std::size_t size_bytes) {
    bindBlock(name, buffer.name(), &buffer.record(), offset_bytes, size_bytes);
    return *this;
}

Pass& Pass::bind(std::string_view name, HostBuffer buffer) {
    if (const ProgramResource* const block = interface_.find(name); block != nullptr && block->isWritten)
        fail(name, "may be written, and is the host's");
    bindBlock(name, buffer.name, nullptr, 0, 0);
    return *this;
}

Pass& Pass::bind(std::string_view name, std::size_t element, const TextureRef& texture) {
    const ProgramResource* const wanted = resource(name, {Kind::texture, Kind::image});
    if (!wanted->isActive) return *this;
    if (element >= wanted->count) fail(name, "has fewer elements in the shader");
    const GLuint unit = wanted->unit + GLuint(element);
    if (wanted->kind == Kind::texture) {
        glBindTextureUnit(unit, texture.name);
    } else {
        const GLenum access = !wanted->isRead     ? GL_WRITE_ONLY
                              : wanted->isWritten ? GL_READ_WRITE
                                                  : GL_READ_ONLY;
        glBindImageTexture(unit, texture.name, texture.level, texture.isLayered ? GL_TRUE : GL_FALSE, 0,
                           access, GLenum(texture.format));
    }
    note(*wanted, element,
         {texture.record,
          GLbitfield(wanted->kind == Kind::texture ? GL_TEXTURE_FETCH_BARRIER_BIT
                                                   : GL_SHADER_IMAGE_ACCESS_BARRIER_BIT),
          wanted->isWritten});
    return *this;
}

void Pass::setConstants(std::span<const std::byte> bytes) {
    const ProgramResource* const block = resource("Constants", {Kind::uniformBlock});
    if (!block->isActive) return;
    program_.writeConstants(bytes);
    bindBlock("Constants", program_.constants.name(), nullptr, 0, 0);
}

void Pass::begin(const Buffer* arguments) {
    if (const std::uint64_t missing = interface_.activeResources() & ~bound_; missing != 0) {
        fail(interface_.all()[std::size_t(std::countr_zero(missing))].name, "is not bound");
    }
    if (serial_ != order_.newest()) fail(program_.files.back(), "runs after the next pass has begun");
    GLbitfield needed = 0;
    for (std::size_t i = 0; i < interface_.all().size(); ++i) {
        if (const WriteRecord* const record = uses_[i].record)
            needed |= order_.missing(record->writer, uses_[i].kind, serial_);
    }
    if (arguments != nullptr)
        needed |= order_.missing(arguments->record().writer, GL_COMMAND_BARRIER_BIT, serial_);
    if (needed != 0) order_.makeVisible(needed, serial_);
}

void Pass::end() {
    for (std::size_t i = 0; i < interface_.all().size(); ++i) {
        if (uses_[i].record != nullptr && uses_[i].isWritten) *uses_[i].record = {&order_, serial_};
    }
    if (isInOrder_) serial_ = order_.beginPass();
}

void Pass::dispatch(std::size_t groupsX, std::size_t groupsY, std::size_t groupsZ) {
    begin();
    if (groupsX > 0 && groupsY > 0 && groupsZ > 0)
        glDispatchCompute(GLuint(groupsX), GLuint(groupsY), GLuint(groupsZ));
    end();
}

void Pass::dispatchPixels(int width_px, int height_px) {
    dispatch(std::size_t(width_px + 7) / 8, std::size_t(height_px + 7) / 8);
}

void Pass::dispatchIndirect(const Buffer& arguments, std::size_t offset_bytes) {
    begin(&arguments);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments.name());
    glDispatchComputeIndirect(GLintptr(offset_bytes));
    end();
}

Pass& Pass::into(const Framebuffer& target, const RasterState& state) {
    target.makeVisible();
    target_ = target.name();
    raster_ = state;
    beginPass(target_, raster_);
    return *this;
}

Pass& Pass::state(const RasterState& state) {
    changePass(raster_, state);
    raster_ = state;
    return *this;
}

Pass& Pass::clearColor(int attachment, const std::array<float, 4>& value) {
    glClearNamedFramebufferfv(target_, GL_COLOR, attachment, value.data());
    return *this;
}

Pass& Pass::clearColor(int attachment, const std::array<std::uint32_t, 4>& value) {
    glClearNamedFramebufferuiv(target_, GL_COLOR, attachment, value.data());
    return *this;
}

Pass& Pass::clearDepth(float value) {
    glClearNamedFramebufferfv(target_, GL_DEPTH, 0, &value);
    return *this;
}

Pass& Pass::clearStencil(int value) {
    glClearNamedFramebufferiv(target_, GL_STENCIL, 0, &value);
    return *this;
}

Pass& Pass::vertices(std::string_view input, const VertexSource& source) {
    const ProgramResource* const wanted = resource(input, {Kind::vertexInput});
    if (!wanted->isActive) return *this;
    const GLuint array = program_.vertices.name(), attribute = wanted->unit;
    if (source.buffer == 0) {
        glDisableVertexArrayAttrib(array, attribute);
    } else {
        const std::size_t stride_bytes = source.stride_bytes != 0
                                             ? source.stride_bytes
                                             : std::size_t(wanted->components) * sizeof(GLfloat);
        glEnableVertexArrayAttrib(array, attribute);
        glVertexArrayVertexBuffer(array, attribute, source.buffer, GLintptr(source.offset_bytes),
                                  GLsizei(stride_bytes));
        glVertexArrayBindingDivisor(array, attribute, source.perInstance ? 1 : 0);
    }
    note(*wanted, 0, {nullptr, 0, false});
    return *this;
}

Pass& Pass::vertices(std::string_view input, const Buffer& buffer, VertexSource layout) {
    layout.buffer = buffer.name();
    vertices(input, layout);
    if (const ProgramResource* const wanted = interface_.find(input); wanted->isActive)
        note(*wanted, 0, {&buffer.record(), GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT, false});
    return *this;
}

Pass& Pass::indices(GLuint buffer) {
    glVertexArrayElementBuffer(program_.vertices.name(), buffer);
    return *this;
}

void Pass::beginDrawing(const Buffer* arguments) {
    begin(arguments);
    glBindVertexArray(program_.vertices.name());
    if (arguments != nullptr) glBindBuffer(GL_DRAW_INDIRECT_BUFFER, arguments->name());
}

void Pass::draw(Primitive primitive, std::size_t count, std::size_t first, std::size_t instances) {
    beginDrawing();
    glDrawArraysInstanced(GLenum(primitive), GLint(first), GLsizei(count), GLsizei(instances));
    end();
}

void Pass::drawIndexed(std::size_t count, std::size_t instances, std::size_t firstInstance) {
    beginDrawing();
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, GLsizei(count), GL_UNSIGNED_INT, nullptr,
                                        GLsizei(instances), GLuint(firstInstance));
    end();
}

void Pass::drawIndirect(Primitive primitive, const Buffer& arguments, std::size_t offset_bytes) {
    beginDrawing(&arguments);
    glDrawArraysIndirect(GLenum(primitive), at(offset_bytes));
    end();
}

void Pass::drawIndexedIndirect(const Buffer& arguments, std::size_t offset_bytes) {
    beginDrawing(&arguments);
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, at(offset_bytes));
    end();
}

}  // namespace penumbra::gl
