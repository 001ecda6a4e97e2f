// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "studio/errors.h"
#include "studio/scene/gltf/accessor.h"
#include "studio/scene/gltf/document.h"
#include "studio/scene/gltf/ies_lights.h"
#include "studio/scene/gltf/motion.h"

namespace penumbra::studio {

namespace {

using namespace gltf;

Scene load(const std::filesystem::path& file, const GltfOptions& options) {
    Budget budget(options.memoryBudget_bytes);
    const Document document = readDocument(file, budget);
    const JsonView root = document.root();
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const Accessors accessors(document, folder, budget);

    Scene scene;
    for (const JsonView& used : root.list("extensionsUsed"))
        if (!isSupportedExtension(used.asString()))
            scene.warnings.push_back(
                fmt::format("{}: {} is not supported; ignored", used.pointer(), used.asString()));

    const auto uvSources = loadMaterials(root, accessors, folder, budget, scene);
    GltfMotion::Parts parts{.file = file};
    parts.meshes = loadMeshes(root, accessors, uvSources, budget, scene);
    parts.hierarchy = loadHierarchy(root, accessors, parts.meshes, options.scene, budget, scene);
    parts.clip =
        loadAnimations(root, accessors, parts.hierarchy, parts.meshes, options.animation, budget, scene);
    parts.lights = loadLights(root, parts.hierarchy,
                              loadIesLights(root, parts.hierarchy, accessors, folder, budget, scene), scene);
    parts.cameras = loadCameras(root, parts.hierarchy);
    if (scene.name.empty()) scene.name = file.stem().string();
    scene.motion = std::make_shared<GltfMotion>(std::move(parts), budget, scene);
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
