// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/wedge_raster.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "src/geometry/edge_mesh.h"
#include "src/gl/pass.h"

namespace penumbra::soft_shadow_volumes {
namespace {

std::string shader(std::string_view name) {
    return "src/techniques/soft_shadow_volumes/" + std::string(name) + ".glsl";
}

constexpr const char* wedgeVertices = "src/techniques/soft_shadow_volumes/wedge.vert.glsl";
constexpr int verticesPerWedge = 24;

}  // namespace

WedgeRaster::WedgeRaster(Device& device)
    : device_(internalsOf(device)),
      marks_(device_.shaders, {wedgeVertices, shader("wedge_mark.frag")}),
      points_(device) {
    makeShaders();
}

void WedgeRaster::makeShaders() {
    std::vector<std::string> defines;
    if (layerFormat_ == LayerFormat::splitBytes) defines.emplace_back("SPLIT");
    wedges_ = gl::Program(device_.shaders, {wedgeVertices, shader("wedge.frag")}, defines);
    resolve_ = gl::Program(device_.shaders, {shader("wedge_resolve.comp")}, defines);
    layers_ = {};  // its framebuffer is another one
}

void WedgeRaster::countAsBlockers(VolumeFrame& frame) {
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const EdgeMesh& edges = edgesOf(*frame.sources[i].mesh);
        const bool isClosed = edges.faces().size_bytes() == 2 * edges.edgeCount() * sizeof(uint);
        frame.layersEach[i] = isClosed ? 1 : 2;
    }
}

void WedgeRaster::allocate(glm::ivec2 size_px, bool isTextured, Options options) {
    const auto fit = [&](gl::Texture& texture, gl::Format format, std::string_view label) {
        texture.fit({.width_px = size_px.x, .height_px = size_px.y, .format = format, .label = label});
    };
    const bool isSplit = layerFormat_ == LayerFormat::splitBytes, isColored = isTextured && !isSplit;
    fit(layers_, gl::Format::rg32f, "soft-volumes/V-buffer layers");
    fit(evaluations_, gl::Format::r32f, "soft-volumes/wedges a pixel");
    fit(depthAndMarks_, gl::Format::depth32fStencil8, "soft-volumes/marks");
    if (!isColored) colors_ = {};
    if (!isSplit) {
        additiveBytes_ = {};
        subtractiveBytes_ = {};
    }
    if (isSplit) {
        fit(additiveBytes_, gl::Format::rgba8, "soft-volumes/additive bytes");
        fit(subtractiveBytes_, gl::Format::rgba8, "soft-volumes/subtractive bytes");
        framebuffer_.fit({&evaluations_, &additiveBytes_, &subtractiveBytes_}, &depthAndMarks_,
                         "soft-volumes/V-buffer bytes");
    } else if (isColored) {
        fit(colors_, gl::Format::rgba32f, "soft-volumes/V-buffer colours");
        framebuffer_.fit({&evaluations_, &layers_, &colors_}, &depthAndMarks_,
                         "soft-volumes/V-buffer layers");
    } else {
        framebuffer_.fit({&evaluations_, &layers_}, &depthAndMarks_, "soft-volumes/V-buffer layers");
    }
    if (options.wireframe) {
        fit(wireframe_, gl::Format::r32f, "soft-volumes/wireframe");
        wireframeFramebuffer_.fit({&wireframe_}, nullptr, "soft-volumes/wireframe");
    } else {
        wireframe_ = {};
    }
}

void WedgeRaster::bindEdges(gl::Pass& pass, const FrameBinding& binding, const VolumeCounter& counter) {
    pass.bind(binding)
        .bind("Silhouettes", counter.silhouettes().edges())
        .bind("Layers", counter.layersEach())
        .bind("Commands", counter.silhouettes().commands());
}

void WedgeRaster::bindEvaluation(gl::Pass& pass, const FrameBinding& binding,
                                 const VolumeCounter& counter) const {
    bindEdges(pass, binding, counter);
    pass.bind("liftedDepths", counter.depth()).bind(points_);
}

void WedgeRaster::drawAll(const FrameBinding& binding, const VolumeCounter& counter) const {
    // Back faces alone, so that each wedge is evaluated once a pixel: also where the eye is inside of it.
    gl::Pass pass(wedges_);
    bindEvaluation(pass, binding, counter);
    pass.constants(WedgeConstants{})
        .into(framebuffer_, {.width_px = layers_.width_px(),
                             .height_px = layers_.height_px(),
                             .depthClamp = true,
                             .cull = gl::Cull::front,
                             .blend = gl::Blend::sum})
        .drawIndirect(gl::Primitive::triangles, counter.eye(), offsetof(EyeState, wedges));
}

void WedgeRaster::drawMarked(const VolumeFrame& frame, const FrameBinding& binding,
                             const VolumeCounter& counter, Counting counting) {
    const VolumeConstants& constants = frame.constants;
    depthAndMarks_.clear();
    counter.drawReceiverDepth(framebuffer_, binding, constants.buffer_px);
    using enum gl::StencilOperation;
    const bool isReversed = constants.isReversed != 0, isAutomatic = counting == Counting::automatic;
    gl::RasterState mark{.width_px = constants.buffer_px.x,
                         .height_px = constants.buffer_px.y,
                         .depthTest = isReversed ? gl::Compare::greater : gl::Compare::less,
                         .depthClamp = true,
                         .colorWrite = false};
    // Figure 10: what of the half wedge is before the receiver.
    gl::RasterState before = mark;
    before.stencil = gl::StencilState{.front = {.passes = increment}, .back = {.passes = decrement}};
    // Figure 11: what is behind, which is right wherever the eye is.
    gl::RasterState behind = mark;
    behind.stencil = gl::StencilState{.front = {.depthFails = decrement}, .back = {.depthFails = increment}};
    gl::RasterState evaluate = mark;
    evaluate.depthTest = gl::Compare::always;
    evaluate.cull = gl::Cull::front;
    evaluate.colorWrite = true;
    evaluate.blend = gl::Blend::sum;
    evaluate.stencil = gl::StencilState{
        .compare = gl::Compare::notEqual, .front = {.passes = zero}, .back = {.passes = zero}};

    // Nothing is read back: each edge is drawn that may be a silhouette, and those that are none have no
    // triangles.
    const auto draw = [&](gl::Pass& pass, const gl::RasterState& state, int wedge,
                          const WedgeConstants& how) {
        pass.constants(how)
            .into(framebuffer_, state)
            .draw(gl::Primitive::triangles, verticesPerWedge, std::size_t(verticesPerWedge * wedge));
    };
    const auto markIn = [&](const gl::RasterState& state, int wedge, const WedgeConstants& how) {
        gl::Pass pass(marks_);
        bindEdges(pass, binding, counter);
        draw(pass, state, wedge, how);
    };
    for (int wedge = 0; wedge < int(counter.silhouettes().edgeCount()); ++wedge) {
        for (const int half : {1, -1}) {
            if (counting != Counting::zFail) markIn(before, wedge, {half, isAutomatic ? -1 : 0});
            if (counting != Counting::zPass) markIn(behind, wedge, {half, isAutomatic ? 1 : 0});
            gl::Pass pass(wedges_);
            bindEvaluation(pass, binding, counter);
            draw(pass, evaluate, wedge, {half, 0});
        }
    }
}

void WedgeRaster::drawWireframe(const FrameBinding& binding, const VolumeCounter& counter,
                                glm::ivec2 size_px) const {
    gl::Pass pass(marks_);
    bindEdges(pass, binding, counter);
    pass.constants(WedgeConstants{})
        .into(wireframeFramebuffer_,
              {.width_px = size_px.x, .height_px = size_px.y, .depthClamp = true, .wireframe = true})
        .clearColor(0, std::array<float, 4>{})
        .drawIndirect(gl::Primitive::triangles, counter.eye(), offsetof(EyeState, wedges));
}

void WedgeRaster::clearLayers() {
    for (gl::Texture* texture : {&layers_, &evaluations_, &colors_, &additiveBytes_, &subtractiveBytes_})
        if (texture->name() != 0) texture->clear();
}

void WedgeRaster::resolve(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter,
                          const gl::TextureRef& target) {
    gl::Pass pass(resolve_);
    pass.bind(binding)
        .bind(counter)
        .bind("liftedDepths", counter.depth())
        .bind("wedgeLayers", layers_)
        .bind("visibility", target);
    if (layerFormat_ == LayerFormat::splitBytes) {
        pass.bind("additiveBytes", additiveBytes_).bind("subtractiveBytes", subtractiveBytes_);
    } else {
        pass.bind("wedgeColors", colors_.name() != 0 ? colors_ : evaluations_);
    }
    pass.dispatchPixels(frame.constants.buffer_px.x, frame.constants.buffer_px.y);
}

void WedgeRaster::render(const VolumeFrame& frame, const FrameBinding& binding, const AreaLight& light,
                         const VolumeCounter& counter, Options options, const gl::TextureRef& target,
                         gl::PassTimers& timers) {
    const glm::ivec2 size_px = frame.constants.buffer_px;
    const bool isTextured = light.radianceTexture != 0;
    if (std::exchange(layerFormat_, options.layerFormat) != options.layerFormat) makeShaders();
    allocate(size_px, isTextured, options);
    if (isTextured) points_.place(light, binding, LightPoints::most);
    {
        const auto pass = timers.pass("soft-volumes/wedges");
        clearLayers();
        if (options.marking == Marking::stencil) {
            drawMarked(frame, binding, counter, options.counting);
        } else {
            drawAll(binding, counter);
        }
    }
    if (options.wireframe) {
        const auto pass = timers.pass("soft-volumes/wireframe");
        drawWireframe(binding, counter, size_px);
    }
    const auto pass = timers.pass("soft-volumes/visibility");
    resolve(frame, binding, counter, target);
}

void WedgeRaster::inspect(InspectionVisitor& visitor) const {
    if (layers_.name() == 0) return;
    visitor.texture({.name = "additive and subtractive layers", .texture = layers_.name(), .white = 2});
    if (additiveBytes_.name() != 0) {
        visitor.texture({.name = "additive layer's bytes", .texture = additiveBytes_.name()});
        visitor.texture({.name = "subtractive layer's bytes", .texture = subtractiveBytes_.name()});
    }
    if (colors_.name() != 0) visitor.texture({.name = "layers of each channel", .texture = colors_.name()});
    visitor.texture({.name = "wedges a pixel", .texture = evaluations_.name(), .white = 16});
    if (wireframe_.name() != 0)
        visitor.texture({.name = "wedges as wireframe", .texture = wireframe_.name()});
}

}  // namespace penumbra::soft_shadow_volumes
