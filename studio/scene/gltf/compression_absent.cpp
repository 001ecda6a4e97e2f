// SPDX-License-Identifier: Apache-2.0
// In place of meshopt_view.cpp and draco_mesh.cpp in a build for the bench alone, which has neither library.
#include "studio/scene/gltf/draco_mesh.h"
#include "studio/scene/gltf/meshopt_view.h"

namespace penumbra::studio::gltf {

namespace {

[[noreturn]] void refuse(const JsonView& json) {
    throw PlaceError(json.pointer(), "is compressed, which a build for the bench alone cannot read",
                     "take the whole build (PENUMBRA_BENCH_ALONE=OFF)");
}

}  // namespace

MeshoptView readMeshoptView(const JsonView& json, std::uint64_t) {
    refuse(json);
}

Bytes decompress(const MeshoptView&, std::span<const std::byte>, const JsonView& json, Budget&) {
    refuse(json);
}

DracoMesh::DracoMesh(const JsonView&, const JsonView& json, const Accessors&, Budget&) {
    refuse(json);
}

const Accessor* DracoMesh::attribute(const std::string&) const {
    return nullptr;
}

}  // namespace penumbra::studio::gltf
