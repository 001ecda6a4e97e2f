// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <vector>

#include "penumbra/technique.h"
#include "src/device/device_internals.h"
#include "src/geometry/silhouette_extractor.h"
#include "src/gl/buffer.h"
#include "src/gl/pass.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

namespace penumbra::soft_shadow_volumes {

/// A caster with holes.
struct MaskedSource {
    SilhouetteSource source;
    AlphaMask mask;
};

/// What becomes of a mesh's borders.
enum class OpenMeshes {
    signedEdges,  ///< an edge counts for the faces that end there: triangles alone block
    capped,       ///< as published (4.3): holes are closed first, and block as well
};

/// The parameter that chooses it: `openMeshes` is an OpenMeshes.
void describeOpenMeshes(ParameterVisitor& visitor, int& openMeshes);

/// What both techniques of the room prepare on the CPU for a frame.
struct VolumeFrame {
    glm::dmat4 lightFromWorld{1};
    VolumeConstants constants{};
    /// The casters that cast and have triangles; where layers are asked for, but for those with holes.
    std::pmr::vector<SilhouetteSource> sources{gl::ObjectRegistryScope::frameMemory()};
    std::pmr::vector<MaskedSource> masked{gl::ObjectRegistryScope::frameMemory()};

    /// For each source: as how many layers a triangle of it counts.
    std::pmr::vector<int> layersEach{gl::ObjectRegistryScope::frameMemory()};

    /// For each source: whether it may cut through the light.
    std::pmr::vector<bool> cutsLight = std::pmr::vector<bool>(gl::ObjectRegistryScope::frameMemory());

    /// A triangle may lie between the eye and a receiver without being seen: before the near plane, as it may
    /// in every orthographic view.
    bool mayHide = false;

    /// How layers before the light's centre are counted: a flat light's, which may lie in a face, is drawn
    /// from a place a little before it; asked of triangles, what lies in its plane is left out.
    enum class Count { drawn, asked };

    /// `pixelsPerTexel`: 1, 2, 4: the V-buffer's texel (i, j) stands for the pixel at that multiple of (i,
    /// j).
    VolumeFrame(const ShadowInputs& inputs, int pixelsPerTexel, Count count);

    /// Closes the holes of all casters with triangles that nobody draws.
    void capHoles(Device::Internals& device);

    /// The light's centre.
    LightPoint center() const;
};

/// Says once in the log that holes of alpha masks are not seen where volumes are drawn: edges are the
/// triangles', and a masked caster blocks as a whole.
class AlphaMaskWarning {
  public:
    explicit AlphaMaskWarning(Device& device) : log_(internalsOf(device).log) {}
    void check(std::span<const Caster> casters);

  private:
    const gl::DebugLog& log_;
    bool said_ = false;
};

/// What the passes of a frame get alike: its constants, and the receivers.
class FrameBinding {
  public:
    void fill(const View& view, const VolumeFrame& frame);
    void bindTo(gl::Pass& pass) const;

  private:
    ViewBinding view_;
    gl::ConstantBuffer<VolumeConstants> constants_{"soft-volumes/constants"};
};

/// Of caster `index`, for passes that look at `count` of its edges or triangles.
MeshConstants meshConstants(const VolumeFrame& frame, std::size_t index, std::size_t count);
/// Of a caster's mesh, what of it the pass's shaders declare: `Positions` and `Indices`.
void bindMesh(gl::Pass& pass, const Mesh& mesh);

}  // namespace penumbra::soft_shadow_volumes
