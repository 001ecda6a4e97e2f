// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/camera_view.h"

#include <algorithm>
#include <cmath>

namespace penumbra::studio {

CameraView makeCameraView(const Camera& camera, const Bounds& bounds, int width_px, int height_px) {
    CameraView view;
    view.viewFromWorld = glm::inverse(glm::dmat4(camera.worldFromCamera));
    view.orthographic = camera.orthographicHeight_m.has_value();
    const double aspect = double(width_px) / height_px;
    const glm::dvec3 centerView = view.viewFromWorld * glm::dvec4(bounds.center(), 1);
    const double radius_m = std::max(1e-6, double(bounds.radius()));

    glm::dmat4& clip = view.clipFromView;
    clip = glm::dmat4(0);
    if (view.orthographic) {
        const double halfHeight_m = 0.5 * *camera.orthographicHeight_m;
        // Everything in front of the camera; its own plane is where the range starts.
        const double far_m = std::max(1e-6, radius_m - centerView.z) * 1.01;
        clip[0][0] = 1 / (halfHeight_m * aspect);
        clip[1][1] = 1 / halfHeight_m;
        clip[2][2] = 1 / far_m;
        clip[3] = {0, 0, 1, 1};
    } else {
        // Reversed float depth is as precise with a near plane this close as with any.
        const double near_m = 1e-4 * std::min(radius_m, glm::length(centerView) + 0.1 * radius_m);
        const double focal = 1 / std::tan(0.5 * camera.yfov_rad);
        clip[0][0] = focal / aspect;
        clip[1][1] = focal;
        clip[2][3] = -1;
        clip[3][2] = near_m;
    }
    return view;
}

}  // namespace penumbra::studio
