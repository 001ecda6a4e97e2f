// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "studio/scene/gltf/animation.h"
#include "studio/scene/gltf/lights.h"

namespace penumbra::studio::gltf {

/// A loaded file as it moves: node transforms, then skins and morph targets, at a time.
class GltfMotion : public Scene::Motion {
  public:
    struct Parts {
        std::filesystem::path file;
        Hierarchy hierarchy;
        std::vector<MeshGroup> meshes;
        Clip clip;
        std::vector<PlacedLight> lights;
        std::vector<PlacedCamera> cameras;
    };

    /// Throws PlaceError where the rest pose overflows. `scene` is the scene that moves, complete but for its
    /// motion.
    GltfMotion(Parts parts, Budget& budget, Scene& scene);

    /// Throws InputError where the animation overflows.
    SceneMoment at(const Scene& scene, double time_s) const override;

  private:
    struct Pose {
        std::vector<glm::mat4> worldFromNode;
        std::vector<std::vector<float>> weights;  ///< of each node; empty: its mesh's own
    };
    struct Placement {
        int node = 0;
        MeshGroup::Part part;
        glm::mat4 restWorldFromMesh{1};
        Bounds restBounds;  ///< in the world; of rigid instances only
    };

    Pose poseAt(double time_s) const;
    Instance instanceAt(const Scene& scene, const Placement& placement, const Pose& pose) const;
    void deform(const Mesh& mesh, const Placement& placement, const Pose& pose, Instance& instance) const;

    Parts parts_;
    std::vector<Placement> placements_;
};

}  // namespace penumbra::studio::gltf
