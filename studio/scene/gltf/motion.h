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
        glm::dmat4 worldFromFile{1};  ///< unit and axes
        Hierarchy hierarchy;
        std::vector<MeshGroup> meshes;
        std::vector<Channel> channels;  ///< of the animations that play
        std::vector<PlacedLight> lights;
        std::vector<PlacedCamera> cameras;
    };

    /// Throws PlaceError where the rest pose overflows. `scene` is the scene that moves, complete but for its
    /// motion and worldFromFile, which is set here.
    GltfMotion(Parts parts, Budget& budget, Scene& scene);

    /// Throws InputError where the animation overflows.
    SceneMoment at(const Scene& scene, double time_s) const override;

  private:
    struct Pose {
        std::vector<glm::dmat4> worldFromNode;
        std::vector<std::vector<float>> weights;  ///< of each node; empty: its mesh's own
    };
    struct Placement {
        int node = 0;
        std::size_t copy = 0;  ///< which of the node's, where it has any
        MeshGroup::Part part;
        glm::dvec3 origin{0};  ///< MeshGroup::origin
        glm::mat4 restWorldFromMesh{1};
        Bounds restBounds;  ///< in the world; of rigid instances only
    };

    void comeNear(const Scene& scene);
    Pose poseAt(double time_s) const;
    glm::dmat4 worldFromMesh(const Placement& placement, const Pose& pose) const;
    Instance instanceAt(const Scene& scene, const Placement& placement, const Pose& pose) const;
    void deform(const Mesh& mesh, const Placement& placement, const Pose& pose, Instance& instance) const;

    Parts parts_;
    std::vector<Placement> placements_;
};

}  // namespace penumbra::studio::gltf
