// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/gbuffer.h"

#include <algorithm>
#include <array>

#include "src/gl/raster_state.h"
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
      glass_(shaders, {"studio/frame/gbuffer.vert.glsl", "studio/frame/glass.frag.glsl"}),
      vertices_(gl::makeFloatVertexArray(3, 3, 2, 3)),
      constants_("G-buffer instance") {}

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
    framebuffer_ = gl::Framebuffer({&geometricNormals_, &shadingNormals_, &albedo_, &receivers_, &emission_},
                                   &depth_, "G-buffer");
    glassFramebuffer_ = gl::Framebuffer({&albedo_, &emission_}, &depth_, "G-buffer, through glass");
    view_.width_px = width_px;
    view_.height_px = height_px;
    view_.depthTexture = depth_.name();
    view_.normalTexture = geometricNormals_.name();
    view_.receiverTexture = receivers_.name();
}

void GBuffer::render(const GpuScene& scene, const CameraView& camera, int width_px, int height_px) {
    const gl::DebugGroup group("G-buffer");
    resize(width_px, height_px);
    view_.viewFromWorld = toPenumbra(glm::mat4(camera.viewFromWorld));
    view_.clipFromView = toPenumbra(glm::mat4(camera.clipFromView));

    gl::beginPass(framebuffer_.name(), {.width_px = width_px,
                                        .height_px = height_px,
                                        .depthTest = gl::Compare::greater,
                                        .depthWrite = true});
    constexpr std::array<float, 4> zero{};
    for (GLint buffer = 0; buffer < 5; ++buffer) {
        glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, buffer, zero.data());
    }
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, zero.data());

    program_.use();
    draw(scene, camera, false);
    if (std::ranges::any_of(scene.drawables(), &GpuScene::Drawable::isGlass)) {
        // What is seen through glass, its light and its shadow, is multiplied by the glass's colour.
        gl::beginPass(glassFramebuffer_.name(), {.width_px = width_px,
                                                 .height_px = height_px,
                                                 .depthTest = gl::Compare::greater,
                                                 .blend = gl::Blend::product});
        glass_.use();
        draw(scene, camera, true);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
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
        .emission = glm::vec4(material.emission_nits, material.emissionTexture >= 0),
        .alpha = {masked ? material.alphaCutoff : -1, drawable.colorBuffer != 0, 0, 0},
        .flags = {material.baseColorTexture >= 0, drawable.receives, material.unlit, camera.orthographic},
    };
}

void GBuffer::draw(const GpuScene& scene, const CameraView& camera, bool glass) {
    glBindVertexArray(vertices_.name());
    constants_.bindUniform(0);
    for (const GpuScene::Drawable& drawable : scene.drawables()) {
        if (drawable.isGlass() != glass) continue;
        constants_.write(constantsOf(drawable, camera));
        const penumbra::Mesh& mesh = *drawable.mesh;
        gl::attachFloats(vertices_.name(), 0, mesh.positionBuffer(), 3);
        gl::attachFloats(vertices_.name(), 1, drawable.normals->name(), 3);
        gl::attachFloats(vertices_.name(), 2, mesh.uvBuffer(), 2);
        gl::attachFloats(vertices_.name(), 3, drawable.colorBuffer, 3);
        glVertexArrayElementBuffer(vertices_.name(), mesh.indexBuffer());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, mesh.positionBuffer());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, mesh.indexBuffer());
        glBindTextureUnit(0, scene.texture(drawable.material->baseColorTexture));
        glBindTextureUnit(1, scene.texture(drawable.material->emissionTexture));
        glDrawElements(GL_TRIANGLES, GLsizei(mesh.indices().size()), GL_UNSIGNED_INT, nullptr);
    }
}

}  // namespace penumbra::studio
