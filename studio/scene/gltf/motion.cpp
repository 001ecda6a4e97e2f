// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/motion.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "studio/errors.h"
#include "studio/scene/gltf/unit_vector.h"

namespace penumbra::studio::gltf {

namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const glm::mat4& m) {
    return isFinite(glm::vec3(m[0])) && isFinite(glm::vec3(m[1])) && isFinite(glm::vec3(m[2])) &&
           isFinite(glm::vec3(m[3]));
}

glm::mat4 composed(const glm::vec3& translation, const glm::quat& rotation, const glm::vec3& scale) {
    const glm::mat3 r = glm::mat3_cast(rotation);
    return {glm::vec4(r[0] * scale.x, 0), glm::vec4(r[1] * scale.y, 0), glm::vec4(r[2] * scale.z, 0),
            glm::vec4(translation, 1)};
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

// Placing and measuring this many takes a few seconds.
constexpr std::uint64_t maxInstancedVertices = 1u << 29;

}  // namespace

GltfMotion::GltfMotion(Parts parts, Budget& budget, Scene& scene) : parts_(std::move(parts)) {
    const std::vector<Node>& nodes = parts_.hierarchy.nodes;
    std::uint64_t instancedVertices = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].inScene || nodes[i].mesh < 0) continue;
        for (const MeshGroup::Part& part : parts_.meshes[std::size_t(nodes[i].mesh)].parts) {
            const Mesh& mesh = scene.meshes[std::size_t(part.mesh)];
            instancedVertices += mesh.positions.size();
            if (instancedVertices > maxInstancedVertices)
                throw PlaceError(nodes[i].pointer,
                                 "with its mesh, more vertices are drawn than can be handled",
                                 "draw fewer copies");
            budget.charge(1, sizeof(Placement) + sizeof(Instance), nodes[i].pointer);
            if (mesh.deforms()) budget.charge(mesh.positions.size(), 2 * sizeof(glm::vec3), nodes[i].pointer);
            placements_.push_back({.node = int(i), .part = part});
        }
    }

    // The rest pose is the one without the clip.
    Clip clip = std::exchange(parts_.clip, {});
    const Pose rest = poseAt(0);
    for (Placement& placement : placements_) {
        const Mesh& mesh = scene.meshes[std::size_t(placement.part.mesh)];
        placement.restWorldFromMesh = rest.worldFromNode[std::size_t(placement.node)];
        if (!mesh.deforms())
            placement.restBounds =
                boundsOf(mesh.positions, placement.restWorldFromMesh, nodes[std::size_t(placement.node)]);
    }
    for (const PlacedLight& placed : parts_.lights) {
        const glm::mat3 m(rest.worldFromNode[std::size_t(placed.node)]);
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(glm::length(m[axis]) - 1) > 1e-3f) {
                scene.warnings.push_back(nodes[std::size_t(placed.node)].pointer +
                                         ": carries a light and is scaled; the light keeps its own size");
                break;
            }
    }
    parts_.clip = std::move(clip);
}

GltfMotion::Pose GltfMotion::poseAt(double time_s) const {
    const std::vector<Node>& nodes = parts_.hierarchy.nodes;
    struct Local {
        glm::vec3 translation;
        glm::quat rotation;
        glm::vec3 scale;
    };
    std::vector<Local> locals;
    Pose pose;
    for (const Node& node : nodes) {
        locals.push_back({node.translation, node.rotation, node.scale});
        pose.weights.push_back(node.weights);
    }
    for (const Channel& channel : parts_.clip.channels) {
        Local& local = locals[std::size_t(channel.node)];
        std::vector<float> v = channel.track.at(float(time_s), channel.path == Channel::Path::rotation);
        switch (channel.path) {
            case Channel::Path::translation:
                local.translation = {v[0], v[1], v[2]};
                break;
            case Channel::Path::rotation:
                local.rotation = glm::normalize(glm::quat(v[3], v[0], v[1], v[2]));
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
        glm::mat4& world = pose.worldFromNode[std::size_t(i)];
        world = node.matrix.value_or(composed(local.translation, local.rotation, local.scale));
        if (node.parent >= 0) world = pose.worldFromNode[std::size_t(node.parent)] * world;
        if (!isFinite(world)) throw PlaceError(node.pointer, "its transform overflows");
    }
    return pose;
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
            worldFromBind[j] = pose.worldFromNode[std::size_t(skin.joints[j])] * skin.jointFromMesh[j];
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
    Instance instance{.mesh = placement.part.mesh,
                      .node = placement.node,
                      .worldFromMesh = pose.worldFromNode[std::size_t(placement.node)],
                      .casts = node.casts,
                      .receives = node.receives};
    if (mesh.deforms()) deform(mesh, placement, pose, instance);
    return instance;
}

SceneMoment GltfMotion::at(const Scene& scene, double time_s) const try {
    SceneMoment moment{.time_s = time_s};
    const double duration_s = parts_.clip.description.duration_s;
    const double wrapped_s =
        duration_s > 0 && std::isfinite(time_s) ? time_s - duration_s * std::floor(time_s / duration_s) : 0;
    Pose pose = poseAt(wrapped_s);
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
    for (const PlacedLight& light : parts_.lights)
        moment.lights.push_back(lightAt(light, pose.worldFromNode[std::size_t(light.node)]));
    for (const PlacedCamera& camera : parts_.cameras)
        moment.cameras.push_back(cameraAt(camera, pose.worldFromNode[std::size_t(camera.node)]));
    moment.worldFromNode = std::move(pose.worldFromNode);
    return moment;
} catch (const PlaceError& error) {
    throw InputError(fmt::format("{}: at {} s: {}", parts_.file.string(), time_s, error.what()));
}

}  // namespace penumbra::studio::gltf
