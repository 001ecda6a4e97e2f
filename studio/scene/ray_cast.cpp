// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/ray_cast.h"

#include <array>
#include <utility>

namespace penumbra::studio {

std::vector<RayTriangle> rayTriangles(const Scene& scene, const SceneMoment& moment,
                                      const std::function<bool(const Instance&)>& takes) {
    std::vector<RayTriangle> triangles;
    for (const Instance& instance : moment.instances) {
        if (!takes(instance)) continue;
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const std::vector<glm::vec3>& positions =
            instance.positions.empty() ? mesh.positions : instance.positions;
        const bool isMirrored = glm::determinant(glm::mat3(instance.worldFromMesh)) < 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::array<glm::vec3, 3> corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = instance.worldFromMesh * glm::vec4(positions[mesh.indices[i + k]], 1);
            if (isMirrored) std::swap(corners[1], corners[2]);
            triangles.push_back(
                {corners[0], corners[1] - corners[0], corners[2] - corners[0], instance.node});
        }
    }
    return triangles;
}

// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
RayHit nearestHit(std::span<const RayTriangle> triangles, const glm::vec3& from, const glm::vec3& direction) {
    RayHit hit;
    for (const RayTriangle& triangle : triangles) {
        const glm::vec3 p = glm::cross(direction, triangle.ac);
        const float determinant = glm::dot(triangle.ab, p);
        if (determinant == 0) continue;
        const glm::vec3 s = from - triangle.a, q = glm::cross(s, triangle.ab);
        const float u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant,
                    t = glm::dot(triangle.ac, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < hit.distance_m)
            hit = {t, determinant > 0, triangle.node};
    }
    return hit;
}

}  // namespace penumbra::studio
