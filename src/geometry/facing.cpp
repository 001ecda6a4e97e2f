// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/facing.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

glm::vec4 lightPointInMesh(const glm::dmat4& lightFromMesh, const LightPoint& pointLight) {
    const glm::dmat3 linear(lightFromMesh);
    const glm::dvec3 x = linear[0], y = linear[1], z = linear[2];
    const glm::dmat3 adjugate =
        glm::transpose(glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)));
    const glm::dvec3 offset = glm::dvec3(pointLight) - pointLight.w * glm::dvec3(lightFromMesh[3]);
    const glm::dvec4 point(adjugate * offset, pointLight.w * glm::dot(x, glm::cross(y, z)));
    const double largest =
        std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), std::abs(point.w)});
    return largest > 0 ? glm::vec4(point / largest) : glm::vec4(0);
}

bool isFront(const std::array<glm::vec3, 3>& triangle, const glm::vec4& lightMesh) {
    const glm::vec3 a = triangle[0];
    const glm::vec3 u = triangle[1] - a;
    const glm::vec3 v = triangle[2] - a;
    const glm::vec3 normal(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    const glm::vec3 towardsLight = glm::vec3(lightMesh) - lightMesh.w * a;
    return (normal.x * towardsLight.x + normal.y * towardsLight.y) + normal.z * towardsLight.z > 0.0f;
}

}  // namespace penumbra
