// SPDX-License-Identifier: Apache-2.0
// Fewer triangles for a patch of a mesh, whose rim stays as it is, vertex by vertex: patches that were
// simplified stand beside others, and beside those that were not, without a gap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace penumbra::exact_visibility {

using Triangle = std::array<std::uint32_t, 3>;  ///< vertices

/// Takes vertices away, one after the other, each by moving its triangles to a neighbour (half-edge
/// collapses), the least harmful first by the sum of squared distances to the planes that met there (Garland
/// and Heckbert 1997). So its vertices are the mesh's, and its topology stays.
class PatchSimplifier {
  public:
    /// `positions` are the mesh's and outlive this.
    explicit PatchSimplifier(std::span<const glm::vec3> positions);

    struct Result {
        std::vector<Triangle> triangles;
        /// How far what was taken away is from what is left: the greatest distance of a vertex that is gone
        /// from the triangles around it that took its place, followed through all that happened to them
        /// since, and of the middle of a new edge from the triangles that it replaced. Metres of mesh space.
        float deviation = 0;
    };

    /// As few triangles as can be had where no vertex deviates by more than `largestDeviation`. Triangles
    /// that name a vertex twice are left out.
    Result simplify(std::span<const Triangle> triangles, float largestDeviation);

  private:
    /// Of planes: what the squared distances of a point to them sum up to, weighted by area.
    struct Quadric {
        glm::dmat3 a{0};
        glm::dvec3 b{0};
        double c = 0;
        void add(const Quadric& other);
        double operator()(const glm::dvec3& p) const { return glm::dot(p, a * p + 2.0 * b) + c; }
    };
    struct Face {
        Triangle vertices;         ///< local
        std::uint32_t firstPoint;  ///< a vertex that is gone, and lies nearest here; or none
        bool isThere = true;
    };
    struct Collapse {
        double cost;
        std::uint32_t from, to;
    };

    void load(std::span<const Triangle> triangles);
    bool findRing(std::uint32_t vertex);
    bool mayMove(std::uint32_t from, std::uint32_t to);
    std::optional<Collapse> bestFor(std::uint32_t vertex);
    bool collapse(const Collapse& collapse, float largestDeviation);

    std::span<const glm::vec3> positions_;
    std::vector<std::uint32_t> localOf_;  ///< by the mesh's vertices

    // Of a patch.
    std::vector<std::uint32_t> vertices_;  ///< the mesh's
    std::vector<glm::vec3> at_;            ///< from the patch's first vertex, since sums of squares cancel
    std::vector<Quadric> quadrics_;
    std::vector<char> isTouched_;                ///< its surroundings have changed since `best_` was found
    std::vector<std::optional<Collapse>> best_;  ///< of a vertex; none that may be done, or was refused
    std::vector<Face> faces_;
    std::vector<std::vector<std::uint32_t>> facesOf_;  ///< by vertex; some may be gone
    std::vector<std::uint32_t> nextPoint_;             ///< by vertex
    float deviation_ = 0;

    // Of a vertex: its neighbours in order, and room for what follows.
    std::vector<std::uint32_t> ring_;
    std::vector<std::uint32_t> ringOf_;    ///< by vertex: whose ring it was on last
    std::vector<std::uint32_t> seenFrom_;  ///< by vertex: in which look at shared neighbours, counted by
    std::uint32_t stamp_ = 1;              ///< this
    std::vector<std::pair<std::uint32_t, std::uint32_t>> spokes_;
    std::vector<std::pair<std::uint32_t, std::size_t>> moved_;  ///< points, and the new face of each
    std::vector<Collapse> options_;
    std::vector<const Collapse*> collapses_;
};

/// The distance of a point from a triangle.
float distanceToTriangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace penumbra::exact_visibility
