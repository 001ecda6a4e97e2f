// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <bit>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "apps/penumbra/info_nodes.h"
#include "apps/penumbra/info_profile.h"
#include "apps/penumbra/info_sun.h"
#include "studio/errors.h"
#include "studio/scene/profiles/profile_file.h"
#include "studio/scene/solid.h"
#include "studio/scene/topology.h"

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

void printInfo(const SceneArguments& arguments) {
    const Scene scene = openScene(arguments.scene, arguments.openOptions());
    const SceneMoment moment = scene.at(0);
    const glm::dmat4 fileFromWorld = glm::inverse(scene.worldFromFile);
    std::size_t drawnTriangles = 0;
    for (const Instance& instance : moment.instances) {
        drawnTriangles += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
    }
    const Topology topology = sum(scene);
    fmt::print("scene       {}\n", scene.name.empty() ? arguments.scene : scene.name);
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
                   light.profile ? fmt::format(" x {}", light.profile->profile->fileName) : std::string(),
                   light.castsShadow ? "" : ", casts no shadow");
    }
    for (const Camera& camera : moment.cameras) fmt::print("camera      {}\n", camera.name);
    for (const Animation& animation : scene.animations) {
        fmt::print("animation   {}: {:g} s\n", animation.name, animation.duration_s);
    }
    for (const std::string& warning : scene.warnings) fmt::print("warning     {}\n", warning);
}

struct InfoArguments {
    SceneArguments scene;
    std::optional<std::string> nodes;  ///< the pattern that their names match; empty: all
    std::vector<std::string> candela;
    bool json = false;
};

void info(const InfoArguments& arguments) {
    if (arguments.scene.scene.empty()) {
        const auto sun = arguments.scene.sun.option();
        if (!sun) throw UsageError("name a scene, a luminaire's file or a place and time (--sun)");
        return printSun(*sun, arguments.json);
    }
    if (isProfileName(arguments.scene.scene)) {
        if (arguments.nodes)
            throw UsageError(fmt::format("--nodes is for scenes, not for '{}'", arguments.scene.scene));
        return printProfile(arguments.scene.scene, arguments.candela, arguments.json);
    }
    if (!arguments.candela.empty() || (arguments.json && !arguments.nodes))
        throw UsageError(fmt::format(
            "--json and --candela are for luminaires (.ies, .ldt), the sun and --nodes, not for '{}'",
            arguments.scene.scene));
    if (!arguments.nodes) return printInfo(arguments.scene);
    const Scene scene = openScene(arguments.scene.scene, arguments.scene.openOptions());
    printNodes(scene, scene.at(0), arguments.nodes->empty() ? "*" : *arguments.nodes, arguments.json);
}

}  // namespace

void addInfo(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info",
                                           "what a scene holds (triangles, bounds, lights, animations, "
                                           "warnings), a luminaire's file, or where the sun stands");
    auto arguments = std::make_shared<InfoArguments>();
    arguments->scene.addSceneTo(*command, false);
    CLI::Option* nodes =
        command
            ->add_option("--nodes", arguments->nodes,
                         "bounds, materials and triangles of each node whose name matches: --nodes=Window*")
            ->expected(0, 1);
    command
        ->add_option("--candela", arguments->candela,
                     "GAMMA,C in degrees: what a luminaire (.ies, .ldt) sends there; may be repeated")
        ->take_all();
    command->add_flag("--json", arguments->json, "of a luminaire, the sun or nodes, as JSON");
    command->callback([arguments, nodes] {
        if (nodes->count() > 0 && !arguments->nodes) arguments->nodes.emplace();
        info(*arguments);
    });
}

}  // namespace penumbra::studio
