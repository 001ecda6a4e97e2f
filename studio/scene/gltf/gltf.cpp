// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "studio/errors.h"
#include "studio/scene/gltf/accessor.h"
#include "studio/scene/gltf/document.h"
#include "studio/scene/gltf/extensions.h"
#include "studio/scene/gltf/ies_lights.h"
#include "studio/scene/gltf/motion.h"

namespace penumbra::studio {

namespace {

using namespace gltf;

void nameGlass(Scene& scene, Glass glass) {
    const std::vector<Instance> instances = scene.at(0).instances;
    const auto panes = std::ranges::count_if(instances, [&](const Instance& instance) {
        return scene.materials[std::size_t(scene.meshes[std::size_t(instance.mesh)].material)].isPane();
    });
    if (panes == 0) return;
    const std::string counted = fmt::format("/materials: {} pane{} of glass", panes, panes == 1 ? "" : "s");
    const char* ofOne = panes == 1 ? "s" : "";
    if (glass == Glass::tinted) {
        scene.warnings.push_back(fmt::format(
            "{} (an alpha below 1, or transmission) take{} a share of the light, in exact and the reference; "
            "--glass clear lets all of it through, --glass blocks none",
            counted, ofOne));
    } else {
        scene.warnings.push_back(
            fmt::format("{} (alpha below 0.5, or transmission above 0.5) let{} light through; "
                        "--glass tinted makes them take their share, --glass blocks makes them cast",
                        counted, ofOne));
    }
}

glm::dmat4 worldFromFile(const GltfOptions& options) {
    glm::dmat4 matrix(options.unit_m);
    matrix[3][3] = 1;
    // Z goes to Y, and what was Y away from whom X and Z face.
    if (options.up == UpAxis::z)
        matrix = matrix * glm::dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
    return matrix;
}

Scene load(const std::filesystem::path& file, const GltfOptions& options) {
    Budget budget(options.memoryBudget_bytes);
    const Document document = readDocument(file, budget);
    const JsonView root = document.root();
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    Scene scene;
    checkExtensions(root, scene);
    const Accessors accessors(document, folder, budget);
    const auto uvSources = loadMaterials(root, accessors, folder, options.glass, budget, scene);
    GltfMotion::Parts parts{.file = file, .worldFromFile = worldFromFile(options)};
    parts.meshes = loadMeshes(root, accessors, uvSources, budget, scene);
    parts.hierarchy = loadHierarchy(root, accessors, parts.meshes, options.scene, budget, scene);
    parts.channels =
        loadAnimations(root, accessors, parts.hierarchy, parts.meshes, options.animations, budget, scene);
    parts.lights = loadLights(root, parts.hierarchy,
                              loadIesLights(root, parts.hierarchy, accessors, folder, budget, scene), scene);
    parts.cameras = loadCameras(root, parts.hierarchy);
    if (scene.name.empty()) scene.name = file.stem().string();
    scene.motion = std::make_shared<GltfMotion>(std::move(parts), budget, scene);
    nameGlass(scene, options.glass);
    return scene;
}

}  // namespace

Scene loadGltf(const std::filesystem::path& file, const GltfOptions& options) try {
    Scene scene = load(file, options);
    // What overflows only in motion should be known now rather than at the first frame.
    scene.at(0);
    return scene;
} catch (const InputError&) {
    throw;
} catch (const std::bad_alloc&) {
    throw InputError(
        fmt::format("{}: there is not enough memory to load it; simplify the scene", file.string()));
} catch (const std::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
}

}  // namespace penumbra::studio
