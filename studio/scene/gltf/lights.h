// SPDX-License-Identifier: Apache-2.0
// Lights and cameras: what the file says of them, and what they are where their node stands.
#pragma once

#include "studio/scene/gltf/nodes.h"

namespace penumbra::studio::gltf {

/// What a node's scale does to the size of its light.
enum class LightSize {
    itsOwn,          ///< nothing: metres are metres
    scalesWithNode,  ///< the largest of its factors multiplies it
};

/// A light or camera and the node that carries it. Its own transform is left at the identity.
struct PlacedLight {
    int node = 0;
    Light light;
    LightSize size = LightSize::itsOwn;
};
struct PlacedCamera {
    int node = 0;
    Camera camera;
};

/// `luminaires` (of EXT_lights_ies), the lights of EXT_lights_area and of KHR_lights_punctual, no two of one
/// name. One that makes no sense is left out with a warning.
std::vector<PlacedLight> loadLights(const JsonView& root, const Hierarchy& hierarchy,
                                    std::vector<PlacedLight> luminaires, Scene& scene);

std::vector<PlacedCamera> loadCameras(const JsonView& root, const Hierarchy& hierarchy);

/// Rotation and translation of an affine matrix: -Z is kept, then as much of +Y as possible.
glm::mat4 rigidPart(const glm::mat4& affine);

/// The largest factor by which an affine matrix stretches an axis.
float largestScale(const glm::mat4& affine);

Light lightAt(const PlacedLight& placed, const glm::mat4& worldFromNode);
Camera cameraAt(const PlacedCamera& placed, const glm::mat4& worldFromNode);

}  // namespace penumbra::studio::gltf
