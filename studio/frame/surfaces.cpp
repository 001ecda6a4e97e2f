// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/surfaces.h"

#include <limits>

#include "studio/frame/conversions.h"
#include "studio/frame/frame_renderer.h"

namespace penumbra::studio {

Image readDepth(const View& view) {
    Image bottomUp(view.width_px, view.height_px, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(view.depthTexture, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                      GLsizei(bottomUp.values.size() * sizeof(float)), bottomUp.values.data());
    Image depth(view.width_px, view.height_px, 1);
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) depth.at(x, y) = bottomUp.at(x, view.height_px - 1 - y);
    }
    return depth;
}

double clipZ(const DepthConvention& convention, float stored) {
    return convention.range == DepthConvention::Range::zeroToOne ? stored : 2.0 * stored - 1.0;
}

Surfaces readSurfaces(const View& view) {
    Surfaces surfaces{.depth_m = readDepth(view),
                      .normals = readTexture(view.normalTexture, view.width_px, view.height_px, 3)};
    const glm::dmat4 viewFromClip = glm::inverse(glm::dmat4(fromPenumbra(view.clipFromView)));
    for (float& depth : surfaces.depth_m.values) {
        // No projection of ours tilts the planes of equal depth: any place of the picture will do.
        const glm::dvec4 posView = viewFromClip * glm::dvec4(0, 0, clipZ(view.depth, depth), 1);
        depth = depth == backgroundOf(view.depth) ? std::numeric_limits<float>::infinity()
                                                  : float(-posView.z / posView.w);
    }
    return surfaces;
}

}  // namespace penumbra::studio
