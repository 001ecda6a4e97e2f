// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/info_nodes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <vector>

#include "studio/errors.h"
#include "studio/json_text.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/wildcard.h"

namespace penumbra::studio {
namespace {

struct NodeInfo {
    std::string name;
    glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
    std::size_t triangles = 0;
    std::set<std::string> materials;
    bool casts = false, receives = false;
};

std::vector<NodeInfo> collect(const Scene& scene, const SceneMoment& moment) {
    const glm::dmat4 fileFromWorld = glm::inverse(scene.worldFromFile);
    std::vector<NodeInfo> nodes;
    int last = -1;
    for (const Instance& instance : moment.instances) {
        if (instance.node != last || nodes.empty())
            nodes.push_back({.name = scene.nodeNames[std::size_t(instance.node)]});
        last = instance.node;
        NodeInfo& node = nodes.back();
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::dmat4 fileFromMesh = fileFromWorld * glm::dmat4(instance.worldFromMesh);
        for (const glm::vec3& position : instance.positions.empty() ? mesh.positions : instance.positions) {
            const glm::dvec3 posFile = fileFromMesh * glm::dvec4(position, 1);
            node.min = glm::min(node.min, posFile);
            node.max = glm::max(node.max, posFile);
        }
        node.triangles += mesh.indices.size() / 3;
        const std::string& material = scene.materials[std::size_t(mesh.material)].name;
        node.materials.insert(material.empty() ? fmt::format("material {}", mesh.material) : material);
        node.casts = node.casts || instance.casts;
        node.receives = node.receives || instance.receives;
    }
    return nodes;
}

void printTable(const std::vector<NodeInfo>& nodes) {
    std::size_t width = 0;
    for (const NodeInfo& node : nodes) width = std::max(width, node.name.size());
    for (const NodeInfo& node : nodes)
        fmt::print("{:{}}  ({:.8g}, {:.8g}, {:.8g}) to ({:.8g}, {:.8g}, {:.8g})  {} triangles  {}{}{}\n",
                   node.name, width, node.min.x, node.min.y, node.min.z, node.max.x, node.max.y, node.max.z,
                   node.triangles, fmt::join(node.materials, ", "), node.casts ? "" : "  casts no shadow",
                   node.receives ? "" : "  receives none");
}

void printJson(const std::vector<NodeInfo>& nodes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const NodeInfo& node : nodes)
        list.push_back({{"node", node.name},
                        {"min", {node.min.x, node.min.y, node.min.z}},
                        {"max", {node.max.x, node.max.y, node.max.z}},
                        {"triangles", node.triangles},
                        {"materials", node.materials},
                        {"casts", node.casts},
                        {"receives", node.receives}});
    std::cout << jsonText(list);
}

}  // namespace

void printNodes(const Scene& scene, const SceneMoment& moment, const std::string& pattern, bool json) {
    std::vector<NodeInfo> nodes = collect(scene, moment);
    std::vector<NodeInfo> matching;
    std::ranges::copy_if(nodes, std::back_inserter(matching),
                         [&](const NodeInfo& node) { return matchesWildcard(node.name, pattern); });
    if (matching.empty()) {
        std::vector<std::string_view> names;
        for (const NodeInfo& node : nodes) names.push_back(node.name);
        throw UsageError(
            fmt::format("no node with a mesh is named '{}'{}", pattern, didYouMean(pattern, names)));
    }
    if (json)
        printJson(matching);
    else
        printTable(matching);
}

}  // namespace penumbra::studio
