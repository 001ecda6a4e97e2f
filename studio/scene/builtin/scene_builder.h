// SPDX-License-Identifier: Apache-2.0
// Puts a scene together from meshes, and moves it by formulas.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// What a mesh does to the light that meets it.
enum class Role {
    both,          ///< casts and receives
    receiverOnly,  ///< casts nothing
};

/// Where a mesh is at a time.
using Pose = std::function<glm::mat4(double time_s)>;

/// A pose that stays: translation, then (if given) a rotation by `angle_rad` about `axis` around the mesh's
/// origin.
Pose at(const glm::vec3& position, float angle_rad = 0, const glm::vec3& axis = {0, 1, 0});

/// Weights of a mesh's morph targets at a time, one a target.
using MorphPose = std::function<std::vector<float>(double time_s)>;

class SceneBuilder {
  public:
    explicit SceneBuilder(std::string name);

    /// Adds a mesh of one colour (linear Rec. 709) and returns its index, to be placed any number of times.
    int mesh(std::string name, Mesh mesh, const glm::vec3& color);

    /// Adds a node of this name with the mesh; a mesh with morph targets needs `morph`.
    void place(std::string node, int mesh, Pose pose, Role role = Role::both, MorphPose morph = {});

    /// Adds a square ground of `size_m` at y = 0, which casts and receives.
    void ground(float size_m);

    /// Adds a picture with a clamped sampler and returns the texture's index.
    int texture(Picture picture);

    void light(Light light) { lights_.push_back(std::move(light)); }
    void camera(Camera camera) { cameras_.push_back(std::move(camera)); }

    /// Everything repeats after `duration_s`; poses are asked for times in [0, duration_s) only.
    void loop(std::string name, double duration_s);

    Scene build() &&;

    struct Part {
        int mesh = 0;
        Role role = Role::both;
        Pose pose;
        MorphPose morph;
    };

  private:
    Scene scene_;
    std::vector<Part> parts_;
    std::vector<Light> lights_;
    std::vector<Camera> cameras_;
};

}  // namespace penumbra::studio
