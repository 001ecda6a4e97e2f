// SPDX-License-Identifier: Apache-2.0
// Shapes for the built-in scenes. All are centred on the origin, with +Y up, in metres; triangles wind
// counter-clockwise seen from outside, and curved surfaces have smooth normals. "Solid" shapes are closed
// once equal positions are welded.
#pragma once

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// A solid box of `size_m`: 12 triangles.
Mesh box(const glm::vec3& size_m);

/// A box seen from the inside, for rooms: closed, its triangles facing inwards.
Mesh room(const glm::vec3& size_m);

/// A solid sphere of `slices` (>= 3) meridians and `stacks` (>= 2) rings: 2 slices (stacks - 1) triangles.
Mesh sphere(float radius_m, int slices, int stacks);

/// A solid torus around Y: `ringRadius_m` from the axis to the tube's centre. 2 segments sides triangles,
/// both >= 3.
Mesh torus(float ringRadius_m, float tubeRadius_m, int segments, int sides);

enum class Ends { closed, open };

/// A cylinder along Y of `sides` >= 3; solid with closed ends (4 sides triangles), a tube without thickness
/// with open ones (2 sides triangles).
Mesh cylinder(float radius_m, float height_m, int sides, Ends ends = Ends::closed);

/// A solid cone along Y with its tip up: 2 sides triangles.
Mesh cone(float radius_m, float height_m, int sides);

/// A sheet of `sides` >= 3 triangles facing +Y: a regular polygon inscribed in the circle.
Mesh disk(float radius_m, int sides);

/// A sheet facing +Y of `columns` x `rows` cells along X and Z, two triangles each.
Mesh plane(float width_m, float depth_m, int columns = 1, int rows = 1);

/// A square flag upright in the XY plane, facing +Z, hoisted along x = 0, of `cells` x `cells` cells. Two
/// morph targets, weighted by cos(wt) and sin(wt), make a wave of `waves` periods that travels along +X and
/// grows towards the fly.
Mesh flag(float size_m, float amplitude_m, float waves, int cells);

}  // namespace penumbra::studio
