// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/closed_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "studio/measure/instance_triangles.h"

namespace penumbra::studio {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// A direction that no edge of a building has.
const glm::dvec3 upwards = glm::normalize(glm::dvec3(0.0131, 1, 0.0277));

/// Off the surface that a point lies on, by what its float coordinates cannot tell apart, and more.
glm::dvec3 lifted(const MeasuringPoint& point) {
    constexpr double roundings = 1e-6, least_m = 1e-5;
    return point.posWorld + (least_m + roundings * glm::length(point.posWorld)) * point.normalWorld;
}

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    void include(const Triangle& triangle) {
        for (const glm::dvec3& corner : triangle) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    bool contains(const glm::dvec3& point) const {
        return glm::all(glm::lessThanEqual(low, point)) && glm::all(glm::lessThanEqual(point, high));
    }
};

/// Triangles of one solid by the pieces that hang together at equal corners.
class Pieces {
  public:
    void add(const Triangle& triangle) {
        std::array<std::size_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = numberOf(triangle[i]);
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t a = corners[i], b = corners[(i + 1) % 3];
            ++uses_[std::minmax(a, b)];
            parent_[rootOf(a)] = rootOf(b);
        }
        triangles_.push_back({triangle, corners[0]});
    }

    /// The triangles of each piece that is closed.
    std::vector<std::vector<Triangle>> closed() {
        std::map<std::size_t, std::vector<Triangle>> pieces;
        for (const auto& [triangle, corner] : triangles_) pieces[rootOf(corner)].push_back(triangle);
        for (const auto& [edge, count] : uses_) {
            if (count % 2 != 0) pieces.erase(rootOf(edge.first));
        }
        std::vector<std::vector<Triangle>> result;
        for (auto& [root, triangles] : pieces) result.push_back(std::move(triangles));
        return result;
    }

  private:
    std::size_t numberOf(const glm::dvec3& corner) {
        const auto [found, isNew] = numbers_.try_emplace({corner.x, corner.y, corner.z}, parent_.size());
        if (isNew) parent_.push_back(parent_.size());
        return found->second;
    }
    std::size_t rootOf(std::size_t corner) {
        while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }

    std::map<std::tuple<double, double, double>, std::size_t> numbers_;
    std::vector<std::size_t> parent_;
    std::map<std::pair<std::size_t, std::size_t>, int> uses_;
    struct Kept {
        Triangle triangle;
        std::size_t corner;
    };
    std::vector<Kept> triangles_;
};

/// An edge counts for a point where a ray along +x of the plan from it crosses the edge; whichever triangle
/// asks, the answer has the same bits, since the ends are put in order.
bool crosses(glm::dvec2 a, glm::dvec2 b, const glm::dvec2& point) {
    if (a.y > b.y || (a.y == b.y && a.x > b.x)) std::swap(a, b);
    if ((a.y > point.y) == (b.y > point.y)) return false;
    return point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

}  // namespace

/// Triangles seen along `upwards`, in the squares of a plan, so that few are asked for a point.
struct ClosedBodies::Body {
    Body(std::string name, const std::vector<Triangle>& triangles) : node(std::move(name)) {
        const glm::dvec3 across = glm::normalize(glm::cross(upwards, glm::dvec3(0.3, 0.1, 1)));
        axes = glm::transpose(glm::dmat3(across, glm::cross(upwards, across), upwards));
        for (const Triangle& triangle : triangles) {
            Triangle& turned = plan.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) turned[i] = axes * triangle[i];
            box.include(turned);
        }
        side = std::clamp(int(std::sqrt(double(plan.size()))), 1, 1024);
        squares.resize(std::size_t(side) * std::size_t(side));
        for (std::uint32_t i = 0; i < plan.size(); ++i) {
            const auto [a, b, c] = plan[i];
            const glm::ivec2 first = squareOf(glm::min(a, glm::min(b, c)));
            const glm::ivec2 last = squareOf(glm::max(a, glm::max(b, c)));
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x)
                    squares[std::size_t(y) * std::size_t(side) + std::size_t(x)].push_back(i);
            }
        }
    }

    glm::ivec2 squareOf(const glm::dvec3& turned) const {
        const glm::dvec2 size = glm::max(glm::dvec2(box.high - box.low), 1e-300);
        const glm::dvec2 share = glm::dvec2(turned - box.low) / size;
        return glm::clamp(glm::ivec2(share * double(side)), 0, side - 1);
    }

    /// By how many of its triangles are above.
    bool contains(const glm::dvec3& posWorld) const {
        const glm::dvec3 point = axes * posWorld;
        if (!box.contains(point)) return false;
        const glm::ivec2 square = squareOf(point);
        bool isInside = false;
        for (const std::uint32_t i :
             squares[std::size_t(square.y) * std::size_t(side) + std::size_t(square.x)]) {
            const auto& [a, b, c] = plan[i];
            const bool isOver = crosses(a, b, point) != (crosses(b, c, point) != crosses(c, a, point));
            if (!isOver) continue;
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double above = glm::dot(normal, a - point) * (normal.z < 0 ? -1 : 1);
            isInside = isInside != (above > 0);
        }
        return isInside;
    }

    std::string node;
    glm::dmat3 axes{1};
    std::vector<Triangle> plan;
    Box box;
    int side = 1;
    std::vector<std::vector<std::uint32_t>> squares;
};

ClosedBodies::ClosedBodies(const Scene& scene, const SceneMoment& moment,
                           std::span<const MeasuringPoint> points) {
    // Surfaces of one solid close each other.
    std::map<std::pair<int, int>, std::vector<const Instance*>> solids;
    int alone = -1;
    for (const Instance& instance : moment.instances) {
        if (!instance.casts) continue;
        const int solid = scene.meshes[std::size_t(instance.mesh)].solid;
        solids[{instance.node, solid >= 0 ? solid : alone--}].push_back(&instance);
    }
    for (const auto& [key, instances] : solids) {
        Box box;
        for (const Instance* instance : instances)
            forEachTriangle(scene, *instance, [&](const Triangle& triangle) { box.include(triangle); });
        if (std::ranges::none_of(points, [&](const auto& point) { return box.contains(lifted(point)); }))
            continue;
        Pieces pieces;
        for (const Instance* instance : instances)
            forEachTriangle(scene, *instance, [&](const Triangle& triangle) { pieces.add(triangle); });
        for (const std::vector<Triangle>& triangles : pieces.closed()) {
            Body body(scene.nodeNames[std::size_t(key.first)], triangles);
            const bool isRoom = std::ranges::any_of(moment.lights, [&](const Light& light) {
                const auto& place = light.shape.worldFromLight.columns[3];
                return light.shape.shape != LightShape::distant &&
                       body.contains({place[0], place[1], place[2]});
            });
            if (!isRoom) bodies_.push_back(std::move(body));
        }
    }
}

ClosedBodies::~ClosedBodies() = default;

const std::string* ClosedBodies::around(const MeasuringPoint& point) const {
    const glm::dvec3 posWorld = lifted(point);
    const auto found =
        std::ranges::find_if(bodies_, [&](const Body& body) { return body.contains(posWorld); });
    return found == bodies_.end() ? nullptr : &found->node;
}

}  // namespace penumbra::studio
