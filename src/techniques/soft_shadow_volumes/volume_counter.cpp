// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "src/gl/raster_state.h"

namespace penumbra {
namespace {

constexpr const char* folder = "src/techniques/soft_shadow_volumes/";

gl::Program program(Device& device, std::initializer_list<const char*> files) {
    std::vector<std::string> paths;
    for (const char* file : files) paths.push_back(std::string(folder) + file);
    return {device.internals().shaders, paths};
}

struct CapCommand {
    GLuint count, instanceCount, first, baseInstance, unused;
};

gl::RasterState countingState(const VolumeConstants& constants, gl::Compare depthTest) {
    return {.width_px = constants.buffer_px.x,
            .height_px = constants.buffer_px.y,
            .depthTest = depthTest,
            .depthClamp = true,
            .blend = gl::Blend::sum};
}

}  // namespace

void describeCounting(ParameterVisitor& visitor, int& counting) {
    static constexpr std::array<std::string_view, 3> countings = {"auto", "z-pass", "z-fail"};
    visitor.choice(
        {.name = "counting",
         .help = "which sides of shadow volumes are counted: auto takes z-pass, the cheaper one, unless the "
                 "eye lies within rounding of a side"},
        counting, countings);
}

VolumeCounter::VolumeCounter(Device& device)
    : silhouettes_(device),
      blockers_(program(device, {"eye_blockers.comp.glsl"})),
      safety_(program(device, {"eye_safety.comp.glsl"})),
      choose_(program(device, {"choose_counting.comp.glsl"})),
      depthCopy_(program(device, {"receiver_depth.vert.glsl", "receiver_depth.frag.glsl"})),
      sides_(program(device, {"volume_sides.vert.glsl", "volume.frag.glsl"})),
      caps_(program(device, {"volume_caps.vert.glsl", "volume.frag.glsl"})),
      noVertices_(gl::makeFloatVertexArray()),
      layersEach_("soft-volumes/layers of casters"),
      eye_(sizeof(EyeState), "soft-volumes/eye") {}

void VolumeCounter::allocate(int width_px, int height_px) {
    if (counts_.name() != 0 && counts_.width_px() == width_px && counts_.height_px() == height_px) return;
    counts_ = {};
    depth_ = {};
    counts_ = gl::Texture({.width_px = width_px,
                           .height_px = height_px,
                           .format = gl::Format::r32f,
                           .label = "soft-volumes/counts"});
    depth_ = gl::Texture({.width_px = width_px,
                          .height_px = height_px,
                          .format = gl::Format::depth32f,
                          .label = "soft-volumes/receiver depth"});
    framebuffer_ = gl::Framebuffer({&counts_}, &depth_, "soft-volumes/counts");
}

void VolumeCounter::forgetEye() {
    const EyeState start{};
    eye_.write(std::as_bytes(std::span(&start, 1)));
}

void VolumeCounter::examineEye(const VolumeFrame& frame, Counting counting) {
    forgetEye();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, eye_.name());

    blockers_.use();
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const SilhouetteSource& source = frame.sources[i];
        const GLuint triangles = GLuint(source.mesh->indices().size() / 3);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, source.mesh->positionBuffer());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, source.mesh->indexBuffer());
        glUniformMatrix4dv(0, 1, GL_FALSE, glm::value_ptr(source.lightFromMesh));
        glUniform1ui(4, triangles);
        glUniform1i(5, frame.layersEach[i]);
        glDispatchCompute((triangles + 255) / 256, 1, 1);
    }

    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, silhouettes_.commands().name());
    const bool hasEdges = silhouettes_.edgeCount() > 0;
    if (hasEdges) {
        safety_.use();
        silhouettes_.bindEdges(0);
        gl::dispatchIndirect(silhouettes_.commands(), SilhouetteExtractor::dispatchOffset);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    std::pmr::vector<CapCommand> commands{gl::LedgerScope::frameMemory()};
    for (const SilhouetteSource& source : frame.sources) {
        commands.insert(commands.end(), 2, {GLuint(source.mesh->indices().size()), 0, 0, 0, 0});
    }
    const std::size_t size_bytes = commands.size() * sizeof(CapCommand);
    if (capCommands_.name() == 0 || capCommands_.size_bytes() < size_bytes) {
        capCommands_ = gl::Buffer(size_bytes, "soft-volumes/caps");
    }
    if (!commands.empty()) capCommands_.write(std::as_bytes(std::span(commands)));
    choose_.use();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, capCommands_.name());
    glUniform1ui(0, GLuint(frame.sources.size()));
    glUniform1i(1, int(counting));
    glUniform1i(2, hasEdges);
    glUniform1i(3, frame.mayHide);
    glDispatchCompute(GLuint(commands.size() / 64 + 1), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void VolumeCounter::drawSides(std::size_t commandOffset, float sign) const {
    sides_.use();
    silhouettes_.bindEdges(0);
    layersEach_.bind(1);
    glUniform1f(0, sign);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, eye_.name());
    // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset, as OpenGL has it
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(commandOffset));
}

void VolumeCounter::drawCaps(const VolumeFrame& frame, std::size_t ofPair, float sign) const {
    caps_.use();
    glUniform1f(5, sign);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, capCommands_.name());
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const SilhouetteSource& source = frame.sources[i];
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, source.mesh->positionBuffer());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, source.mesh->indexBuffer());
        glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(glm::mat4(source.lightFromMesh)));
        glUniform1i(4, frame.layersEach[i]);
        // NOLINTNEXTLINE(performance-no-int-to-ptr)
        glDrawArraysIndirect(GL_TRIANGLES,
                             reinterpret_cast<const void*>((2 * i + ofPair) * sizeof(CapCommand)));
    }
}

void VolumeCounter::drawReceiverDepth(GLuint framebuffer, glm::ivec2 size_px) const {
    glBindVertexArray(noVertices_.name());
    gl::beginPass(framebuffer, {.width_px = size_px.x,
                                .height_px = size_px.y,
                                .depthTest = gl::Compare::always,
                                .depthWrite = true,
                                .colorWrite = false});
    depthCopy_.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void VolumeCounter::renderReceivers(const VolumeFrame& frame) {
    const glm::ivec2 size_px(frame.constants.buffer_px);
    allocate(size_px.x, size_px.y);
    forgetEye();
    drawReceiverDepth(framebuffer_.name(), size_px);
}

void VolumeCounter::render(const VolumeFrame& frame, Counting counting) {
    const VolumeConstants& constants = frame.constants;
    allocate(constants.buffer_px.x, constants.buffer_px.y);
    silhouettes_.extract(frame.sources, frame.center(), {.verticesPerEdge = 6, .instances = 1});
    layersEach_.write(frame.layersEach);
    examineEye(frame, counting);

    drawReceiverDepth(framebuffer_.name(), glm::ivec2(constants.buffer_px));

    const bool reversed = constants.buffer_px.w == 1;
    const float zero = 0;
    gl::beginPass(framebuffer_.name(),
                  countingState(constants, reversed ? gl::Compare::greater : gl::Compare::less));
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, &zero);
    drawSides(offsetof(EyeState, passSides), 1);
    if (frame.mayHide) drawCaps(frame, 0, 1);
    gl::beginPass(framebuffer_.name(),
                  countingState(constants, reversed ? gl::Compare::lessEqual : gl::Compare::greaterEqual));
    drawSides(offsetof(EyeState, failSides), -1);
    drawCaps(frame, 1, -1);
}

void VolumeCounter::bind(unsigned unit, unsigned block) const {
    counts_.bind(unit);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, eye_.name());
}

}  // namespace penumbra
