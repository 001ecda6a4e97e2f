// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/smooth_surface.h"

#include "src/device/glm_types.h"
#include "src/gl/pass.h"
#include "src/hosting/smooth_surface_io.h"
#include "src/hosting/stored_depth.h"

namespace penumbra {

SmoothSurface::SmoothSurface(Device::Internals& device)
    : program_(device.shaders, {"src/hosting/smooth_surface.comp.glsl"}) {}

void SmoothSurface::run(View& view) {
    const glm::dmat4 clipFromDepth = clipFromStored(view.depth);
    const glm::dmat4 clipFromView = toGlm(view.clipFromView);
    const auto fit = [&](gl::Texture& texture, gl::Format format, const char* label) {
        texture.fit(
            {.width_px = view.width_px, .height_px = view.height_px, .format = format, .label = label});
    };
    fit(depths_, gl::Format::r32f, "depth of the smooth surface");
    fit(normals_, gl::Format::rgba32f, "normals of the smooth surface");
    gl::Pass(program_)
        .constants(SmoothSurfaceConstants{
            .viewFromDepth = glm::inverse(clipFromView) * clipFromDepth,
            .depthFromView = glm::inverse(clipFromDepth) * clipFromView,
            .viewFromWorld = toGlm(view.viewFromWorld),
            .size_px = {view.width_px, view.height_px},
            .background = view.depth.reversed ? 0.0f : 1.0f,
            .isOrthographic = clipFromView[0][3] == 0 && clipFromView[1][3] == 0 && clipFromView[2][3] == 0,
        })
        .bind("depths", gl::TextureRef{.name = view.depthTexture})
        .bind("normals", gl::TextureRef{.name = view.normalTexture})
        .bind("shadingNormals", gl::TextureRef{.name = view.shadingNormalTexture})
        .bind("smoothDepths", depths_)
        .bind("smoothNormals", normals_)
        .dispatchPixels(view.width_px, view.height_px);
    view.depthTexture = depths_.name();
    view.normalTexture = normals_.name();
    view.shadingNormalTexture = 0;
}

}  // namespace penumbra
