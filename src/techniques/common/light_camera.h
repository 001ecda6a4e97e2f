// SPDX-License-Identifier: Apache-2.0
// Cameras that look from a point of the light at what it can shadow: where shadow maps of every kind are
// drawn from.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "penumbra/technique.h"
#include "src/gl/gl.h"
#include "src/techniques/common/inline_vector.h"
#include "src/techniques/common/light_camera_io.h"
#include "src/techniques/common/light_io.h"

namespace penumbra {

/// What the light may shadow: the visible part of everything that receives, in light space.
struct ReceiverRegion {
    /// A face of a hexahedron has four corners, and each of the planes that cut it (a frustum's or a box's
    /// six, the light's, a cube face's four, the near plane) adds one: 16. Where corners fall together,
    /// rounding may let a plane cross the border more than twice.
    using Polygon = InlineVector<glm::dvec3, 24>;
    using Polygons = std::pmr::vector<Polygon>;
    /// The surfaces of convex pieces, each the intersection of a receiver's box with the view frustum.
    Polygons polygons{gl::ObjectRegistryScope::frameMemory()};
};

/// Corners of a caster's bounding box in light space; none for an empty mesh.
using BoxCorners = std::array<glm::dvec3, 8>;

/// The boxes of casters in light space, and the receivers among what the view sees.
struct LightSpaceScene {
    /// One a caster, in their order; empty meshes have NaN corners.
    std::pmr::vector<BoxCorners> boxes{gl::ObjectRegistryScope::frameMemory()};
    std::pmr::vector<glm::dmat4> lightFromMesh{gl::ObjectRegistryScope::frameMemory()};  ///< one a caster
    ReceiverRegion receivers;
    LightConstants light{};
    /// Of a place (x, y, z, 1), its dot product is the size of a pixel there, in metres.
    glm::dvec4 pixelSize_m{0};
};

/// Computes the above. `lightFromWorld` as from view_constants.h.
LightSpaceScene makeLightSpaceScene(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld);

/// The receivers in parts whose pixels differ in size by a factor of 2 at least, the smallest pixels first;
/// the first part takes whatever has smaller pixels than `mostParts` tell apart. One part where texels of
/// `texel_m` are no larger than the smallest pixel.
std::pmr::vector<ReceiverRegion::Polygons> partsByPixelSize(const LightSpaceScene& scene, double texel_m,
                                                            int mostParts);

/// The axis of the narrowest cone around unit vectors, nearly. There must be at least one.
glm::dvec3 coneAxis(std::span<const glm::dvec3> directions);

/// A camera in face space: x to the right, y up, z along the axis it looks. Perspective cameras have the
/// light's point at the origin and a window in tangents (x/z, y/z); orthographic ones a window in metres.
struct LightCamera {
    glm::dmat4 faceFromLight{1};
    glm::dvec2 windowMin{0}, windowMax{0};
    bool orthographic = false;
    double near_m = 0;  ///< perspective: depth 1, and the nearest caster that is seen; orthographic: likewise
    double far_m = 0;   ///< orthographic only: depth 0

    /// Reversed depth: 1 at near_m, 0 at infinity (perspective) or at far_m (orthographic).
    glm::dmat4 clipFromLight() const;
    LightCameraConstants constants(int mapSize_px) const;
    /// False only if nothing inside `box` can be seen.
    bool mightSee(const BoxCorners& box) const;
};

struct LightCameraOptions {
    glm::dvec3 originLight{0};  ///< the point of the light to look from
    int mapSize_px = 1024;      ///< windows get a border of two texels
    double margin = 0;          ///< added around each window, in tangents or metres
    bool steadyAxis = false;    ///< from a grid of directions, so that small moves of the view keep the axis
    /// Distant lights: several cameras, the finest first, where a texel of one would be larger than the
    /// pixels that it serves.
    bool splits = false;
};

/// One, or a cube's faces.
using LightCameras = InlineVector<LightCamera, 6>;

/// Cameras that together see every receiver: one perspective where its field of view stays below 120 degrees,
/// faces of a cube around the light where not, one orthographic camera for distant lights, or several for
/// parts of the picture that are alike in the size of their pixels. Each window is fitted to the receivers in
/// it. None where nothing receives.
LightCameras fitLightCameras(const AreaLight& light, const LightSpaceScene& scene,
                             const LightCameraOptions& options);

}  // namespace penumbra
