// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/caster_soup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "src/device/glm_types.h"

namespace penumbra::exact_visibility {
namespace {

template <typename T>
bool sameBits(const std::vector<T>& a, std::span<const T> b) {
    return a.size() == b.size() && (b.empty() || std::memcmp(a.data(), b.data(), b.size_bytes()) == 0);
}

bool sameMatrix(const Mat4& a, const Mat4& b) {
    return std::memcmp(&a, &b, sizeof(Mat4)) == 0;
}

glm::uvec4 texel(const glm::vec3& v, std::uint32_t w) {
    return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
            std::bit_cast<std::uint32_t>(v.z), w};
}

/// The middle of the casters, rounded to a multiple of a power of two that is larger than they are: it stays
/// where it is while they move about, and depends on nothing but the inputs.
glm::dvec3 chooseOrigin(std::span<const Caster> casters) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const Caster& caster : casters) {
        const Box& box = caster.mesh->bounds();
        if (box.min.x > box.max.x) continue;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec4 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                    i & 4 ? box.max.z : box.min.z, 1);
            const glm::dvec3 posWorld = toGlm(caster.worldFromMesh) * corner;
            low = glm::min(low, posWorld);
            high = glm::max(high, posWorld);
        }
    }
    const glm::dvec3 extent = high - low;
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (!(largest > 0) || !std::isfinite(largest)) return glm::dvec3(0);
    const double grid = std::exp2(std::ceil(std::log2(largest)));
    return glm::round(0.5 * (low + high) / grid) * grid;
}

/// How much longer a vector may become at most.
double stretchOf(const glm::dmat3& matrix) {
    // The square of the greatest stretch is an eigenvalue of this, and no eigenvalue exceeds the sums of its
    // rows.
    const glm::dmat3 squares = glm::transpose(matrix) * matrix;
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        largest =
            std::max(largest, std::abs(squares[i][0]) + std::abs(squares[i][1]) + std::abs(squares[i][2]));
    return std::sqrt(largest);
}

}  // namespace

CasterSoup::CasterSoup()
    : nodes_("exact/nodes"), triangles_("exact/triangles"), masked_("exact/texture coordinates") {}

void CasterSoup::Entry::take(const Caster& caster, bool usesStandIns) {
    const bool sameTriangles = sameBits(indices, caster.mesh->indices());
    const bool samePositions = sameBits(positions, caster.mesh->positions());
    deforms = deforms || (sameTriangles && !samePositions && !indices.empty());
    if (!sameTriangles) {
        const auto span = caster.mesh->indices();
        indices.assign(span.begin(), span.end());
    }
    const auto newPositions = caster.mesh->positions();
    positions.assign(newPositions.begin(), newPositions.end());
    const auto newUvs = caster.mesh->uvs();
    uvs.assign(newUvs.begin(), newUvs.end());
    worldFromMesh = caster.worldFromMesh;
    mesh = caster.mesh->id();
    revision = caster.mesh->revision();
    if (!sameTriangles || shape.nodes.empty()) {
        std::vector<TreeBox> meshBoxes(indices.size() / 3);
        for (std::size_t i = 0; i < indices.size(); ++i) meshBoxes[i / 3].add(toGlm(positions[indices[i]]));
        shape = buildTree(meshBoxes, EXACT_LEAF_TRIANGLES);
    }
    const bool makes = mayHaveStandIns(caster, usesStandIns);
    if (makes && hasStandIns && sameTriangles && samePositions) return;
    hasStandIns = makes;
    standIns.clear();
    standInIndices.clear();
    if (makes) makeStandInTrees();
}

void CasterSoup::Entry::makeStandInTrees() {
    StandIns made = makeStandIns(shape, positions, indices);
    standInIndices = std::move(made.indices);
    std::size_t node = shape.nodes.size();
    std::vector<TreeBox> meshBoxes;
    for (const StandIn& standIn : made.list) {
        meshBoxes.assign(standIn.count, {});
        for (std::size_t i = 0; i < 3 * standIn.count; ++i)
            meshBoxes[i / 3].add(toGlm(positions[standInIndices[3 * standIn.first + i]]));
        standIns.push_back({.node = standIn.node,
                            .deviation_m = standIn.deviation,
                            .firstNode = node,
                            .firstTriangle = indices.size() / 3 + standIn.first,
                            .shape = buildTree(meshBoxes, EXACT_LEAF_TRIANGLES),
                            .boxes = {}});
        node += 1 + standIns.back().shape.nodes.size();
    }
}

std::size_t CasterSoup::Entry::nodeCount() const {
    return standIns.empty() ? shape.nodes.size()
                            : standIns.back().firstNode + 1 + standIns.back().shape.nodes.size();
}

void CasterSoup::Entry::place(const glm::dvec3& origin, std::vector<glm::vec3>& posScene) {
    glm::dmat4 sceneFromMesh = toGlm(worldFromMesh);
    sceneFromMesh[3] -= glm::dvec4(origin, 0);
    posScene.resize(positions.size());
    std::ranges::transform(positions, posScene.begin(), [&](const Vec3& posMesh) {
        return glm::vec3(sceneFromMesh * glm::dvec4(toGlm(posMesh), 1));
    });
    corners.resize(indices.size() + standInIndices.size());
    const auto refit = [&](const TreeShape& tree, std::span<const std::uint32_t> vertices,
                           std::span<glm::uvec4> placed, std::vector<TreeBox>& result) {
        const auto boxOf = [&](const TreeShape::Node& leaf) {
            TreeBox box;
            for (std::size_t place = leaf.first; place < leaf.first + leaf.count; ++place) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::vec3& corner = posScene[vertices[3 * std::size_t(tree.order[place]) + k]];
                    placed[3 * place + k] = texel(corner, 0);
                    box.add(corner);
                }
            }
            return box;
        };
        refitTree(tree, boxOf, result);
    };
    refit(shape, indices, corners, boxes);
    for (StandInTree& standIn : standIns) {
        refit(standIn.shape, std::span(standInIndices).subspan(3 * standIn.firstTriangle - indices.size()),
              std::span(corners).subspan(3 * standIn.firstTriangle), standIn.boxes);
    }
}

/// Meshes that are deformed would need others in each frame.
bool CasterSoup::Entry::mayHaveStandIns(const Caster& caster, bool usesStandIns) const {
    return usesStandIns && !deforms && caster.mesh->revision() == 0 && caster.alphaMask.texture == 0 &&
           !isPane(caster) && caster.mesh->indices().size() >= 3 * leastForStandIns;
}

bool CasterSoup::Entry::isStale(const Caster& caster, bool usesStandIns) const {
    if (hasStandIns != mayHaveStandIns(caster, usesStandIns)) return true;
    if (!sameMatrix(worldFromMesh, caster.worldFromMesh)) return true;
    if (mesh == caster.mesh->id() && revision == caster.mesh->revision()) return false;
    return !sameBits(indices, caster.mesh->indices()) || !sameBits(positions, caster.mesh->positions()) ||
           !sameBits(uvs, caster.mesh->uvs());
}

/// Only a host can tell whether texels are as they were.
bool CasterSoup::Entry::mayLetOtherLightThrough(const Caster& caster) const {
    if (transmittance != caster.transmittance) return true;
    const AlphaMask& now = caster.alphaMask;
    if (now.texture == 0) return holes.texture != 0;
    return now.revision == 0 || now.revision != holes.revision || now.texture != holes.texture ||
           now.factor != holes.factor || now.cutoff != holes.cutoff;
}

std::uint32_t CasterSoup::Entry::flags() const {
    return (mask >= 0 ? EXACT_MASKED : 0) | (pane >= 0 ? EXACT_PANE : 0);
}

void CasterSoup::noteChanged(const Entry& entry) {
    if (entry.boxes.empty()) return;
    changed_.emplace_back(entry.boxes.front().min, 0);
    changed_.emplace_back(entry.boxes.front().max, 0);
}

void CasterSoup::update(std::span<const Caster> casters, bool usesStandIns) {
    try {
        take(casters, usesStandIns);
        send();
    } catch (...) {
        // Half an update is none: the next one begins with nothing, and nobody has seen what it changes.
        entries_.clear();
        revision_ += 2;
        throw;
    }
}

void CasterSoup::take(std::span<const Caster> casters, bool usesStandIns) {
    const glm::dvec3 origin = chooseOrigin(casters);
    const bool moved = origin != originWorld_;
    originWorld_ = origin;

    // What is the same as before stays; masks are named by their place in the list of masks.
    masks_.clear();
    transmittances_.clear();
    changed_.clear();
    std::size_t count = 0;
    for (const Caster& caster : casters) {
        if (!caster.casts || caster.mesh->indices().empty()) continue;
        int mask = -1;
        if (caster.alphaMask.texture != 0) {
            mask = int(masks_.size());
            masks_.push_back(caster.alphaMask);
        }
        int pane = -1;
        if (isPane(caster)) {
            pane = int(transmittances_.size());
            transmittances_.emplace_back(toGlm(caster.transmittance), 0);
        }
        if (count == entries_.size()) entries_.emplace_back();
        Entry& entry = entries_[count++];
        const bool stale = entry.isStale(caster, usesStandIns);
        const bool changes = stale || moved || entry.mayLetOtherLightThrough(caster);
        if (changes) noteChanged(entry);
        if (stale) entry.take(caster, usesStandIns);
        if (stale || moved) entry.place(origin, posScene_);
        entry.holes = caster.alphaMask;
        entry.transmittance = caster.transmittance;
        if (changes) noteChanged(entry);
        entry.isSent = entry.isSent && !stale && !moved && entry.mask == mask && entry.pane == pane;
        entry.mask = mask;
        entry.pane = pane;
    }
    for (std::size_t i = count; i < entries_.size(); ++i) noteChanged(entries_[i]);
    entries_.resize(count);
    if (!changed_.empty()) ++revision_;
}

void CasterSoup::send() {
    // Places: the top tree's nodes first, then each caster's.
    std::size_t node = entries_.empty() ? 0 : 2 * entries_.size() - 1, triangle = 0, masked = 0, panes = 0;
    bool changed = false;
    for (Entry& entry : entries_) {
        const std::size_t triangles = entry.corners.size() / 3;
        entry.isSent = entry.isSent && entry.firstNode == node && entry.firstTriangle == triangle &&
                       entry.firstMasked == masked;
        changed = changed || !entry.isSent;
        entry.firstNode = node;
        entry.firstTriangle = triangle;
        entry.firstMasked = masked;
        node += entry.nodeCount();
        triangle += triangles;
        if (entry.mask >= 0) masked += triangles;
        if (entry.pane >= 0) panes += triangles;
    }
    changed = changed || node != nodeCount_;
    nodeCount_ = node;
    triangleCount_ = triangle;
    maskedCount_ = masked;
    paneTriangleCount_ = panes;
    // All three, whichever has lost what it held.
    const bool nodesLost = nodes_.reserve(2 * node), trianglesLost = triangles_.reserve(3 * triangle),
               maskedLost = masked_.reserve(2 * masked);
    const bool lost = nodesLost || trianglesLost || maskedLost;
    if (!changed && !lost) return;
    for (Entry& entry : entries_) {
        if (lost || !entry.isSent) send(entry);
    }
    sendTop();
}

void CasterSoup::sendNodes(const Entry& entry) {
    std::vector<glm::uvec4>& texels = texels_;
    texels.clear();
    texels.reserve(2 * entry.nodeCount());
    // `after` follows where the tree ends.
    const auto add = [&](const TreeShape& shape, std::span<const TreeBox> boxes, std::size_t firstNode,
                         std::size_t firstTriangle, std::uint32_t after) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const TreeShape::Node& node = shape.nodes[i];
            const bool last = node.skip == boxes.size();
            texels.push_back(texel(boxes[i].min, last ? after : std::uint32_t(firstNode) + node.skip));
            const std::uint32_t leaf = (std::uint32_t(firstTriangle) + node.first) |
                                       (node.count - 1) << EXACT_COUNT_SHIFT | entry.flags();
            texels.push_back(texel(boxes[i].max, node.count == 0 ? EXACT_INNER : leaf));
        }
    };
    add(entry.shape, entry.boxes, entry.firstNode, entry.firstTriangle, EXACT_END);
    glm::dmat4 worldFromMesh = toGlm(entry.worldFromMesh);
    const double stretch = stretchOf(glm::dmat3(worldFromMesh));
    for (const StandInTree& standIn : entry.standIns) {
        const auto header = std::uint32_t(entry.firstNode + standIn.firstNode);
        const std::uint32_t after = texels[2 * std::size_t(standIn.node)].w;
        texels[2 * std::size_t(standIn.node) + 1].w = EXACT_STAND_IN | header;
        texels.push_back(texel(glm::vec3(float(stretch * double(standIn.deviation_m)), 0, 0), after));
        texels.push_back(texel(glm::vec3(0), EXACT_INNER));
        add(standIn.shape, standIn.boxes, header + 1, entry.firstTriangle + standIn.firstTriangle, after);
    }
    nodes_.write(texels, 2 * entry.firstNode);
}

void CasterSoup::send(Entry& entry) {
    sendNodes(entry);

    // Only of triangles with holes it is asked where their texture coordinates are.
    for (std::size_t i = 0; i < entry.corners.size() && entry.mask >= 0; ++i)
        entry.corners[i].w = std::uint32_t(entry.firstMasked + i / 3);
    // Of those of panes, at their second corner, which pane they are of.
    for (std::size_t i = 1; i < entry.corners.size() && entry.pane >= 0; i += 3)
        entry.corners[i].w = std::uint32_t(entry.pane);
    triangles_.write(entry.corners, 3 * entry.firstTriangle);

    if (entry.mask >= 0) {
        std::vector<glm::uvec4>& texels = texels_;
        texels.clear();
        const auto uv = [&](std::size_t corner) {
            const std::uint32_t vertex = entry.indices[corner];
            return vertex < entry.uvs.size() ? glm::vec2(entry.uvs[vertex].x, entry.uvs[vertex].y)
                                             : glm::vec2(0);
        };
        for (const std::uint32_t triangle : entry.shape.order) {
            const std::size_t i = 3 * std::size_t(triangle);
            texels.push_back(texel({uv(i), uv(i + 1).x}, std::bit_cast<std::uint32_t>(uv(i + 1).y)));
            texels.push_back(texel({uv(i + 2), 0}, std::uint32_t(entry.mask)));
        }
        masked_.write(texels, 2 * entry.firstMasked);
    }
    entry.isSent = true;
}

void CasterSoup::sendTop() {
    std::vector<TreeBox> roots;
    for (const Entry& entry : entries_) roots.push_back(entry.boxes.front());
    const TreeShape shape = buildTree(roots, 1);
    std::vector<TreeBox> boxes;
    refitTree(
        shape, [&](const TreeShape::Node& leaf) { return roots[shape.order[leaf.first]]; }, boxes);
    std::vector<glm::uvec4>& texels = texels_;
    texels.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const TreeShape::Node& node = shape.nodes[i];
        texels.push_back(texel(boxes[i].min, node.skip == boxes.size() ? EXACT_END : node.skip));
        std::uint32_t leaf = EXACT_INNER;
        if (node.count > 0) {
            const Entry& entry = entries_[shape.order[node.first]];
            leaf = EXACT_SUBTREE | entry.flags() | std::uint32_t(entry.firstNode);
        }
        texels.push_back(texel(boxes[i].max, leaf));
    }
    nodes_.write(texels, 0);
}

std::size_t CasterSoup::countNear(const glm::vec3& planePoint, const glm::vec3& normal,
                                  float distance) const {
    std::size_t count = 0;
    for (const Entry& entry : entries_) {
        const TreeBox& box = entry.boxes.front();
        const glm::vec3 middle = 0.5f * (box.min + box.max), extent = 0.5f * (box.max - box.min);
        const float reach = glm::dot(glm::abs(normal), extent) + distance;
        if (!(std::abs(glm::dot(normal, middle - planePoint)) > reach)) count += entry.corners.size() / 3;
    }
    return count;
}

std::size_t CasterSoup::standInTriangleCount() const {
    std::size_t count = 0;
    for (const Entry& entry : entries_) count += entry.standInIndices.size() / 3;
    return count;
}

float CasterSoup::farthestFrom(const glm::vec3& point) const {
    float farthest = 0;
    for (const Entry& entry : entries_) {
        const TreeBox& box = entry.boxes.front();
        farthest =
            std::max(farthest, glm::length(glm::max(glm::abs(box.min - point), glm::abs(box.max - point))));
    }
    return farthest;
}

void CasterSoup::bindTo(gl::Pass& pass) const {
    pass.bind("treeNodes", nodes_.ref()).bind("triangles", triangles_.ref());
    if (pass.has("maskedTriangles")) pass.bind("maskedTriangles", masked_.ref());
}

}  // namespace penumbra::exact_visibility
