// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "penumbra/export.h"
#include "penumbra/math.h"

namespace penumbra {

class Device;

/// An axis-aligned box. Empty when `min.x > max.x`.
struct Box {
    Vec3 min{1, 1, 1};
    Vec3 max{-1, -1, -1};
};

/// Vectors of 32-bit floats in a GL buffer of the host's, one after the other or among other things.
struct HostVectors {
    std::uint32_t buffer = 0;      ///< name of a GL buffer in the current context
    std::size_t offset_bytes = 0;  ///< of the first; a multiple of four
    std::size_t stride_bytes = 0;  ///< from one to the next, a multiple of four; 0: tightly packed
};

/// A triangle mesh on the device, and its copy on the CPU. Move-only; frees its buffers when destroyed. One
/// that was moved from can be destroyed and assigned to; all else throws Error::Kind::badArgument.
class PENUMBRA_API Mesh {
  public:
    /// What a mesh is made of. The spans are copied.
    struct Source {
        std::span<const Vec3> positions{};         ///< mesh space, metres, all finite
        std::span<const std::uint32_t> indices{};  ///< three a triangle, counter-clockwise from its front
        std::span<const Vec2> uvs{};  ///< one a position, or empty; needed by an `AlphaMask` only
    };

    /// Uploads `source`. Throws Error::Kind::badArgument if an index is out of range, a position is not
    /// finite, the number of indices is no multiple of three, or the number of uvs is neither zero nor that
    /// of the positions. An empty mesh is legal and casts nothing.
    Mesh(Device& device, const Source& source);

    /// A mesh that the host has on the device already.
    struct HostSource {
        enum class IndexType { uint16, uint32 };
        HostVectors positions{};            ///< three floats each, mesh space, metres, all finite
        std::size_t vertexCount = 0;        ///< of positions, and of uvs
        std::uint32_t indexBuffer = 0;      ///< three indices a triangle
        std::size_t indexOffset_bytes = 0;  ///< a multiple of an index's size
        std::size_t indexCount = 0;
        IndexType indexType = IndexType::uint32;
        HostVectors uvs{};  ///< two floats each; buffer 0: none
    };
    /// Copies the mesh, on the device and, once, to the CPU, for which this waits; the host's buffers are not
    /// needed afterwards. Throws as the constructor does, and where a buffer is too small. What shaders have
    /// written must have been made visible: `glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT)`.
    static Mesh fromBuffers(Device& device, const HostSource& source);

    Mesh(Mesh&&) noexcept;
    Mesh& operator=(Mesh&&) noexcept;
    ~Mesh();

    /// Replaces the positions, keeping the triangles: skinning, morphing, cloth. As many as at first, all
    /// finite.
    void deform(std::span<const Vec3> positions);

    /// The same from a buffer of the host's, as skinning on the device leaves it; nothing waits. `bounds`
    /// must contain all positions. They are not checked: one that is not finite makes its triangles vanish or
    /// misplaces their shadow, no more. Throws Error::Kind::badArgument where the buffer is too small.
    void deform(const HostVectors& positions, const Box& bounds);

    /// Unique among the meshes of a device and of those that share objects with it, and never used again.
    std::uint64_t id() const;

    /// After a `deform` from a buffer the first call fetches the positions from the device, and waits. (The
    /// techniques that need them on the CPU for every frame say so: see "choosing a technique".)
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

  private:
    Mesh();
    /// Throws Error::Kind::badArgument where the mesh was moved from.
    Internals& internals() const;
    std::unique_ptr<Internals> internals_;
};

/// A caster's holes: fragments whose alpha is below the cutoff let light through.
struct AlphaMask {
    std::uint32_t texture =
        0;                ///< GL_TEXTURE_2D, borrowed, sampled with its own filter and wrapping; 0: no mask
    float factor = 1;     ///< multiplies the texture's alpha
    float cutoff = 0.5f;  ///< alpha >= cutoff blocks
    /// Of the texels: another number whenever they, or the texture that has this name, may be others, so that
    /// what was made from them can be kept meanwhile. 0: unknown, and nothing is kept.
    std::uint64_t revision = 0;
};

/// An object in the scene. Both sides of every triangle block light.
struct Caster {
    const Mesh* mesh = nullptr;  ///< borrowed for the duration of a render call
    /// Affine: its last row is 0 0 0 1. Mirrored and non-uniform scales are legal; where a scale is 0, what
    /// is left of the mesh casts.
    Mat4 worldFromMesh{};
    AlphaMask alphaMask{};
    /// A pane's share of the light that passes, in [0, 1], a channel each (linear Rec. 709); 0: none. A ray
    /// that meets several triangles of a caster, as both faces of a slab, passes it once; through several
    /// casters passes the product. Techniques that know no panes (Technique::answersPanes) take those that
    /// let anything pass for no casters.
    Vec3 transmittance{0, 0, 0};
    bool casts = true;     ///< false: blocks no light
    bool receives = true;  ///< false: its pixels are not shadowed (see View::receiverTexture)
};

/// Whether it takes only a share of the light.
constexpr bool isPane(const Caster& caster) {
    const Vec3& passes = caster.transmittance;
    return caster.casts && (passes.x > 0 || passes.y > 0 || passes.z > 0);
}

}  // namespace penumbra
