// SPDX-License-Identifier: Apache-2.0
// What the library keeps for a mesh; hosts see penumbra::Mesh alone.
#pragma once

#include <memory>
#include <vector>

#include "penumbra/caster.h"
#include "src/device/device_internals.h"
#include "src/geometry/edge_mesh.h"
#include "src/gl/buffer.h"

namespace penumbra {

struct Mesh::Internals {
    std::shared_ptr<Device::Internals> device;
    std::uint64_t id = 0;
    std::vector<Vec3> positions;
    bool positionsAreStale = false;  ///< newer ones are on the device
    std::vector<std::uint32_t> indices;
    std::vector<Vec2> uvs;
    Box bounds;
    std::uint64_t revision = 0;
    gl::Buffer positionBuffer, uvBuffer, indexBuffer;
    std::unique_ptr<const EdgeMesh> edges;  ///< see edgesOf
    std::unique_ptr<Mesh> capped;           ///< see cappedOf
    std::uint64_t cappedRevision = 0;       ///< of this mesh, when `capped` last followed it

    /// As the public constructor and `deform` do; `device` may be another one that shares objects.
    static Mesh make(Device::Internals& device, const Source& source);
    void deform(Device::Internals& device, const HostVectors& positions, const Box& bounds);

    /// Throws Error::Kind::badArgument where the mesh was moved from.
    static Internals& of(const Mesh& mesh) { return mesh.internals(); }
    /// Null where it was moved from.
    static const Internals* ifAny(const Mesh& mesh) { return mesh.internals_.get(); }

    void enter(Device::Internals& owner) {
        device = owner.shared_from_this();
        id = ++owner.shareGroup->meshesMade;
    }
};

inline Mesh::Internals& internalsOf(const Mesh& mesh) {
    return Mesh::Internals::of(mesh);
}

}  // namespace penumbra
