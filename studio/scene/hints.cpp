// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

namespace penumbra::studio {
namespace {

/// What the manual's page on buildings recommends.
struct Converter {
    std::string_view endings;  ///< each with its dot, between spaces
    std::string_view program, command;
};

constexpr std::string_view assimp = "assimp (Debian: assimp-utils)",
                           assimpCommand = "assimp export {} OUT.glb -fglb2",
                           occt = "Open CASCADE (Debian: occt-draw libocct-draw-dev)",
                           webIfc = "a script of Penumbra's (npm: web-ifc @gltf-transform/core)",
                           tilesTools = "3d-tiles-tools (npm)";
constexpr std::array<Converter, 10> converters = {{
    {" .ifc ", webIfc, "node examples/buildings/ifc_to_glb.mjs {} OUT.glb"},
    {" .ifczip ", webIfc,
     "unzip -p {} >MODEL.ifc && node examples/buildings/ifc_to_glb.mjs MODEL.ifc OUT.glb"},
    {" .stp .step ", occt,
     "occt-draw -b -c 'pload MODELING XDE OCAF; ReadStep D {}; XGetOneShape s D; incmesh s 0.5; WriteGltf D "
     "OUT.glb'"},
    {" .brep .brp ", occt,
     "occt-draw -b -c 'pload MODELING XDE OCAF; restore {} s; incmesh s 0.5; XNewDoc D; XAddShape D s; "
     "WriteGltf D OUT.glb'"},
    {" .b3dm ", tilesTools, "npx 3d-tiles-tools@0.5.4 b3dmToGlb -i {} -o OUT.glb"},
    {" .i3dm ", tilesTools, "npx 3d-tiles-tools@0.5.4 i3dmToGlb -i {} -o OUT.glb"},
    {" .city.json .cityjson ", "a script of Penumbra's (npm: earcut @gltf-transform/core)",
     "node examples/buildings/cityjson_to_glb.mjs {} OUT.glb"},
    {" .sh3d ", "assimp (Debian: assimp-utils), from what Sweet Home 3D exports of {} as OBJ,",
     "assimp export HOME.obj OUT.glb -fglb2"},
    {" .blend ", "Blender",
     "blender -b {} --python-expr 'import bpy; bpy.ops.export_scene.gltf(filepath=\"OUT.glb\")'"},
    {" .obj .fbx .dae .stl .ply .3ds .x3d .off ", assimp, assimpCommand},
}};

constexpr float largest_m = 200, smallest_m = 0.02f;

/// Area of the surfaces that are level, if this axis points up.
std::array<double, 3> levelAreas(const Scene& scene, const SceneMoment& moment) {
    constexpr double level = 0.99;  // cosine: 8 degrees
    std::array<double, 3> areas{};
    for (const Instance& instance : moment.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        if (!instance.positions.empty()) continue;
        const glm::mat3 turned(instance.worldFromMesh);
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::vec3& a = mesh.positions[mesh.indices[i]];
            const glm::dvec3 area = glm::cross(turned * (mesh.positions[mesh.indices[i + 1]] - a),
                                               turned * (mesh.positions[mesh.indices[i + 2]] - a));
            const double size = glm::length(area);
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(area[axis]) > level * size) areas[std::size_t(axis)] += size;
        }
    }
    return areas;
}

}  // namespace

std::string wayToGltf(const std::filesystem::path& file) {
    std::string name = file.filename().string();
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    for (const Converter& converter : converters)
        for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1))
            if (converter.endings.find(' ' + name.substr(dot) + ' ') != std::string_view::npos)
                return fmt::format("; {} writes one: {}",
                                   fmt::format(fmt::runtime(converter.program), file.filename().string()),
                                   fmt::format(fmt::runtime(converter.command), file.string()));
    return "";
}

std::optional<std::string> unitHint(const SceneMoment& moment) {
    if (moment.bounds.empty()) return std::nullopt;
    const glm::vec3 size = moment.bounds.max - moment.bounds.min;
    const float longest_m = std::max({size.x, size.y, size.z});
    if (longest_m > largest_m)
        return fmt::format("is {:.3g} m large; if it counts in millimetres, --unit mm says so", longest_m);
    if (longest_m > 0 && longest_m < smallest_m)
        return fmt::format("is {:.2g} m large; if it is meant to be larger, scale it where it was made",
                           longest_m);
    return std::nullopt;
}

std::optional<std::string> upHint(const Scene& scene, const SceneMoment& moment) {
    constexpr float thin = 1e-3f;
    const glm::vec3 size = moment.bounds.max - moment.bounds.min;
    // A sheet that stands is a sheet that stands.
    if (moment.bounds.empty() || size.z < thin * glm::length(size)) return std::nullopt;
    constexpr double clearly = 2;
    const std::array<double, 3> areas = levelAreas(scene, moment);
    if (!(areas[2] > clearly * std::max(areas[0], areas[1]))) return std::nullopt;
    return "seems to lie on its side: most of its flat surfaces are level if Z points up, which --up z says";
}

}  // namespace penumbra::studio
