// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/patch_simplifier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace penumbra::exact_visibility {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// Of the angle by which a triangle may turn: those that turn further are about to fold over.
constexpr float leastCosine = 0.25f;

}  // namespace

float distanceToTriangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    // In which of seven regions of its plane the point is (Ericson 2005, 5.1.5).
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
                d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return glm::length(ap);
    if (d3 >= 0 && d4 <= d3) return glm::length(bp);
    if (d6 >= 0 && d5 <= d6) return glm::length(cp);
    const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - d1 / (d1 - d3) * ab);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - d2 / (d2 - d6) * ac);
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const float share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return glm::length(bp - share * (c - b));
    }
    const float sum = va + vb + vc;
    return glm::length(ap - vb / sum * ab - vc / sum * ac);
}

PatchSimplifier::PatchSimplifier(std::span<const glm::vec3> positions)
    : positions_(positions), localOf_(positions.size(), none) {}

void PatchSimplifier::Quadric::add(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
}

void PatchSimplifier::load(std::span<const Triangle> triangles) {
    vertices_.clear();
    faces_.clear();
    at_.clear();
    deviation_ = 0;
    const auto localOf = [&](std::uint32_t vertex) {
        if (localOf_[vertex] == none) {
            localOf_[vertex] = std::uint32_t(vertices_.size());
            vertices_.push_back(vertex);
            at_.push_back(positions_[vertex] - positions_[vertices_.front()]);
        }
        return localOf_[vertex];
    };
    for (const auto& [a, b, c] : triangles) {
        if (a == b || b == c || c == a) continue;
        const std::uint32_t localA = localOf(a), localB = localOf(b), localC = localOf(c);
        faces_.push_back({.vertices = {localA, localB, localC}, .firstPoint = none});
    }
    for (const std::uint32_t vertex : vertices_) localOf_[vertex] = none;
    const std::size_t count = vertices_.size();
    quadrics_.assign(count, {});
    nextPoint_.assign(count, none);
    ringOf_.assign(count, none);
    seenFrom_.assign(count, 0);
    stamp_ = 1;
    if (facesOf_.size() < count) facesOf_.resize(count);
    for (std::size_t i = 0; i < count; ++i) facesOf_[i].clear();
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
        const auto& [a, b, c] = faces_[i].vertices;
        const glm::dvec3 across =
            glm::cross(glm::dvec3(at_[b]) - glm::dvec3(at_[a]), glm::dvec3(at_[c]) - glm::dvec3(at_[a]));
        const double area = glm::length(across);
        if (area > 0) {
            const glm::dvec3 normal = across / area;
            const double height = -glm::dot(normal, glm::dvec3(at_[a]));
            const Quadric plane{.a = area * glm::outerProduct(normal, normal),
                                .b = area * height * normal,
                                .c = area * height * height};
            for (const std::uint32_t vertex : faces_[i].vertices) quadrics_[vertex].add(plane);
        }
        for (const std::uint32_t vertex : faces_[i].vertices) facesOf_[vertex].push_back(i);
    }
}

/// The vertex's neighbours, each followed by the next one around it. False where they do not close a ring,
/// which is so of all vertices at the patch's rim, and stays so, since no edge there goes or comes.
bool PatchSimplifier::findRing(std::uint32_t vertex) {
    spokes_.clear();
    for (const std::uint32_t face : facesOf_[vertex]) {
        const Triangle& v = faces_[face].vertices;
        const int k = v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
        spokes_.emplace_back(v[std::size_t(k + 1) % 3], v[std::size_t(k + 2) % 3]);
    }
    ring_.clear();
    const std::uint32_t first = spokes_.front().first;
    std::uint32_t at = first;
    do {
        ring_.push_back(at);
        std::uint32_t next = none;
        for (const auto& [from, to] : spokes_) {
            if (from != at) continue;
            if (next != none) return false;
            next = to;
        }
        if (next == none || ring_.size() > spokes_.size()) return false;
        at = next;
    } while (at != first);
    for (const std::uint32_t neighbour : ring_) ringOf_[neighbour] = vertex;
    return ring_.size() == spokes_.size() && ring_.size() >= 3;
}

/// Whether the vertex, whose ring is known, may be moved to one of it: without another sheet than the one
/// around both, and without folds.
bool PatchSimplifier::mayMove(std::uint32_t from, std::uint32_t to) {
    // Of the ring, those that are neighbours of both.
    int shared = 0;
    for (const std::uint32_t face : facesOf_[to]) {
        for (const std::uint32_t vertex : faces_[face].vertices) {
            if (vertex == to || ringOf_[vertex] != from || seenFrom_[vertex] == stamp_) continue;
            seenFrom_[vertex] = stamp_;
            ++shared;
        }
    }
    ++stamp_;
    if (shared != 2) return false;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
        const std::uint32_t a = ring_[i], b = ring_[(i + 1) % ring_.size()];
        if (a == to || b == to) continue;
        const glm::vec3 before = glm::cross(at_[a] - at_[from], at_[b] - at_[from]);
        const glm::vec3 after = glm::cross(at_[a] - at_[to], at_[b] - at_[to]);
        const float along = glm::dot(before, after);
        const float sizes2 = glm::dot(before, before) * glm::dot(after, after);
        if (!(along > 0 && along * along > leastCosine * leastCosine * sizes2)) return false;
    }
    return true;
}

std::optional<PatchSimplifier::Collapse> PatchSimplifier::bestFor(std::uint32_t vertex) {
    if (!findRing(vertex)) return {};
    options_.clear();
    for (const std::uint32_t to : ring_) {
        const glm::dvec3 p(at_[to]);
        const double cost = std::max(quadrics_[vertex](p), 0.0) + std::max(quadrics_[to](p), 0.0);
        options_.push_back({cost, vertex, to});
    }
    // The first one that may be is mostly the first.
    while (!options_.empty()) {
        const auto cheapest = std::ranges::min_element(options_, {}, &Collapse::cost);
        if (mayMove(vertex, cheapest->to)) return *cheapest;
        options_.erase(cheapest);
    }
    return {};
}

/// False, and nothing done, where more would deviate.
bool PatchSimplifier::collapse(const Collapse& collapse, float largestDeviation) {
    const auto [cost, from, to] = collapse;
    if (!findRing(from) || !mayMove(from, to)) return false;
    // New triangles: between the vertex that stays and each pair of the ring without it.
    std::rotate(ring_.begin(), std::ranges::find(ring_, to), ring_.end());
    const auto fromNew = [&](const glm::vec3& p, std::size_t i) {
        return distanceToTriangle(p, at_[to], at_[ring_[i]], at_[ring_[i + 1]]);
    };
    float worst = 0;
    moved_.clear();
    const auto move = [&](std::uint32_t point) {
        std::size_t nearest = 1;
        float distance = std::numeric_limits<float>::infinity();
        for (std::size_t i = 1; i + 1 < ring_.size(); ++i) {
            const float other = fromNew(at_[point], i);
            if (other < distance) distance = other, nearest = i;
        }
        worst = std::max(worst, distance);
        moved_.emplace_back(point, nearest);
    };
    move(from);
    for (const std::uint32_t face : facesOf_[from]) {
        for (std::uint32_t point = faces_[face].firstPoint; point != none && worst <= largestDeviation;
             point = nextPoint_[point])
            move(point);
    }
    for (std::size_t i = 2; i + 1 < ring_.size() && worst <= largestDeviation; ++i) {
        const glm::vec3 middle = 0.5f * (at_[to] + at_[ring_[i]]);
        float distance = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < ring_.size(); ++k) {
            distance = std::min(distance, distanceToTriangle(middle, at_[from], at_[ring_[k]],
                                                             at_[ring_[(k + 1) % ring_.size()]]));
        }
        worst = std::max(worst, distance);
    }
    if (!(worst <= largestDeviation)) return false;
    deviation_ = std::max(deviation_, worst);

    const std::vector<std::uint32_t> old = std::move(facesOf_[from]);
    facesOf_[from].clear();
    for (const std::uint32_t face : old) {
        faces_[face].isThere = false;
        for (const std::uint32_t vertex : faces_[face].vertices)
            if (vertex != from) std::erase(facesOf_[vertex], face);
    }
    for (std::size_t i = 1; i + 1 < ring_.size(); ++i) {
        const std::uint32_t face = old[i - 1];
        faces_[face] = {.vertices = {to, ring_[i], ring_[i + 1]}, .firstPoint = none};
        for (const std::uint32_t vertex : faces_[face].vertices) facesOf_[vertex].push_back(face);
    }
    for (const auto& [point, nearest] : moved_)
        nextPoint_[point] = std::exchange(faces_[old[nearest - 1]].firstPoint, point);
    quadrics_[to].add(quadrics_[from]);
    for (const std::uint32_t vertex : ring_) isTouched_[vertex] = 1;
    return true;
}

PatchSimplifier::Result PatchSimplifier::simplify(std::span<const Triangle> triangles,
                                                  float largestDeviation) {
    load(triangles);
    isTouched_.assign(vertices_.size(), 1);
    best_.assign(vertices_.size(), {});
    // In each pass what is cheapest, where nothing has changed since its cost was computed.
    for (bool changes = true; changes;) {
        collapses_.clear();
        for (std::uint32_t vertex = 0; vertex < vertices_.size(); ++vertex) {
            if (std::exchange(isTouched_[vertex], 0)) best_[vertex] = bestFor(vertex);
            if (best_[vertex]) collapses_.push_back(&*best_[vertex]);
        }
        std::ranges::sort(collapses_, {}, [](const Collapse* c) { return std::pair(c->cost, c->from); });
        changes = false;
        for (const Collapse* next : collapses_) {
            const std::uint32_t from = next->from;
            if (isTouched_[from]) continue;
            changes = collapse(*next, largestDeviation) || changes;
            best_[from].reset();
        }
    }
    Result result{.triangles = {}, .deviation = deviation_};
    for (const Face& face : faces_) {
        if (!face.isThere) continue;
        const auto& [a, b, c] = face.vertices;
        result.triangles.push_back({vertices_[a], vertices_[b], vertices_[c]});
    }
    return result;
}

}  // namespace penumbra::exact_visibility
