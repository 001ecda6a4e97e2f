// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/scene/gltf/nodes.h"

namespace penumbra::studio::gltf {

/// Values over time ("Animations", glTF 2.0 section 3.11 and appendix C).
struct Track {
    enum class Interpolation { step, linear, cubicSpline };

    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s;  ///< strictly increasing, >= 0, at least one
    std::size_t width = 1;       ///< floats a value
    std::vector<float> values;   ///< one a key; cubic splines: in-tangent, value, out-tangent

    /// Clamped to the first and last key. Rotations are interpolated on the sphere unless cubic; the result
    /// need not be of unit length.
    std::vector<float> at(float time_s, bool isRotation) const;
};

struct Channel {
    enum class Path { translation, rotation, scale, weights };

    int node = 0;
    Path path = Path::translation;
    Track track;
};

/// Describes all animations of the file in scene.animations, and returns the channels of those that play
/// (GltfOptions::animations), later ones last.
std::vector<Channel> loadAnimations(const JsonView& root, const Accessors& accessors,
                                    const Hierarchy& hierarchy, const std::vector<MeshGroup>& meshes,
                                    const std::optional<std::vector<int>>& wanted, Budget& budget,
                                    Scene& scene);

}  // namespace penumbra::studio::gltf
