// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/gbuffer.h"

#include <algorithm>
#include <array>

#include "src/gl/pass.h"
#include "studio/frame/conversions.h"

namespace penumbra::studio {
namespace {

/// Transforms normals like the inverse transpose does, up to a factor, and exists for flattened instances
/// too.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

}  // namespace

GBuffer::GBuffer(gl::ShaderLibrary& shaders)
    : program_(shaders, {"studio/frame/gbuffer.vert.glsl", "studio/frame/gbuffer.frag.glsl"}),
      glass_(shaders, {"studio/frame/gbuffer.vert.glsl", "studio/frame/glass.frag.glsl"}) {}

void GBuffer::resize(int width_px, int height_px) {
    if (view_.width_px == width_px && view_.height_px == height_px) return;
    const auto make = [&](gl::Format format, std::string_view label) {
        return gl::Texture({.width_px = width_px, .height_px = height_px, .format = format, .label = label});
    };
    depth_ = make(gl::Format::depth32f, "G-buffer depth");
    geometricNormals_ = make(gl::Format::rgba32f, "G-buffer geometric normals");
    shadingNormals_ = make(gl::Format::rgba16f, "G-buffer shading normals");
    albedo_ = make(gl::Format::rgba16f, "G-buffer albedo");
    receivers_ = make(gl::Format::r8, "G-buffer receivers");
    emission_ = make(gl::Format::rgba32f, "G-buffer emission");
    framebuffer_.fit({&geometricNormals_, &shadingNormals_, &albedo_, &receivers_, &emission_}, &depth_,
                     "G-buffer");
    glassFramebuffer_.fit({&albedo_, &emission_}, &depth_, "G-buffer, through glass");
    view_.width_px = width_px;
    view_.height_px = height_px;
    view_.depthTexture = depth_.name();
    view_.normalTexture = geometricNormals_.name();
    view_.receiverTexture = receivers_.name();
    setSmoothTerminator(hasSmoothTerminator_);
}

void GBuffer::setSmoothTerminator(bool isSmooth) {
    hasSmoothTerminator_ = isSmooth;
    view_.shadingNormalTexture = isSmooth ? shadingNormals_.name() : 0;
}

void GBuffer::render(const GpuScene& scene, const CameraView& camera, int width_px, int height_px) {
    const gl::DebugGroup group("G-buffer");
    resize(width_px, height_px);
    view_.viewFromWorld = toPenumbra(glm::mat4(camera.viewFromWorld));
    view_.clipFromView = toPenumbra(glm::mat4(camera.clipFromView));

    gl::RasterState state{
        .width_px = width_px, .height_px = height_px, .depthTest = gl::Compare::greater, .depthWrite = true};
    {
        gl::Pass pass(program_);
        pass.into(framebuffer_, state).clearDepth(0);
        constexpr int attachments = 5;
        for (int i = 0; i < attachments; ++i) pass.clearColor(i, std::array<float, 4>{});
        draw(pass, scene, camera, false);
    }
    if (std::ranges::any_of(scene.drawables(), &GpuScene::Drawable::isGlass)) {
        // What is seen through glass, its light and its shadow, is multiplied by the glass's colour.
        state.depthWrite = false;
        state.blend = gl::Blend::product;
        gl::Pass pass(glass_);
        pass.into(glassFramebuffer_, state);
        draw(pass, scene, camera, true);
    }
}

InstanceConstants GBuffer::constantsOf(const GpuScene::Drawable& drawable, const CameraView& camera) const {
    const Material& material = *drawable.material;
    const glm::dmat4 viewFromMesh = camera.viewFromWorld * glm::dmat4(drawable.worldFromMesh);
    const bool masked = material.alpha == Material::Alpha::mask;
    return {
        .clipFromMesh = camera.clipFromView * viewFromMesh,
        .viewFromMesh = viewFromMesh,
        .worldFromView = glm::inverse(camera.viewFromWorld),
        .viewFromMeshNormal = glm::dmat4(cofactors(glm::dmat3(viewFromMesh))),
        .baseColor = drawable.isGlass() ? glm::vec4(*material.glass, 1) : material.baseColor,
        .emission_nits = material.emission_nits,
        .alphaCutoff = masked ? material.alphaCutoff : -1,
        .hasBaseColorTexture = material.baseColorTexture >= 0,
        .hasEmissionTexture = material.emissionTexture >= 0,
        .hasVertexColors = drawable.colorBuffer != 0,
        .receives = drawable.receives,
        .isUnlit = material.unlit,
        .isOrthographic = camera.orthographic,
    };
}

void GBuffer::draw(gl::Pass& pass, const GpuScene& scene, const CameraView& camera, bool glass) const {
    for (const GpuScene::Drawable& drawable : scene.drawables()) {
        if (drawable.isGlass() != glass) continue;
        const penumbra::Mesh& mesh = *drawable.mesh;
        pass.constants(constantsOf(drawable, camera))
            .vertices("posMesh", {.buffer = mesh.positionBuffer()})
            .vertices("normalMesh", *drawable.normals)
            .vertices("uvMesh", {.buffer = mesh.uvBuffer()})
            .vertices("colorMesh", {.buffer = drawable.colorBuffer})
            .indices(mesh.indexBuffer());
        if (!glass) {
            pass.bind("Positions", gl::HostBuffer{mesh.positionBuffer()})
                .bind("Indices", gl::HostBuffer{mesh.indexBuffer()})
                .bind("baseColorTexture",
                      gl::TextureRef{.name = scene.texture(drawable.material->baseColorTexture)})
                .bind("emissionTexture",
                      gl::TextureRef{.name = scene.texture(drawable.material->emissionTexture)});
        }
        pass.drawIndexed(mesh.indices().size());
    }
}

}  // namespace penumbra::studio
