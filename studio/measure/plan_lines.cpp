// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/plan_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "studio/measure/instance_triangles.h"

namespace penumbra::studio {
namespace {

/// What is less far from the grid's plane is drawn: below, the floor of a room; above, no ceiling.
constexpr double below_m = 2.5, above_m = 1.2;
/// Faces that meet at less than this have no edge.
const double smooth = std::cos(glm::radians(20.0));
/// A plane is cut a hair above itself: what stands on it is then cut, and it is not.
constexpr double hair_m = 2e-3;

using Corner = std::tuple<double, double, double>;
using Triangle = std::array<glm::dvec3, 3>;

struct Edge {
    glm::dvec3 normal{0};
    glm::dvec3 from{0}, to{0};
    int faces = 0;
    bool isSharp = false;
};

class PlanOf {
  public:
    PlanOf(const GridFrame& frame, double margin_m)
        : frame_(frame),
          axes_(glm::transpose(glm::dmat3(frame.acrossWorld, frame.alongWorld, frame.normalWorld))),
          low_(-margin_m),
          high_(glm::dvec2(frame.width_m, frame.depth_m) + margin_m) {}

    void add(const Triangle& world) {
        Triangle corners;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = axes_ * (world[i] - frame_.cornerWorld);
        if (isBeside(corners)) return;
        addCut(corners);
        addEdges(corners);
    }

    /// The edges of what was added since the last call, which hangs together nowhere else.
    void finishSolid() {
        for (const auto& [ends, edge] : edges_) {
            if (edge.faces == 1 || edge.isSharp) lines_.seen.push_back({glm::dvec2(edge.from), edge.to});
        }
        edges_.clear();
    }

    PlanLines take() { return std::move(lines_); }

  private:
    bool isBeside(const Triangle& corners) const {
        const glm::dvec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
        const glm::dvec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
        return low.x > high_.x || low.y > high_.y || high.x < low_.x || high.y < low_.y || low.z > above_m ||
               high.z < -below_m;
    }

    void addCut(const Triangle& corners) {
        std::array<glm::dvec2, 2> line;
        std::size_t ends = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
            if ((a.z > hair_m) == (b.z > hair_m) || ends == 2) continue;
            line[ends++] = glm::dvec2(glm::mix(a, b, (hair_m - a.z) / (b.z - a.z)));
        }
        if (ends == 2) lines_.cut.push_back(line);
    }

    void addEdges(const Triangle& corners) {
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(glm::length(across) > 0)) return;
        const glm::dvec3 normal = glm::normalize(across);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
            if (std::max(a.z, b.z) > above_m || std::min(a.z, b.z) < -below_m) continue;
            std::pair<Corner, Corner> ends({a.x, a.y, a.z}, {b.x, b.y, b.z});
            if (ends.second < ends.first) std::swap(ends.first, ends.second);
            Edge& edge = edges_[ends];
            if (edge.faces++ > 0) {
                edge.isSharp = edge.isSharp || std::abs(glm::dot(edge.normal, normal)) < smooth;
            } else {
                edge.normal = normal;
                edge.from = a;
                edge.to = b;
            }
        }
    }

    const GridFrame& frame_;
    glm::dmat3 axes_;
    glm::dvec2 low_, high_;
    PlanLines lines_;
    std::map<std::pair<Corner, Corner>, Edge> edges_;
};

}  // namespace

PlanLines planLinesOf(const Scene& scene, const SceneMoment& moment, const GridFrame& frame,
                      double margin_m) {
    PlanOf plan(frame, margin_m);
    std::optional<std::pair<int, int>> last;
    int alone = -1;
    for (const Instance& instance : moment.instances) {
        const int solid = scene.meshes[std::size_t(instance.mesh)].solid;
        const std::pair key(instance.node, solid >= 0 ? solid : alone--);
        if (last && *last != key) plan.finishSolid();
        last = key;
        forEachTriangle(scene, instance, [&](const Triangle& triangle) { plan.add(triangle); });
    }
    plan.finishSolid();
    return plan.take();
}

}  // namespace penumbra::studio
