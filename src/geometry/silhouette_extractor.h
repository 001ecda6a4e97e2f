// SPDX-License-Identifier: Apache-2.0
// Silhouettes of any triangle soup, found on the device anew in each frame: casters may move and deform
// freely, and nothing is read back. Edges of any number of faces follow the signed counts of Kim, Kim and
// Turk 2008
// ("An interactive shadow volume algorithm for non-manifold meshes").
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "penumbra/caster.h"
#include "src/device/device_internals.h"
#include "src/geometry/facing.h"
#include "src/geometry/silhouettes_io.h"
#include "src/gl/buffer.h"
#include "src/gl/program.h"

namespace penumbra {

/// A mesh to find silhouettes of, and where it stands.
struct SilhouetteSource {
    const Mesh* mesh = nullptr;
    glm::dmat4 lightFromMesh{1};
};

class SilhouetteExtractor {
  public:
    explicit SilhouetteExtractor(Device& device);

    /// How the list will be drawn: vertices for each edge, and instances of the whole (one a layer, say).
    struct DrawShape {
        unsigned verticesPerEdge = 1;
        unsigned instances = 1;
    };

    /// Lists the edges whose weight is not zero as seen from `point`: in the order of `sources`, then of each
    /// mesh's edges, so that equal inputs give equal lists. Throws Error::Kind::badArgument if a mesh has
    /// more edges or triangles than a dispatch can reach (16 million on the smallest devices).
    void extract(std::span<const SilhouetteSource> sources, const LightPoint& point, DrawShape shape);

    /// The list (SilhouetteEdge, silhouettes_io.h).
    const gl::Buffer& edges() const { return silhouettes_; }

    /// Holds one SilhouetteCommands: for glDrawArraysIndirect at offset 0, for glDispatchComputeIndirect
    /// (groups of 64 edges) at `dispatchOffset`.
    const gl::Buffer& commands() const { return commands_; }
    static constexpr std::size_t dispatchOffset = offsetof(SilhouetteCommands, groupsX);

    /// For each triangle of source after source, an int: +1 where it shows its front, -1 where its back.
    const gl::Buffer& facings() const { return facings_; }

    /// Number of edges examined.
    std::size_t edgeCount() const { return edgeCount_; }
    /// Number of vertices that SilhouetteEdge::a and b count through.
    std::size_t vertexCount() const { return vertexCount_; }
    /// Number of silhouette edges found. Waits for the device: not for use in a frame.
    unsigned countFound() const;

  private:
    void findFacings(std::span<const SilhouetteSource> sources, const LightPoint& point);

    gl::Program facing_, mark_, scan_, write_;
    gl::Buffer facings_, marks_, offsets_, silhouettes_, commands_;
    std::size_t edgeCount_ = 0, vertexCount_ = 0;
};

}  // namespace penumbra
