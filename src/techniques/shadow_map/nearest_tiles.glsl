// SPDX-License-Identifier: Apache-2.0
// How near to the light the nearest blocker may be in any part of a map: a pyramid over each map, from tilesAcross^2
// tiles up to one, as in Guennebaud, Barthe and Paulin 2006 (Real-time soft shadow mapping by backprojection, 4.1).
// Closeness grows towards the light: 1 / distance from the light's plane (rect, disk) or its centre (sphere), or minus
// the depth (distant).
const int tilesAcross = 64;
const int pyramidLevels = 7;
const int tilesPerMap = 5461;  // 64^2 + 32^2 + ... + 1

// Index of the first tile of a level.
int pyramidStart(int level) { return (4 * tilesAcross * tilesAcross - (4 * tilesAcross * tilesAcross >> (2 * level))) / 3; }
