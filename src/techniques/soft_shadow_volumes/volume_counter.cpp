// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

#include <cstddef>
#include <string>

#include "src/gl/pass.h"

namespace penumbra::soft_shadow_volumes {
namespace {

constexpr const char* folder = "src/techniques/soft_shadow_volumes/";

gl::Program program(Device& device, std::initializer_list<const char*> files) {
    std::vector<std::string> paths;
    for (const char* file : files) paths.push_back(std::string(folder) + file);
    return {internalsOf(device).shaders, paths};
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
      layersEach_("soft-volumes/layers of casters"),
      eye_(sizeof(EyeState), "soft-volumes/eye") {}

void VolumeCounter::allocate(glm::ivec2 size_px) {
    const auto fit = [&](gl::Texture& texture, gl::Format format, std::string_view label) {
        texture.fit({.width_px = size_px.x, .height_px = size_px.y, .format = format, .label = label});
    };
    fit(counts_, gl::Format::r32f, "soft-volumes/counts");
    fit(depth_, gl::Format::depth32f, "soft-volumes/receiver depth");
    framebuffer_.fit({&counts_}, &depth_, "soft-volumes/counts");
}

void VolumeCounter::forgetEye() {
    const EyeState start{};
    eye_.write(std::as_bytes(std::span(&start, 1)));
}

void VolumeCounter::examineEye(const VolumeFrame& frame, const FrameBinding& binding, Counting counting) {
    forgetEye();
    {
        gl::Pass pass(blockers_);
        pass.bind(binding).bind("Eye", eye_);
        for (std::size_t i = 0; i < frame.sources.size(); ++i) {
            const Mesh& mesh = *frame.sources[i].mesh;
            const std::size_t triangles = mesh.indices().size() / 3;
            bindMesh(pass, mesh);
            pass.constants(meshConstants(frame, i, triangles)).dispatch((triangles + 255) / 256);
        }
    }
    const bool hasEdges = silhouettes_.edgeCount() > 0;
    if (hasEdges) {
        gl::Pass(safety_)
            .bind(binding)
            .bind("Silhouettes", silhouettes_.edges())
            .bind("Commands", silhouettes_.commands())
            .bind("Eye", eye_)
            .dispatchIndirect(silhouettes_.commands(), SilhouetteExtractor::dispatchOffset);
    }

    std::pmr::vector<CapCommand> commands{gl::ObjectRegistryScope::frameMemory()};
    for (const SilhouetteSource& source : frame.sources) {
        commands.insert(commands.end(), 2, {GLuint(source.mesh->indices().size()), 0, 0, 0, 0});
    }
    capCommands_.reserve(commands.size() * sizeof(CapCommand), "soft-volumes/caps");
    if (!commands.empty()) capCommands_.write(std::as_bytes(std::span(commands)));
    gl::Pass(choose_)
        .constants(CountingConstants{.casterCount = uint(frame.sources.size()),
                                     .counting = int(counting),
                                     .hasEdges = hasEdges,
                                     .mayHide = frame.mayHide})
        .bind(binding)
        .bind("Commands", silhouettes_.commands())
        .bind("Eye", eye_)
        .bind("Caps", capCommands_)
        .dispatch(commands.size() / 64 + 1);
}

void VolumeCounter::drawSides(const FrameBinding& binding, const gl::RasterState& state,
                              std::size_t commandOffset, float sign) const {
    gl::Pass(sides_)
        .constants(SidesConstants{.sign = sign})
        .bind(binding)
        .bind("Silhouettes", silhouettes_.edges())
        .bind("Layers", layersEach_)
        .into(framebuffer_, state)
        .drawIndirect(gl::Primitive::triangles, eye_, commandOffset);
}

void VolumeCounter::drawCaps(const VolumeFrame& frame, const FrameBinding& binding,
                             const gl::RasterState& state, std::size_t ofPair, float sign) const {
    gl::Pass pass(caps_);
    pass.bind(binding).into(framebuffer_, state);
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        MeshConstants constants = meshConstants(frame, i, 0);
        constants.sign = sign;
        bindMesh(pass, *frame.sources[i].mesh);
        pass.constants(constants).drawIndirect(gl::Primitive::triangles, capCommands_,
                                               (2 * i + ofPair) * sizeof(CapCommand));
    }
}

void VolumeCounter::drawReceiverDepth(const gl::Framebuffer& framebuffer, const FrameBinding& binding,
                                      glm::ivec2 size_px) const {
    gl::Pass(depthCopy_)
        .bind(binding)
        .into(framebuffer, {.width_px = size_px.x,
                            .height_px = size_px.y,
                            .depthTest = gl::Compare::always,
                            .depthWrite = true,
                            .colorWrite = false})
        .draw(gl::Primitive::triangles, 3);
}

void VolumeCounter::renderReceivers(const VolumeFrame& frame, const FrameBinding& binding) {
    allocate(frame.constants.buffer_px);
    forgetEye();
    drawReceiverDepth(framebuffer_, binding, frame.constants.buffer_px);
}

void VolumeCounter::render(const VolumeFrame& frame, const FrameBinding& binding, Counting counting) {
    const VolumeConstants& constants = frame.constants;
    allocate(constants.buffer_px);
    silhouettes_.extract(frame.sources, frame.center(), {.verticesPerEdge = 6, .instances = 1});
    layersEach_.write(frame.layersEach);
    examineEye(frame, binding, counting);
    drawReceiverDepth(framebuffer_, binding, constants.buffer_px);

    const bool isReversed = constants.isReversed != 0;
    const gl::RasterState before =
        countingState(constants, isReversed ? gl::Compare::greater : gl::Compare::less);
    const gl::RasterState behind =
        countingState(constants, isReversed ? gl::Compare::lessEqual : gl::Compare::greaterEqual);
    counts_.clear();
    drawSides(binding, before, offsetof(EyeState, passSides), 1);
    if (frame.mayHide) drawCaps(frame, binding, before, 0, 1);
    drawSides(binding, behind, offsetof(EyeState, failSides), -1);
    drawCaps(frame, binding, behind, 1, -1);
}

void VolumeCounter::bindTo(gl::Pass& pass) const {
    pass.bind("volumeCounts", counts_).bind("Eye", eye_);
}

}  // namespace penumbra::soft_shadow_volumes
