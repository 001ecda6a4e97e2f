// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace penumbra {

/// A point of the light in homogeneous light space: (x, y, z, 1), or for a distant light (towards it, 0).
using LightPoint = glm::dvec4;

/// The light's point in mesh space, homogeneous and scaled to a largest component of 1, such that a
/// triangle's front *in light space* faces it if and only if `isFront`. Mirrored, flat and degenerate
/// transforms are legal.
///
/// In light space the triangle's normal is cof(M) n and the light's side of it the sign of
///     dot(cof(M) n, l - (M a + t)) = dot(n, adj(M) (l - t) - det(M) a)
/// since cof(M) transposed is the adjugate. So the point is (adj(M) (l - t), det(M)): that is inverse(M) l
/// times det(M), and it needs no inverse.
glm::vec4 lightPointInMesh(const glm::dmat4& lightFromMesh, const LightPoint& pointLight);

/// Whether the light's point is on the front of the triangle. A point in the triangle's plane is on its back.
/// Operation for operation what facing.comp.glsl does, so that both agree to the last bit.
bool isFront(const std::array<glm::vec3, 3>& triangle, const glm::vec4& lightMesh);

}  // namespace penumbra
