// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/scene_builder.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "studio/scene/builtin/mesh_kit.h"

namespace penumbra::studio {
namespace {

void morph(const Mesh& mesh, const std::vector<float>& weights, Instance& instance) {
    instance.positions = mesh.positions;
    instance.normals = mesh.normals;
    for (std::size_t target = 0; target < mesh.morphTargets.size(); ++target)
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            instance.positions[i] += weights[target] * mesh.morphTargets[target].positionDeltas[i];
            instance.normals[i] += weights[target] * mesh.morphTargets[target].normalDeltas[i];
        }
    for (glm::vec3& normal : instance.normals) normal = glm::normalize(normal);
}

class Formulas : public Scene::Motion {
  public:
    Formulas(std::vector<SceneBuilder::Part> parts, std::vector<Light> lights, std::vector<Camera> cameras)
        : parts_(std::move(parts)), lights_(std::move(lights)), cameras_(std::move(cameras)) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment;
        moment.time_s = time_s;
        moment.lights = lights_;
        moment.cameras = cameras_;
        const double looped_s = scene.animations.empty() || !std::isfinite(time_s)
                                    ? 0
                                    : time_s - std::floor(time_s / scene.animations[0].duration_s) *
                                                   scene.animations[0].duration_s;
        for (const SceneBuilder::Part& part : parts_) {
            Instance instance;
            instance.mesh = part.mesh;
            instance.node = int(moment.worldFromNode.size());
            instance.worldFromMesh = part.pose(looped_s);
            instance.casts = part.role == Role::both;
            const Mesh& mesh = scene.meshes[part.mesh];
            if (part.morph) morph(mesh, part.morph(looped_s), instance);
            for (const glm::vec3& position : part.morph ? instance.positions : mesh.positions)
                moment.bounds.include(glm::vec3(instance.worldFromMesh * glm::vec4(position, 1)));
            moment.worldFromNode.push_back(instance.worldFromMesh);
            moment.instances.push_back(std::move(instance));
        }
        return moment;
    }

  private:
    std::vector<SceneBuilder::Part> parts_;
    std::vector<Light> lights_;
    std::vector<Camera> cameras_;
};

}  // namespace

Pose at(const glm::vec3& position, float angle_rad, const glm::vec3& axis) {
    const glm::mat4 worldFromMesh =
        glm::rotate(glm::translate(glm::mat4(1), position), angle_rad, glm::normalize(axis));
    return [worldFromMesh](double) { return worldFromMesh; };
}

SceneBuilder::SceneBuilder(std::string name) {
    scene_.name = std::move(name);
}

int SceneBuilder::mesh(std::string name, Mesh mesh, const glm::vec3& color) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(color, 1);
    mesh.name = std::move(name);
    mesh.material = int(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    scene_.meshes.push_back(std::move(mesh));
    return int(scene_.meshes.size()) - 1;
}

void SceneBuilder::place(std::string node, int mesh, Pose pose, Role role, MorphPose morph) {
    scene_.nodeNames.push_back(std::move(node));
    parts_.push_back({mesh, role, std::move(pose), std::move(morph)});
}

void SceneBuilder::ground(float size_m) {
    place("ground", mesh("ground", plane(size_m, size_m), {0.55f, 0.53f, 0.50f}), at(glm::vec3(0)));
}

int SceneBuilder::texture(Picture picture) {
    constexpr int linear = 9729, clampToEdge = 33071;
    scene_.textures.push_back({int(scene_.pictures.size()), linear, linear, clampToEdge, clampToEdge});
    scene_.pictures.push_back(std::move(picture));
    return int(scene_.textures.size()) - 1;
}

void SceneBuilder::loop(std::string name, double duration_s) {
    scene_.animations = {{std::move(name), duration_s}};
}

Scene SceneBuilder::build() && {
    scene_.motion = std::make_shared<Formulas>(std::move(parts_), std::move(lights_), std::move(cameras_));
    return std::move(scene_);
}

}  // namespace penumbra::studio
