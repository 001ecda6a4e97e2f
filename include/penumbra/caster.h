// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "penumbra/math.h"

namespace penumbra {

class Device;

/// An axis-aligned box. Empty when `min.x > max.x`.
struct Box {
    Vec3 min{1, 1, 1};
    Vec3 max{-1, -1, -1};
};

/// A triangle mesh on the device, and its copy on the CPU. Move-only; frees its buffers when destroyed, for
/// which the context it was made in must be current.
class Mesh {
  public:
    /// What a mesh is made of. The spans are copied.
    struct Source {
        std::span<const Vec3> positions;         ///< mesh space, metres, all finite
        std::span<const std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from its front
        std::span<const Vec2> uvs;               ///< one a position, or empty; needed by an `AlphaMask` only
    };

    /// Uploads `source`. Throws Error::Kind::badArgument if an index is out of range, a position is not
    /// finite, the number of indices is no multiple of three, or the number of uvs is neither zero nor that
    /// of the positions. An empty mesh is legal and casts nothing.
    Mesh(Device& device, const Source& source);
    Mesh(Mesh&&) noexcept;
    Mesh& operator=(Mesh&&) noexcept;
    ~Mesh();

    /// Replaces the positions, keeping the triangles: skinning, morphing, cloth. As many as at first, all
    /// finite.
    void deform(std::span<const Vec3> positions);

    std::span<const Vec3> positions() const;
    std::span<const std::uint32_t> indices() const;
    std::span<const Vec2> uvs() const;
    const Box& bounds() const;
    /// Counts calls of `deform`, so that whoever caches something derived from the positions knows when it is
    /// stale.
    std::uint64_t revision() const;

    /// Names of GL buffers that a host may draw from, owned by the mesh: tightly packed 32-bit floats (three
    /// a position, two a uv; the uv buffer is 0 without uvs) and 32-bit unsigned indices.
    std::uint32_t positionBuffer() const;
    std::uint32_t uvBuffer() const;
    std::uint32_t indexBuffer() const;

    struct Internals;
    Internals& internals() const { return *internals_; }

  private:
    std::unique_ptr<Internals> internals_;
};

/// A caster's holes: fragments whose alpha is below the cutoff let light through.
struct AlphaMask {
    std::uint32_t texture =
        0;                ///< GL_TEXTURE_2D, borrowed, sampled with its own filter and wrapping; 0: no mask
    float factor = 1;     ///< multiplies the texture's alpha
    float cutoff = 0.5f;  ///< alpha >= cutoff blocks
};

/// An object in the scene. Both sides of every triangle block light.
struct Caster {
    const Mesh* mesh = nullptr;  ///< borrowed for the duration of a render call
    Mat4 worldFromMesh;          ///< affine; mirrored and non-uniform scales are legal
    AlphaMask alphaMask;
    bool casts = true;     ///< false: blocks no light
    bool receives = true;  ///< false: its pixels are not shadowed (see View::receiverTexture)
};

}  // namespace penumbra
