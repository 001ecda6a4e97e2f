// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace penumbra::studio::gltf {

namespace {

constexpr std::array<std::string_view, 13> supported = {
    "KHR_mesh_quantization",   "KHR_texture_transform",
    "KHR_materials_unlit",     "KHR_lights_punctual",
    "KHR_node_visibility",     "EXT_lights_area",
    "EXT_mesh_gpu_instancing", "KHR_materials_emissive_strength",
    "EXT_texture_webp",        "KHR_draco_mesh_compression",
    "EXT_meshopt_compression", "KHR_materials_transmission",
    "EXT_lights_ies"};

/// Extensions whose name begins so, and what it means that they are left out.
struct LeftOut {
    std::string_view prefix, meaning;
};
constexpr std::string_view looks = "surfaces look plainer, shadows are the same";
constexpr std::string_view pictures =
    "a texture's second picture is used where it has one, else a plain colour";
constexpr std::array<LeftOut, 13> harmless = {{
    {"KHR_materials_variants", "the materials that the file names first are shown, shadows are the same"},
    {"KHR_materials_", looks},
    {"EXT_materials_", looks},
    {"ADOBE_materials_", looks},
    {"KHR_texture_basisu", pictures},
    {"EXT_texture_", pictures},
    {"MSFT_texture_dds", pictures},
    {"EXT_lights_image_based", "its light from all around is missing, which casts hardly any shadow"},
    {"KHR_animation_pointer", "what it moves stands still"},
    {"KHR_xmp", "it says who made the file"},
    {"AGI_articulations", "what it moves stands still"},
    {"MSFT_lod", "the finest model is shown"},
    {"FB_ngon_encoding", "triangles stay triangles"},
}};

/// Extensions that say where shapes are, with the way to a file without them.
struct Refused {
    std::string_view name, remedy;
};
constexpr std::array<Refused, 1> refused = {{
    {"KHR_meshopt_compression",
     "write EXT_meshopt_compression in its place (gltfpack -c), or leave meshes uncompressed "
     "(gltf-transform copy IN.glb OUT.glb)"},
}};

const LeftOut* findHarmless(std::string_view name) {
    const auto found =
        std::ranges::find_if(harmless, [&](const LeftOut& left) { return name.starts_with(left.prefix); });
    return found == harmless.end() ? nullptr : &*found;
}

bool isSupported(const std::string& name) {
    return std::ranges::find(supported, name) != supported.end();
}

}  // namespace

void checkExtensions(const JsonView& root, Scene& scene) {
    std::set<std::string> named;
    for (const JsonView& json : root.list("extensionsRequired")) {
        const std::string& name = json.asString();
        if (isSupported(name)) continue;
        if (!findHarmless(name)) {
            const auto known = std::ranges::find(refused, name, &Refused::name);
            throw PlaceError(
                json.pointer(), fmt::format("the file requires '{}', which is not supported", name),
                known == refused.end() ? "export it without that extension" : std::string(known->remedy));
        }
    }
    for (const char* list : {"extensionsRequired", "extensionsUsed"})
        for (const JsonView& json : root.list(list)) {
            const std::string& name = json.asString();
            if (isSupported(name) || !named.insert(name).second) continue;
            const LeftOut* left = findHarmless(name);
            scene.warnings.push_back(fmt::format(
                "{}: {} is left out: {}", json.pointer(), name,
                left ? left->meaning : "it is not known here, and the file says that it does without"));
        }
}

std::optional<JsonView> extensionOf(const JsonView& object, std::string_view name) {
    const auto extensions = object.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

std::optional<JsonView> penumbraExtrasOf(const JsonView& object) {
    const auto extras = object.find("extras");
    return extras && extras->isObject() ? extras->find("penumbra") : std::nullopt;
}

}  // namespace penumbra::studio::gltf
