// SPDX-License-Identifier: Apache-2.0
// How near to the light the nearest blocker may be in any part of a map: a pyramid over each map, from tilesAcross^2
// tiles up to one, as in Guennebaud, Barthe and Paulin 2006 (Real-time soft shadow mapping by backprojection, 4.1).
// Closeness grows towards the light: 1 / distance from the light's plane (rect, disk) or its centre (sphere), or minus
// the depth (distant).
//
// Of a wall beside a rect or disk a part is as near to the light's plane as one likes, yet hides nothing of the light. A
// blocker that lies e beside the light's outline, at h from its plane, is between the light and a receiver only where the
// receiver is seen from the light at a tangent of at least e / h off its axis. So each tile has a closeness for receivers
// up to each of some tangents: of its blockers the largest 1 / h, but no more than tangent / e.
const int tilesAcross = 64;
const int pyramidLevels = 7;
const int tilesPerMap = 5461;  // 64^2 + 32^2 + ... + 1
const int tangents = 8;
const float leastTangent = 0.25;  // each is twice the one before; the last stands for all others

// Index of the first tile of a level.
int pyramidStart(int level) { return (4 * tilesAcross * tilesAcross - (4 * tilesAcross * tilesAcross >> (2 * level))) / 3; }

// Which closeness is for a receiver at this tangent off the light's axis.
int tangentIndex(float tangent) { return clamp(int(ceil(log2(max(tangent, leastTangent) / leastTangent))), 0, tangents - 1); }

float tangentAt(int index) { return index == tangents - 1 ? 1e30 : leastTangent * exp2(float(index)); }
