// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/offset_undoing.h"

#include "src/device/glm_types.h"
#include "src/gl/pass.h"
#include "src/hosting/offset_undoing_io.h"
#include "src/hosting/stored_depth.h"

namespace penumbra {

OffsetUndoing::OffsetUndoing(Device::Internals& device)
    : program_(device.shaders, {"src/hosting/offset_undoing.comp.glsl"}) {}

void OffsetUndoing::run(View& plain, const View& view, const CasterPainter* casters) {
    const bool hasNormals = plain.normalTexture != 0;
    const glm::dmat4 worldFromDepth =
        glm::inverse(toGlm(view.clipFromView) * toGlm(view.viewFromWorld)) * clipFromStored(view.depth);
    undone_.fit({.width_px = view.width_px,
                 .height_px = view.height_px,
                 .format = gl::Format::r32f,
                 .label = "depth without polygon offset"});
    // Bound in any case, and written only where it is needed.
    normals_.fit({.width_px = hasNormals ? 1 : view.width_px,
                  .height_px = hasNormals ? 1 : view.height_px,
                  .format = gl::Format::rgba32f,
                  .label = "normals beneath polygon offset"});
    gl::Pass(program_)
        .constants(OffsetUndoingConstants{
            .worldFromDepth = worldFromDepth,
            .depthPlaneFromWorld = glm::transpose(worldFromDepth),
            .worldPlaneFromDepth = glm::transpose(glm::inverse(worldFromDepth)),
            .size_px = {view.width_px, view.height_px},
            .factor = view.polygonOffset.factor,
            .units = view.polygonOffset.units,
            // What the host drew into decides, and not a copy of it.
            .leastDifference = float(fixedDepthStep(view.depthTexture)),
            .background = view.depth.reversed ? 0.0f : 1.0f,
            .hasNormals = hasNormals,
            .hasCasters = casters != nullptr,
        })
        .bind("normals", gl::TextureRef{.name = plain.normalTexture})
        .bind("depths", gl::TextureRef{.name = plain.depthTexture})
        .bind("casterPixels", casters ? casters->pixels().ref() : gl::TextureRef{})
        .bind("casterSlopes", casters ? casters->slopes().ref() : gl::TextureRef{})
        .bind("undone", undone_)
        .bind("undoneNormals", normals_)
        .dispatchPixels(view.width_px, view.height_px);
    plain.depthTexture = undone_.name();
    if (!hasNormals) plain.normalTexture = normals_.name();
    plain.polygonOffset = {};
}

}  // namespace penumbra
