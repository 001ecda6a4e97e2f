// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/info_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iostream>
#include <nlohmann/json.hpp>

#include "penumbra/technique.h"
#include "studio/errors.h"
#include "studio/json_text.h"
#include "studio/scene/profiles/profile_file.h"
#include "studio/scene/solid.h"
#include "studio/scene/topology.h"
#include "studio/workbench/settle.h"

namespace penumbra::studio {
namespace {

constexpr double degrees = 180 / 3.14159265358979;

std::string describeShape(const AreaLight& shape) {
    switch (shape.shape) {
        case LightShape::rect:
            return fmt::format("RectLight {:g} x {:g} m{}", shape.width_m, shape.height_m,
                               shape.twoSided ? ", two-sided" : "");
        case LightShape::disk:
            return fmt::format("DiskLight of radius {:g} m{}", shape.radius_m,
                               shape.twoSided ? ", two-sided" : "");
        case LightShape::sphere:
            return fmt::format("SphereLight of radius {:g} m", shape.radius_m);
        case LightShape::cylinder:
            return fmt::format("CylinderLight of length {:g} m and radius {:g} m", shape.length_m,
                               shape.radius_m);
        case LightShape::distant:
            return fmt::format("DistantLight of {:g} degrees", shape.angle_rad * degrees);
    }
    return {};
}

std::string describeEmission(const Emission& emission) {
    const char* const unit = emission.unit == Emission::Unit::nits      ? "nits"
                             : emission.unit == Emission::Unit::candela ? "cd"
                                                                        : "lux";
    return fmt::format("({:g}, {:g}, {:g}) {}", emission.value.r, emission.value.g, emission.value.b, unit);
}

/// In the file's coordinates.
std::string describePlace(const AreaLight& shape, const glm::dmat4& fileFromWorld) {
    const glm::dmat4 fileFromLight =
        fileFromWorld * glm::dmat4(std::bit_cast<glm::mat4>(shape.worldFromLight));
    const glm::dvec3 ahead = glm::normalize(-glm::dvec3(fileFromLight[2])), at(fileFromLight[3]);
    const std::string direction = fmt::format("towards ({:.3g}, {:.3g}, {:.3g})", ahead.x, ahead.y, ahead.z);
    if (shape.shape == LightShape::distant) return direction;
    // Far from the origin places have more digits.
    const int digits = fileFromWorld == glm::dmat4(1) ? 3 : 9;
    const std::string place =
        fmt::format("at ({:.{}g}, {:.{}g}, {:.{}g})", at.x, digits, at.y, digits, at.z, digits);
    if (shape.shape == LightShape::cylinder) {
        const glm::dvec3 along = glm::normalize(glm::dvec3(fileFromLight[0]));
        return fmt::format("{} along ({:.3g}, {:.3g}, {:.3g})", place, along.x, along.y, along.z);
    }
    return shape.shape == LightShape::sphere ? place : place + " " + direction;
}

/// Sums over solids, each by itself.
Topology sum(const Scene& scene) {
    Topology total;
    for (std::size_t first = 0; first < scene.meshes.size();) {
        std::vector<int> surfaces = {int(first)};
        for (++first; first < scene.meshes.size() && scene.meshes[first].solid >= 0 &&
                      scene.meshes[first].solid == scene.meshes[first - 1].solid;
             ++first)
            surfaces.push_back(int(first));
        const Solid solid = joinMeshes(scene, surfaces);
        const Topology t = analyzeTopology(solid.positions, solid.indices);
        total.triangles += t.triangles;
        total.vertices += t.vertices;
        total.boundaryEdges += t.boundaryEdges;
        total.nonManifoldEdges += t.nonManifoldEdges;
        total.flippedEdges += t.flippedEdges;
        total.degenerateTriangles += t.degenerateTriangles;
    }
    return total;
}

/// What both forms say.
struct SceneSummary {
    const Scene& scene;
    SceneMoment moment = scene.at(0);
    std::string name;
    glm::dmat4 fileFromWorld = glm::inverse(scene.worldFromFile);
    std::size_t drawnTriangles = 0;
    Topology topology = sum(scene);
    double maxError = 0;
    Choice choice = {};
};

Choice choiceOf(double maxError) {
    if (const std::optional<Choice> choice = choiceFor(float(maxError))) return *choice;
    double smallest = 1;
    for (const TechniqueInfo& info : techniqueCatalog()) {
        for (const Promise& promise : promisesOf(info.name))
            smallest = std::min(smallest, double(promise.penumbraRmse));
    }
    throw UsageError(
        fmt::format("--error {:g}: the smallest that a technique can promise is {:g}", maxError, smallest));
}

std::string profileOf(const Light& light) {
    return light.profile ? " x " + light.profile->profile->fileName : std::string();
}

std::string whatIsTaken(const Choice& choice) {
    return describe({choice.technique, choice.promise.parameter, choice.promise.value});
}

/// 0.02f is 0.02, and not 0.0199999996.
double decimalOf(double value) {
    return std::stod(fmt::format("{}", float(value)));
}

std::string whyItIs(const SceneSummary& summary) {
    return fmt::format("promises an error of {:g}, at the least cost ({:g} x hard) of what keeps {:g}",
                       summary.choice.promise.penumbraRmse, summary.choice.promise.cost, summary.maxError);
}

void printTable(const SceneSummary& summary) {
    const auto& [scene, moment, name, fileFromWorld, drawnTriangles, topology, maxError, choice] = summary;
    fmt::print("scene       {}\n", name);
    fmt::print("triangles   {} drawn by {} instances; {} stored in {} meshes\n", drawnTriangles,
               moment.instances.size(), topology.triangles, scene.meshes.size());
    fmt::print("vertices    {}\n", topology.vertices);
    if (moment.bounds.empty()) {
        fmt::print("bounds      none\n");
    } else {
        const glm::vec3 &low = moment.bounds.min, &high = moment.bounds.max;
        fmt::print("bounds      ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m\n", low.x, low.y, low.z, high.x,
                   high.y, high.z);
        if (const glm::dvec3 origin = glm::dvec3(fileFromWorld[3]); origin != glm::dvec3(0))
            fmt::print("origin      these are relative to ({:.9g}, {:.9g}, {:.9g}) of the file\n", origin.x,
                       origin.y, origin.z);
    }
    fmt::print(
        "surfaces    {}: {} boundary edges, {} non-manifold edges, {} with disagreeing sides, {} degenerate "
        "triangles\n",
        topology.closed() ? "closed" : "open", topology.boundaryEdges, topology.nonManifoldEdges,
        topology.flippedEdges, topology.degenerateTriangles);
    fmt::print("materials   {} ({} textures)\n", scene.materials.size(), scene.textures.size());
    for (const Light& light : moment.lights) {
        fmt::print("light       {}: {} {}, {}{}{}\n", light.name, describeShape(light.shape),
                   describePlace(light.shape, fileFromWorld), describeEmission(light.emission),
                   profileOf(light), light.castsShadow ? "" : ", casts no shadow");
    }
    for (const Light& light : moment.lights) {
        fmt::print("auto        {}: {}\n", light.name,
                   light.castsShadow ? whatIsTaken(choice) + ": " + whyItIs(summary)
                                     : std::string("nothing: it casts no shadow"));
    }
    for (const Camera& camera : moment.cameras) fmt::print("camera      {}\n", camera.name);
    for (const Animation& animation : scene.animations) {
        fmt::print("animation   {}: {:g} s\n", animation.name, animation.duration_s);
    }
    for (const std::string& warning : scene.warnings) fmt::print("warning     {}\n", warning);
}

nlohmann::ordered_json lightJson(const SceneSummary& summary, const Light& light) {
    nlohmann::ordered_json json = {
        {"light", light.name},
        {"shape", describeShape(light.shape)},
        {"place", describePlace(light.shape, summary.fileFromWorld)},
        {"emission", describeEmission(light.emission) + profileOf(light)},
        {"casts_shadow", light.castsShadow},
        {"auto", nullptr},
    };
    if (!light.castsShadow) return json;
    const auto& [technique, promise] = summary.choice;
    json["auto"] = {{"technique", technique}};
    if (!promise.parameter.empty()) json["auto"][std::string(promise.parameter)] = promise.value;
    for (const Setting& setting : promise.besides)
        json["auto"][std::string(setting.parameter)] = setting.value;
    json["auto"]["asked"] = decimalOf(summary.maxError);
    json["auto"]["promised"] = decimalOf(promise.penumbraRmse);
    json["auto"]["why"] = whyItIs(summary);
    return json;
}

nlohmann::ordered_json toJson(const SceneSummary& summary) {
    const auto& [scene, moment, name, fileFromWorld, drawnTriangles, topology, maxError, choice] = summary;
    nlohmann::ordered_json json = {
        {"scene", name},
        {"triangles", drawnTriangles},
        {"stored_triangles", topology.triangles},
        {"vertices", topology.vertices},
        {"instances", moment.instances.size()},
        {"meshes", scene.meshes.size()},
        {"bounds", nullptr},
        {"origin", {fileFromWorld[3].x, fileFromWorld[3].y, fileFromWorld[3].z}},
        {"surfaces",
         {{"closed", topology.closed()},
          {"boundary_edges", topology.boundaryEdges},
          {"non_manifold_edges", topology.nonManifoldEdges},
          {"flipped_edges", topology.flippedEdges},
          {"degenerate_triangles", topology.degenerateTriangles}}},
        {"materials", scene.materials.size()},
        {"textures", scene.textures.size()},
        {"lights", nlohmann::json::array()},
        {"cameras", nlohmann::json::array()},
        {"animations", nlohmann::json::array()},
        {"warnings", scene.warnings},
    };
    if (const auto& bounds = moment.bounds; !bounds.empty()) {
        json["bounds"] = {{"min", {bounds.min.x, bounds.min.y, bounds.min.z}},
                          {"max", {bounds.max.x, bounds.max.y, bounds.max.z}}};
    }
    for (const Light& light : moment.lights) json["lights"].push_back(lightJson(summary, light));
    for (const Camera& camera : moment.cameras) json["cameras"].push_back(camera.name);
    for (const Animation& animation : scene.animations) {
        json["animations"].push_back({{"animation", animation.name}, {"duration_s", animation.duration_s}});
    }
    return json;
}

}  // namespace

void printScene(const Scene& scene, const std::string& name, double maxError, bool json) {
    SceneSummary summary{.scene = scene,
                         .name = scene.name.empty() ? name : scene.name,
                         .maxError = maxError,
                         .choice = choiceOf(maxError)};
    for (const Instance& instance : summary.moment.instances)
        summary.drawnTriangles += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
    if (json) {
        std::cout << jsonText(toJson(summary));
    } else {
        printTable(summary);
    }
}

}  // namespace penumbra::studio
