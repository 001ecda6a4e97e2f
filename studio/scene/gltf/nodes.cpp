// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/nodes.h"
#include "studio/scene/gltf/extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace penumbra::studio::gltf {

namespace {

constexpr int maxDepth = 1024;
constexpr double unitTolerance = 1e-3f;

glm::dmat4 affineMatrix(std::span<const double> v, const std::string& place) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = v[std::size_t(i)];
    for (int column = 0; column < 4; ++column)
        if (std::abs(matrix[column][3] - (column == 3 ? 1.0 : 0.0)) > unitTolerance)
            throw PlaceError(place, "is not an affine matrix: its last row must be 0, 0, 0, 1");
    return matrix;
}

glm::dquat unitRotation(const JsonView& json) {
    const std::vector<double> v = json.asDoubles(4);  // x, y, z, w
    const double length = std::hypot(std::hypot(v[0], v[1]), std::hypot(v[2], v[3]));
    if (!(std::abs(length - 1) <= unitTolerance)) json.fail("is not a unit quaternion");
    return glm::normalize(glm::dquat(v[3], v[0], v[1], v[2]));
}

Node loadNode(const JsonView& json, std::size_t index, std::size_t skinCount,
              const std::vector<MeshGroup>& meshes) {
    Node node{.pointer = json.pointer(), .name = json.string("name", fmt::format("node {}", index))};
    if (node.name.empty()) node.name = fmt::format("node {}", index);
    node.translation = json.dvec3("translation", glm::dvec3(0));
    node.scale = json.dvec3("scale", glm::dvec3(1));
    if (const auto rotation = json.find("rotation")) node.rotation = unitRotation(*rotation);
    if (const auto matrix = json.find("matrix")) {
        if (json.has("translation") || json.has("rotation") || json.has("scale"))
            matrix->fail("excludes translation, rotation and scale");
        node.matrix = affineMatrix(matrix->asDoubles(16), matrix->pointer());
    }

    node.mesh = json.index("mesh", meshes.size()).value_or(-1);
    node.skin = json.index("skin", skinCount).value_or(-1);
    if (const auto weights = json.find("weights")) {
        if (node.mesh < 0) weights->fail("has no mesh");
        node.weights = weights->asNumbers(meshes[std::size_t(node.mesh)].targetCount);
    }
    if (const auto visibility = extensionOf(json, "KHR_node_visibility"))
        node.visible = visibility->boolean("visible", true);
    if (const auto extras = penumbraExtrasOf(json)) {
        if (extras->has("casts")) node.casts = extras->boolean("casts", true);
        node.receives = extras->boolean("receives", true);
    }
    return node;
}

// The attributes of EXT_mesh_gpu_instancing; others, as _ID, say nothing of where the copies are.
Copies loadCopies(const JsonView& json, const Accessors& accessors, Budget& budget) {
    const JsonView attributes = json.at("attributes");
    std::optional<std::size_t> count;
    for (const std::string& name : attributes.keys()) {
        const JsonView member = attributes.at(name);
        const std::size_t elements = accessors[member.asIndex(accessors.size())].count;
        if (elements != count.value_or(elements)) member.fail("has another count than other attributes");
        count = elements;
    }
    if (!count) attributes.fail("has no attributes, so that the number of copies is not known");
    // What is placed and drawn of each weighs far more than its numbers: refused before these are read.
    budget.charge(*count, sizeof(glm::mat4) + sizeof(Instance), json.pointer());

    const auto read = [&](const char* name, const char* type, std::initializer_list<ComponentType> types) {
        const auto index = attributes.index(name, accessors.size());
        if (!index) return std::vector<float>();
        requireFormat(accessors[*index], attributes.pointer() + '/' + name, type, types);
        return readFloats(accessors[*index], budget);
    };
    using enum ComponentType;
    const std::vector<float> t = read("TRANSLATION", "VEC3", {f32}), s = read("SCALE", "VEC3", {f32}),
                             r = read("ROTATION", "VEC4", {f32, i8, i16});
    Copies copies(*count);
    for (std::size_t i = 0; i < copies.size(); ++i) {
        glm::quat rotation(1, 0, 0, 0);
        if (!r.empty()) rotation = glm::quat(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]);
        // Rounded to 8 bits, they are far from unit length.
        if (!(glm::dot(rotation, rotation) > 0 && std::isfinite(glm::dot(rotation, rotation))))
            throw PlaceError(attributes.pointer() + "/ROTATION", fmt::format("element {} is no rotation", i));
        copies[i] = composed(t.empty() ? glm::vec3(0) : glm::vec3(t[3 * i], t[3 * i + 1], t[3 * i + 2]),
                             glm::normalize(rotation),
                             s.empty() ? glm::vec3(1) : glm::vec3(s[3 * i], s[3 * i + 1], s[3 * i + 2]));
    }
    return copies;
}

std::vector<std::vector<int>> linkChildren(const std::vector<JsonView>& jsons, std::vector<Node>& nodes) {
    std::vector<std::vector<int>> children(nodes.size());
    for (std::size_t parent = 0; parent < nodes.size(); ++parent)
        for (const JsonView& json : jsons[parent].list("children")) {
            const int child = json.asIndex(nodes.size());
            if (nodes[std::size_t(child)].parent >= 0)
                json.fail(fmt::format("node {} has two parents", child));
            nodes[std::size_t(child)].parent = int(parent);
            children[parent].push_back(child);
        }
    return children;
}

// Level by level from the roots. What is not reached lies on a cycle, or beneath one.
std::vector<int> parentsFirst(const std::vector<Node>& nodes, const std::vector<std::vector<int>>& children) {
    std::vector<int> order;
    order.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].parent < 0) order.push_back(int(i));
    std::size_t levelBegin = 0;
    for (int depth = 1; levelBegin < order.size(); ++depth) {
        const std::size_t levelEnd = order.size();
        if (depth > maxDepth)
            throw PlaceError(nodes[std::size_t(order[levelBegin])].pointer,
                             fmt::format("the hierarchy is deeper than {} nodes", maxDepth));
        for (; levelBegin < levelEnd; ++levelBegin) {
            const auto& below = children[std::size_t(order[levelBegin])];
            order.insert(order.end(), below.begin(), below.end());
        }
    }
    if (order.size() < nodes.size()) {
        std::vector<bool> reached(nodes.size(), false);
        for (const int node : order) reached[std::size_t(node)] = true;
        const std::size_t first = std::size_t(std::ranges::find(reached, false) - reached.begin());
        throw PlaceError(nodes[first].pointer, "is its own ancestor, or has such an ancestor");
    }
    return order;
}

void markScene(const JsonView& root, std::optional<int> wanted, Hierarchy& hierarchy, Scene& scene) {
    std::vector<Node>& nodes = hierarchy.nodes;
    const std::vector<JsonView> scenes = root.list("scenes");
    for (const JsonView& json : scenes)
        for (const JsonView& node : json.list("nodes"))
            if (nodes[std::size_t(node.asIndex(nodes.size()))].parent >= 0) node.fail("is not a root node");
    const std::optional<int> byDefault = root.index("scene", scenes.size());
    if (wanted && (*wanted < 0 || std::size_t(*wanted) >= scenes.size()))
        throw PlaceError("/scenes",
                         fmt::format("there is no scene {}: the file has {}", *wanted, scenes.size()),
                         "ask for another");

    if (scenes.empty()) {
        scene.warnings.push_back("/scenes: the file has no scene; all of its nodes are drawn");
        for (Node& node : nodes) node.inScene = true;
        return;
    }
    const JsonView& json = scenes[std::size_t(wanted.value_or(byDefault.value_or(0)))];
    scene.name = json.string("name");
    if (!wanted && !byDefault && scenes.size() > 1)
        scene.warnings.push_back("/scene: the file names no default scene; the first of several is drawn");
    for (const JsonView& node : json.list("nodes"))
        nodes[std::size_t(node.asIndex(nodes.size()))].inScene = true;
    for (const int i : hierarchy.order)
        if (Node& node = nodes[std::size_t(i)]; node.parent >= 0)
            node.inScene = nodes[std::size_t(node.parent)].inScene;
}

Skin loadSkin(const JsonView& json, std::size_t nodeCount, const Accessors& accessors, Budget& budget) {
    Skin skin;
    for (const JsonView& joint : json.at("joints").elements())
        skin.joints.push_back(joint.asIndex(nodeCount));
    if (skin.joints.empty()) json.fail("has no joints");
    json.index("skeleton", nodeCount);
    budget.charge(skin.joints.size(), sizeof(glm::mat4), json.pointer());
    skin.jointFromMesh.assign(skin.joints.size(), glm::mat4(1));
    if (const auto index = json.index("inverseBindMatrices", accessors.size())) {
        const Accessor& accessor = accessors[*index];
        requireFormat(accessor, json.pointer() + "/inverseBindMatrices", "MAT4", {ComponentType::f32});
        if (accessor.count < skin.joints.size()) json.fail("has fewer inverse bind matrices than joints");
        const std::vector<float> values = readFloats(accessor, budget);
        for (std::size_t i = 0; i < skin.joints.size(); ++i)
            skin.jointFromMesh[i] =
                affineMatrix(std::vector<double>(values.begin() + std::ptrdiff_t(16 * i),
                                                 values.begin() + std::ptrdiff_t(16 * i + 16)),
                             fmt::format("{}: element {}", accessor.pointer, i));
    }
    return skin;
}

// A skin deforms a mesh only if every joint that the mesh names is there.
void checkSkins(Hierarchy& hierarchy, const std::vector<MeshGroup>& meshes, Scene& scene) {
    for (Node& node : hierarchy.nodes) {
        if (node.skin < 0) continue;
        const std::uint32_t used = node.mesh < 0 ? 0 : meshes[std::size_t(node.mesh)].jointCount;
        const std::size_t present = hierarchy.skins[std::size_t(node.skin)].joints.size();
        if (used > present)
            throw PlaceError(node.pointer, fmt::format("its mesh names joint {}, but its skin has {} joints",
                                                       used - 1, present));
        if (used == 0) {
            scene.warnings.push_back(node.pointer + "/skin: the node has no mesh with joints; ignored");
            node.skin = -1;
        }
    }
}

}  // namespace

glm::dmat4 composed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
    const glm::dmat3 r = glm::mat3_cast(rotation);
    return {glm::dvec4(r[0] * scale.x, 0), glm::dvec4(r[1] * scale.y, 0), glm::dvec4(r[2] * scale.z, 0),
            glm::dvec4(translation, 1)};
}

Hierarchy loadHierarchy(const JsonView& root, const Accessors& accessors,
                        const std::vector<MeshGroup>& meshes, std::optional<int> wanted, Budget& budget,
                        Scene& scene) {
    Hierarchy hierarchy;
    const std::vector<JsonView> jsons = root.list("nodes"), skinJsons = root.list("skins");
    for (const JsonView& json : jsons)
        hierarchy.nodes.push_back(loadNode(json, hierarchy.nodes.size(), skinJsons.size(), meshes));
    hierarchy.order = parentsFirst(hierarchy.nodes, linkChildren(jsons, hierarchy.nodes));
    markScene(root, wanted, hierarchy, scene);
    for (const int i : hierarchy.order)
        if (Node& node = hierarchy.nodes[std::size_t(i)]; node.parent >= 0)
            node.visible = node.visible && hierarchy.nodes[std::size_t(node.parent)].visible;
    for (const JsonView& json : skinJsons)
        hierarchy.skins.push_back(loadSkin(json, jsons.size(), accessors, budget));
    checkSkins(hierarchy, meshes, scene);
    for (std::size_t i = 0; i < jsons.size(); ++i)
        if (const auto json = extensionOf(jsons[i], "EXT_mesh_gpu_instancing")) {
            if (hierarchy.nodes[i].mesh < 0) continue;
            if (hierarchy.nodes[i].skin >= 0)
                json->fail("its mesh has a skin, which alone says where it is: there are no copies of it");
            hierarchy.nodes[i].copies = loadCopies(*json, accessors, budget);
        }
    for (const Node& node : hierarchy.nodes) scene.nodeNames.push_back(node.name);
    return hierarchy;
}

}  // namespace penumbra::studio::gltf
