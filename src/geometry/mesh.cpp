// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "penumbra/device.h"
#include "src/geometry/mesh_internals.h"

namespace penumbra {
namespace {

void require(bool condition, const std::string& message) {
    if (!condition) throw Error(Error::Kind::badArgument, "Mesh: " + message);
}

void requireFinite(std::span<const Vec3> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3& p = positions[i];
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                "position " + std::to_string(i) + " is not finite");
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

}  // namespace

Mesh::Mesh(Device&, const Source& source) : internals_(std::make_unique<Internals>()) {
    requireFinite(source.positions);
    require(source.indices.size() % 3 == 0, "the number of indices is no multiple of three");
    require(source.uvs.empty() || source.uvs.size() == source.positions.size(),
            "the number of uvs is not that of the positions");
    for (std::size_t i = 0; i < source.indices.size(); ++i) {
        require(source.indices[i] < source.positions.size(),
                "index " + std::to_string(i) + " refers to no position");
    }
    internals_->positions.assign(source.positions.begin(), source.positions.end());
    internals_->indices.assign(source.indices.begin(), source.indices.end());
    internals_->uvs.assign(source.uvs.begin(), source.uvs.end());
    if (!source.indices.empty()) internals_->bounds = boundsOf(source.positions);
    internals_->positionBuffer = gl::Buffer(std::as_bytes(positions()), "mesh positions");
    internals_->indexBuffer = gl::Buffer(std::as_bytes(indices()), "mesh indices");
    if (!source.uvs.empty()) internals_->uvBuffer = gl::Buffer(std::as_bytes(uvs()), "mesh uvs");
}

Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;
Mesh::~Mesh() = default;

void Mesh::deform(std::span<const Vec3> positions) {
    require(positions.size() == internals_->positions.size(),
            "deform: as many positions as at first are needed");
    requireFinite(positions);
    std::ranges::copy(positions, internals_->positions.begin());
    if (!internals_->indices.empty()) internals_->bounds = boundsOf(positions);
    if (!positions.empty()) internals_->positionBuffer.write(std::as_bytes(positions));
    ++internals_->revision;
}

std::span<const Vec3> Mesh::positions() const {
    return internals_->positions;
}
std::span<const std::uint32_t> Mesh::indices() const {
    return internals_->indices;
}
std::span<const Vec2> Mesh::uvs() const {
    return internals_->uvs;
}
const Box& Mesh::bounds() const {
    return internals_->bounds;
}
std::uint64_t Mesh::revision() const {
    return internals_->revision;
}
std::uint32_t Mesh::positionBuffer() const {
    return internals_->positionBuffer.name();
}
std::uint32_t Mesh::uvBuffer() const {
    return internals_->uvBuffer.name();
}
std::uint32_t Mesh::indexBuffer() const {
    return internals_->indexBuffer.name();
}

}  // namespace penumbra
