// SPDX-License-Identifier: Apache-2.0
// All triangles that cast, in one place on the device, and a tree over them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "penumbra/technique.h"
#include "src/gl/pass.h"
#include "src/gl/texel_buffer.h"
#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/stand_ins.h"
#include "src/techniques/exact_visibility/triangle_tree.h"

namespace penumbra::exact_visibility {

/// Keeps, from frame to frame, what has not changed: the shape of each mesh's tree while its triangles are
/// the same, boxes and corners while it does not move. Where casters moved or were deformed, only theirs are
/// computed and sent again; a small tree over the casters is rebuilt.
class CasterSoup {
  public:
    CasterSoup();

    /// Takes the casters in; where `usesStandIns`, dense meshes that are not deformed and have no holes get
    /// coarser stand-ins. Throws Error::Kind::badArgument where they have more triangles than the device
    /// can address.
    void update(std::span<const Caster> casters, bool usesStandIns);

    /// Counts the updates after which something was not as before.
    std::uint64_t revision() const { return revision_; }
    /// Whether `changedBoxes` tells all that differs now from what was there at a revision.
    bool tellsChangesSince(std::uint64_t revision) const {
        return revision == revision_ ||
               (revision + 1 == revision_ && changed_.size() <= std::size_t(2 * EXACT_MOST_CHANGED));
    }
    /// Around casters that have come, gone, moved, changed their form or may let other light through since
    /// the revision before: where they were and where they are, each a low and a high corner (scene axes,
    /// metres).
    std::span<const glm::vec4> changedBoxes() const { return changed_; }

    /// World space moved, not turned, so that coordinates are small: how shaders see everything.
    const glm::dvec3& originWorld() const { return originWorld_; }

    /// Binds nodes, triangles and masked triangles' texture coordinates.
    void bindTo(gl::Pass& pass) const;

    std::size_t nodeCount() const { return nodeCount_; }
    /// Those of stand-ins, too.
    std::size_t triangleCount() const { return triangleCount_; }
    std::size_t standInTriangleCount() const;
    std::size_t maskedCount() const { return maskedCount_; }
    std::size_t paneTriangleCount() const { return paneTriangleCount_; }
    /// Triangles of all casters that come nearer than `distance` to a plane, or cross it (scene axes,
    /// metres).
    std::size_t countNear(const glm::vec3& planePoint, const glm::vec3& normal, float distance) const;
    /// The greatest distance of a caster from a point.
    float farthestFrom(const glm::vec3& point) const;
    std::size_t size_bytes() const {
        return nodes_.size_bytes() + triangles_.size_bytes() + masked_.size_bytes();
    }
    /// Masks in the order in which triangles name them.
    const std::vector<AlphaMask>& masks() const { return masks_; }
    /// What panes let through (xyz), in the order in which triangles name them.
    const std::vector<glm::vec4>& transmittances() const { return transmittances_; }

  private:
    /// What stands in for a node of a caster's tree.
    struct StandInTree {
        std::uint32_t node;
        float deviation_m;          ///< in mesh space
        std::size_t firstNode;      ///< of the caster's: one that says how far it deviates, then the tree
        std::size_t firstTriangle;  ///< of the caster's
        TreeShape shape;
        std::vector<TreeBox> boxes;
    };

    /// A caster, with copies of what it is made of to see whether it is still the same.
    struct Entry {
        std::uint64_t mesh = 0, revision = 0;  ///< Mesh's; nothing else is looked at where they are the same
        std::vector<std::uint32_t> indices;
        std::vector<Vec3> positions;
        std::vector<Vec2> uvs;
        Mat4 worldFromMesh;
        int mask = -1;  ///< which of masks_, or none
        AlphaMask holes;
        int pane = -1;  ///< which of transmittances_, or none
        Vec3 transmittance;

        TreeShape shape;
        std::vector<TreeBox> boxes;       ///< one a node
        std::vector<glm::uvec4> corners;  ///< three a triangle, in the order of the tree: as shaders get them
        bool hasStandIns = false;         ///< or would, if it was dense
        bool deforms = false;             ///< it had other positions once
        std::vector<std::uint32_t> standInIndices;
        std::vector<StandInTree> standIns;  ///< their corners stand behind the others
        bool isSent = false;
        std::size_t firstNode = 0, firstTriangle = 0, firstMasked = 0;

        bool mayLetOtherLightThrough(const Caster& caster) const;
        std::uint32_t flags() const;  ///< of its nodes
        std::size_t nodeCount() const;
        bool mayHaveStandIns(const Caster& caster, bool usesStandIns) const;
        bool isStale(const Caster& caster, bool usesStandIns) const;
        void take(const Caster& caster, bool usesStandIns);
        void makeStandInTrees();
        /// `posScene` is room for the positions.
        void place(const glm::dvec3& origin, std::vector<glm::vec3>& posScene);
    };

    void noteChanged(const Entry& entry);
    void take(std::span<const Caster> casters, bool usesStandIns);
    void send();
    void send(Entry& entry);
    void sendNodes(const Entry& entry);
    void sendTop();

    std::vector<Entry> entries_;
    std::vector<AlphaMask> masks_;
    std::vector<glm::vec4> transmittances_;
    std::vector<glm::vec4> changed_;
    std::uint64_t revision_ = 1;
    glm::dvec3 originWorld_{0};
    // Room that is kept, since getting it anew takes as long as filling it.
    std::vector<glm::vec3> posScene_;
    std::vector<glm::uvec4> texels_;
    gl::TexelBuffer nodes_, triangles_, masked_;
    std::size_t nodeCount_ = 0;
    std::size_t triangleCount_ = 0;
    std::size_t maskedCount_ = 0;
    std::size_t paneTriangleCount_ = 0;
};

}  // namespace penumbra::exact_visibility
