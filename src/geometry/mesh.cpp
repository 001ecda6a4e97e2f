// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "penumbra/device.h"
#include "src/device/host_scope.h"
#include "src/geometry/host_buffers.h"
#include "src/geometry/mesh_internals.h"

namespace penumbra {
namespace {

void require(bool condition, const std::string& message) {
    if (!condition) throw Error(Error::Kind::badArgument, "Mesh: " + message);
}

bool isFinite(const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void requireFinite(std::span<const Vec3> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        require(isFinite(positions[i]), "position " + std::to_string(i) + " is not finite");
    }
}

Box boundsOf(std::span<const Vec3> positions) {
    if (positions.empty()) return {};
    Box box{positions.front(), positions.front()};
    for (const Vec3& p : positions) {
        box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
        box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
    return box;
}

void requireTriangles(std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    require(indices.size() % 3 == 0, "the number of indices is no multiple of three");
    for (std::size_t i = 0; i < indices.size(); ++i) {
        require(indices[i] < vertexCount, "index " + std::to_string(i) + " refers to no position");
    }
}

}  // namespace

Mesh::Mesh() : internals_(std::make_unique<Internals>()) {}

Mesh Mesh::Internals::make(Device::Internals& device, const Source& source) {
    device.requireContext();
    requireFinite(source.positions);
    requireTriangles(source.indices, source.positions.size());
    require(source.uvs.empty() || source.uvs.size() == source.positions.size(),
            "the number of uvs is not that of the positions");
    const gl::ObjectRegistryScope scope(device.registry);
    Mesh mesh;
    Internals& made = *mesh.internals_;
    made.enter(device);
    made.positions.assign(source.positions.begin(), source.positions.end());
    made.indices.assign(source.indices.begin(), source.indices.end());
    made.uvs.assign(source.uvs.begin(), source.uvs.end());
    if (!source.indices.empty()) made.bounds = boundsOf(source.positions);
    made.positionBuffer = gl::Buffer(std::as_bytes(source.positions), "mesh positions");
    made.indexBuffer = gl::Buffer(std::as_bytes(source.indices), "mesh indices");
    if (!source.uvs.empty()) made.uvBuffer = gl::Buffer(std::as_bytes(source.uvs), "mesh uvs");
    return mesh;
}

Mesh::Mesh(Device& device, const Source& source) : Mesh(Internals::make(internalsOf(device), source)) {}

Mesh Mesh::fromBuffers(Device& device, const HostSource& source) {
    const HostScope scope(internalsOf(device));
    Mesh mesh;
    Internals& internals = *mesh.internals_;
    internals.enter(internalsOf(device));
    internals.positions.resize(source.vertexCount);
    internals.indices.resize(source.indexCount);
    internals.positionBuffer = gl::Buffer(source.vertexCount * sizeof(Vec3), "mesh positions");
    internals.indexBuffer = gl::Buffer(source.indexCount * sizeof(std::uint32_t), "mesh indices");
    gatherVectors(internalsOf(device), source.positions, source.vertexCount, 3, internals.positionBuffer,
                  "positions");
    gatherIndices(internalsOf(device), source, internals.indexBuffer);
    internals.positionBuffer.read(std::as_writable_bytes(std::span(internals.positions)));
    internals.indexBuffer.read(std::as_writable_bytes(std::span(internals.indices)));
    if (source.uvs.buffer != 0) {
        internals.uvs.resize(source.vertexCount);
        internals.uvBuffer = gl::Buffer(source.vertexCount * sizeof(Vec2), "mesh uvs");
        gatherVectors(internalsOf(device), source.uvs, source.vertexCount, 2, internals.uvBuffer, "uvs");
        internals.uvBuffer.read(std::as_writable_bytes(std::span(internals.uvs)));
    }
    requireFinite(internals.positions);
    requireTriangles(internals.indices, internals.positions.size());
    if (!internals.indices.empty()) internals.bounds = boundsOf(internals.positions);
    return mesh;
}

Mesh::Internals& Mesh::internals() const {
    if (internals_) return *internals_;
    throw Error(Error::Kind::badArgument, "Mesh: it was moved from: use the Mesh that it was moved to");
}

Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;
Mesh::~Mesh() = default;

void Mesh::deform(std::span<const Vec3> positions) {
    internals().device->requireContext();
    require(positions.size() == internals().positions.size(),
            "deform: as many positions as at first are needed");
    requireFinite(positions);
    std::ranges::copy(positions, internals().positions.begin());
    internals().positionsAreStale = false;
    if (!internals().indices.empty()) internals().bounds = boundsOf(positions);
    if (!positions.empty()) internals().positionBuffer.write(std::as_bytes(positions));
    ++internals().revision;
}

void Mesh::Internals::deform(Device::Internals& current, const HostVectors& from, const Box& box) {
    require(isFinite(box.min) && isFinite(box.max) && box.min.x <= box.max.x && box.min.y <= box.max.y &&
                box.min.z <= box.max.z,
            "deform: the bounds are not finite or empty");
    gatherVectors(current, from, positions.size(), 3, positionBuffer, "deform");
    positionsAreStale = true;
    if (!indices.empty()) bounds = box;
    ++revision;
}

void Mesh::deform(const HostVectors& positions, const Box& bounds) {
    const HostScope scope(*internals().device);
    internals().deform(*internals().device, positions, bounds);
}

std::uint64_t Mesh::id() const {
    return internals().id;
}
std::span<const Vec3> Mesh::positions() const {
    if (internals().positionsAreStale && internals().device->registry->isReachable()) {
        internals().positionBuffer.read(std::as_writable_bytes(std::span(internals().positions)));
        internals().positionsAreStale = false;
    }
    return internals().positions;
}
std::span<const std::uint32_t> Mesh::indices() const {
    return internals().indices;
}
std::span<const Vec2> Mesh::uvs() const {
    return internals().uvs;
}
const Box& Mesh::bounds() const {
    return internals().bounds;
}
std::uint64_t Mesh::revision() const {
    return internals().revision;
}
std::uint32_t Mesh::positionBuffer() const {
    return internals().positionBuffer.name();
}
std::uint32_t Mesh::uvBuffer() const {
    return internals().uvBuffer.name();
}
std::uint32_t Mesh::indexBuffer() const {
    return internals().indexBuffer.name();
}

}  // namespace penumbra
