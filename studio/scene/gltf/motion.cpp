// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

#include "studio/errors.h"
#include "studio/scene/gltf/unit_vector.h"

namespace penumbra::studio::gltf {

namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Also as floats.
bool isFinite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(m[column][row]) <= double(std::numeric_limits<float>::max()))) return false;
    return true;
}

// det(m) times the inverse transpose of m: turns normals with it, whether or not m can be inverted. The sign
// keeps them on their side of the surface where m mirrors.
glm::vec3 turnedNormal(const glm::mat3& m, const glm::vec3& normal) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const float side = glm::dot(m[0], cofactors[0]) < 0 ? -1.0f : 1.0f;
    return unitOr(side * (cofactors * normal), normal);
}

// In the world. NaN passes comparisons unnoticed, so that the bounds alone would not show an overflow.
Bounds boundsOf(const std::vector<glm::vec3>& positions, const glm::mat4& worldFromMesh, const Node& node) {
    Bounds bounds;
    for (const glm::vec3& position : positions) {
        const glm::vec3 posWorld(worldFromMesh * glm::vec4(position, 1));
        if (!isFinite(posWorld)) throw PlaceError(node.pointer, "its mesh overflows");
        bounds.include(posWorld);
    }
    return bounds;
}

// A moment of the loop in [0, duration]: each round ends with the last key and not with the first once more.
double wrapped_s(double time_s, double duration_s) {
    if (!(duration_s > 0) || !std::isfinite(time_s)) return 0;
    constexpr double rounding = 1e-6;  // key times are floats
    const double rounds = time_s / duration_s;
    if (std::abs(rounds) <= rounding) return 0;
    return std::clamp(time_s - duration_s * (std::ceil(rounds - rounding) - 1), 0.0, duration_s);
}

// Placing and measuring this many takes a few seconds.
constexpr std::uint64_t maxInstancedVertices = 1u << 29;

}  // namespace

GltfMotion::GltfMotion(Parts parts, Budget& budget, Scene& scene) : parts_(std::move(parts)) {
    const std::vector<Node>& nodes = parts_.hierarchy.nodes;
    std::uint64_t instancedVertices = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].inScene || !nodes[i].visible || nodes[i].mesh < 0) continue;
        const MeshGroup& group = parts_.meshes[std::size_t(nodes[i].mesh)];
        const std::size_t copies = nodes[i].copies ? nodes[i].copies->size() : 1;
        for (const MeshGroup::Part& part : group.parts) {
            const Mesh& mesh = scene.meshes[std::size_t(part.mesh)];
            instancedVertices += copies * mesh.positions.size();
            if (instancedVertices > maxInstancedVertices)
                throw PlaceError(nodes[i].pointer,
                                 "with its mesh, more vertices are drawn than can be handled",
                                 "draw fewer copies");
            budget.charge(copies, sizeof(Placement) + sizeof(Instance), nodes[i].pointer);
            if (mesh.deforms())
                budget.charge(copies * mesh.positions.size(), 2 * sizeof(glm::vec3), nodes[i].pointer);
        }
        for (std::size_t copy = 0; copy < copies; ++copy)
            for (const MeshGroup::Part& part : group.parts)
                placements_.push_back({.node = int(i), .copy = copy, .part = part, .origin = group.origin});
    }

    // The rest pose is the one without animations.
    std::vector<Channel> channels = std::exchange(parts_.channels, {});
    comeNear(scene);
    scene.worldFromFile = parts_.worldFromFile;
    const Pose rest = poseAt(0);
    for (Placement& placement : placements_) {
        const Mesh& mesh = scene.meshes[std::size_t(placement.part.mesh)];
        placement.restWorldFromMesh = glm::mat4(worldFromMesh(placement, rest));
        if (!mesh.deforms())
            placement.restBounds =
                boundsOf(mesh.positions, placement.restWorldFromMesh, nodes[std::size_t(placement.node)]);
    }
    const double unit_m = glm::length(glm::dvec3(parts_.worldFromFile[0]));
    for (const PlacedLight& placed : parts_.lights) {
        if (placed.size == LightSize::scalesWithNode) continue;
        const glm::dmat3 m(rest.worldFromNode[std::size_t(placed.node)]);
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(glm::length(m[axis]) / unit_m - 1) > 1e-3) {
                scene.warnings.push_back(nodes[std::size_t(placed.node)].pointer +
                                         ": carries a light and is scaled; the light keeps its own size");
                break;
            }
    }
    parts_.channels = std::move(channels);
}

// Puts the origin into a scene that is far from it.
void GltfMotion::comeNear(const Scene& scene) {
    const Pose rest = poseAt(0);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 min(infinity), max(-infinity);
    const auto include = [&](const glm::dvec3& posWorld) {
        min = glm::min(min, posWorld);
        max = glm::max(max, posWorld);
    };
    for (const Placement& placement : placements_) {
        const Node& node = parts_.hierarchy.nodes[std::size_t(placement.node)];
        if (node.skin >= 0) {
            for (const int joint : parts_.hierarchy.skins[std::size_t(node.skin)].joints)
                include(rest.worldFromNode[std::size_t(joint)][3]);
            continue;
        }
        const glm::dmat4 matrix = worldFromMesh(placement, rest);
        for (const glm::vec3& position : scene.meshes[std::size_t(placement.part.mesh)].positions)
            include(matrix * glm::dvec4(position, 1));
    }
    if (!(min.x <= max.x) || !isFar(min, max)) return;
    parts_.worldFromFile =
        glm::translate(glm::dmat4(1), -glm::round(0.5 * (min + max))) * parts_.worldFromFile;
}

GltfMotion::Pose GltfMotion::poseAt(double time_s) const {
    const std::vector<Node>& nodes = parts_.hierarchy.nodes;
    struct Local {
        glm::dvec3 translation;
        glm::dquat rotation;
        glm::dvec3 scale;
    };
    std::vector<Local> locals;
    Pose pose;
    for (const Node& node : nodes) {
        locals.push_back({node.translation, node.rotation, node.scale});
        pose.weights.push_back(node.weights);
    }
    for (const Channel& channel : parts_.channels) {
        Local& local = locals[std::size_t(channel.node)];
        std::vector<float> v = channel.track.at(float(time_s), channel.path == Channel::Path::rotation);
        switch (channel.path) {
            case Channel::Path::translation:
                local.translation = {v[0], v[1], v[2]};
                break;
            case Channel::Path::rotation:
                local.rotation = glm::normalize(glm::dquat(v[3], v[0], v[1], v[2]));
                break;
            case Channel::Path::scale:
                local.scale = {v[0], v[1], v[2]};
                break;
            case Channel::Path::weights:
                pose.weights[std::size_t(channel.node)] = std::move(v);
                break;
        }
    }
    pose.worldFromNode.resize(nodes.size());
    for (const int i : parts_.hierarchy.order) {
        const Node& node = nodes[std::size_t(i)];
        const Local& local = locals[std::size_t(i)];
        glm::dmat4& world = pose.worldFromNode[std::size_t(i)];
        world = node.matrix.value_or(composed(local.translation, local.rotation, local.scale));
        world =
            (node.parent >= 0 ? pose.worldFromNode[std::size_t(node.parent)] : parts_.worldFromFile) * world;
        if (!isFinite(world)) throw PlaceError(node.pointer, "its transform overflows");
    }
    return pose;
}

glm::dmat4 GltfMotion::worldFromMesh(const Placement& placement, const Pose& pose) const {
    const Node& node = parts_.hierarchy.nodes[std::size_t(placement.node)];
    glm::dmat4 matrix = pose.worldFromNode[std::size_t(placement.node)];
    if (node.copies) matrix = matrix * (*node.copies)[placement.copy];
    return glm::translate(matrix, placement.origin);
}

void GltfMotion::deform(const Mesh& mesh, const Placement& placement, const Pose& pose,
                        Instance& instance) const {
    const Node& node = parts_.hierarchy.nodes[std::size_t(placement.node)];
    instance.positions = mesh.positions;
    instance.normals = mesh.normals;

    const std::vector<float>& nodeWeights = pose.weights[std::size_t(placement.node)];
    const std::vector<float>& weights = nodeWeights.empty() ? mesh.morphWeights : nodeWeights;
    for (std::size_t t = 0; t < mesh.morphTargets.size(); ++t) {
        const MorphTarget& target = mesh.morphTargets[t];
        if (weights[t] == 0) continue;
        for (std::size_t i = 0; i < target.positionDeltas.size(); ++i)
            instance.positions[i] += weights[t] * target.positionDeltas[i];
        for (std::size_t i = 0; i < target.normalDeltas.size(); ++i)
            instance.normals[i] += weights[t] * target.normalDeltas[i];
    }
    if (!mesh.morphTargets.empty()) {
        if (placement.part.flatShaded) {
            instance.normals = flatNormals(instance.positions);
        } else {
            for (std::size_t i = 0; i < instance.normals.size(); ++i)
                instance.normals[i] = unitOr(instance.normals[i], mesh.normals[i]);
        }
    }

    if (node.skin >= 0 && !mesh.joints.empty()) {
        const Skin& skin = parts_.hierarchy.skins[std::size_t(node.skin)];
        std::vector<glm::mat4> worldFromBind(skin.joints.size());
        for (std::size_t j = 0; j < skin.joints.size(); ++j)
            worldFromBind[j] = glm::translate(
                pose.worldFromNode[std::size_t(skin.joints[j])] * glm::dmat4(skin.jointFromMesh[j]),
                placement.origin);
        for (std::size_t i = 0; i < instance.positions.size(); ++i) {
            glm::mat4 blend(0);
            for (int k = 0; k < 4; ++k) blend += mesh.jointWeights[i][k] * worldFromBind[mesh.joints[i][k]];
            instance.positions[i] = glm::vec3(blend * glm::vec4(instance.positions[i], 1));
            instance.normals[i] = turnedNormal(glm::mat3(blend), instance.normals[i]);
        }
        // A skin places its mesh by its joints alone, whatever the node's own transform.
        instance.worldFromMesh = glm::mat4(1);
    }
}

Instance GltfMotion::instanceAt(const Scene& scene, const Placement& placement, const Pose& pose) const {
    const Node& node = parts_.hierarchy.nodes[std::size_t(placement.node)];
    const Mesh& mesh = scene.meshes[std::size_t(placement.part.mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    Instance instance{
        .mesh = placement.part.mesh,
        .node = placement.node,
        .worldFromMesh = glm::mat4(worldFromMesh(placement, pose)),
        .casts = node.casts.value_or(material.casts()),
        .receives = node.receives,
        .transmittance = node.casts ? glm::vec3(0) : material.transmittance.value_or(glm::vec3(0))};
    if (mesh.deforms()) deform(mesh, placement, pose, instance);
    return instance;
}

SceneMoment GltfMotion::at(const Scene& scene, double time_s) const try {
    SceneMoment moment{.time_s = time_s};
    Pose pose = poseAt(wrapped_s(time_s, scene.duration_s()));
    for (const Placement& placement : placements_) {
        const Instance& instance = moment.instances.emplace_back(instanceAt(scene, placement, pose));
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Node& node = parts_.hierarchy.nodes[std::size_t(instance.node)];
        const bool isAtRest = !mesh.deforms() && instance.worldFromMesh == placement.restWorldFromMesh;
        const Bounds bounds = isAtRest ? placement.restBounds
                                       : boundsOf(mesh.deforms() ? instance.positions : mesh.positions,
                                                  instance.worldFromMesh, node);
        moment.bounds.include(bounds.min);
        moment.bounds.include(bounds.max);
    }
    moment.worldFromNode.assign(pose.worldFromNode.begin(), pose.worldFromNode.end());
    for (const PlacedLight& light : parts_.lights)
        moment.lights.push_back(lightAt(light, moment.worldFromNode[std::size_t(light.node)]));
    for (const PlacedCamera& placed : parts_.cameras) {
        Camera& camera =
            moment.cameras.emplace_back(cameraAt(placed, moment.worldFromNode[std::size_t(placed.node)]));
        if (camera.orthographicHeight_m)
            *camera.orthographicHeight_m *= largestScale(glm::mat4(parts_.worldFromFile));
    }
    return moment;
} catch (const PlaceError& error) {
    throw InputError(fmt::format("{}: at {} s: {}", parts_.file.string(), time_s, error.what()));
}

}  // namespace penumbra::studio::gltf
