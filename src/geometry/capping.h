// SPDX-License-Identifier: Apache-2.0
// Closing the holes of a mesh with triangles (the thesis on soft shadow volumes, section 4.3).
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/caster.h"
#include "src/device/device_internals.h"
#include "src/geometry/edge_topology.h"

namespace penumbra {

/// Triangles, three indices each, that close every hole: with them each edge is walked as often in the one
/// direction as in the other. Any topology is legal. Takes time in proportion to the edges; there are fewer
/// triangles than edges that were open.
std::vector<std::uint32_t> capHoles(const EdgeTopology& topology);

/// The mesh with its holes capped, or itself if it has none. Made at the first call, kept for as long as the
/// mesh lives, and deformed with it.
const Mesh& cappedOf(Device::Internals& device, const Mesh& mesh);

}  // namespace penumbra
