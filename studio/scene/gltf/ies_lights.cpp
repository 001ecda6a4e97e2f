// SPDX-License-Identifier: Apache-2.0
// EXT_lights_ies (a draft in KhronosGroup/glTF, extensions/2.0/Vendor).
#include "studio/scene/gltf/ies_lights.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "studio/errors.h"
#include "studio/scene/gltf/extensions.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio::gltf {
namespace {

std::shared_ptr<const LightProfile> loadProfile(const JsonView& json, const Accessors& accessors,
                                                const std::filesystem::path& folder, Budget& budget) {
    const auto uri = json.find("uri");
    if (uri.has_value() == json.has("bufferView")) json.fail("must have either a uri or a bufferView");
    const Bytes fetched = uri ? readUri(*uri, folder, budget) : Bytes();
    const std::span<const std::byte> bytes =
        uri ? std::span<const std::byte>(fetched)
            : accessors.view(json.at("bufferView").asIndex(accessors.viewCount())).bytes;
    if (bytes.size() > maxProfile_bytes)
        json.fail(fmt::format("has a profile of more than {} MiB", maxProfile_bytes >> 20));
    const std::string name = uri && !uri->asString().starts_with("data:") ? uri->asString() : json.pointer();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    try {
        return std::make_shared<LightProfile>(
            parseLm63(text, name, [&](const std::string& file, int line) -> std::string {
                throw InputError(fmt::format(
                    "{}:{}: TILT must be NONE or INCLUDE in a scene's file, not '{}'", name, line, file));
            }));
    } catch (const InputError& error) {
        json.fail(error.what());
    }
}

}  // namespace

std::vector<PlacedLight> loadIesLights(const JsonView& root, const Hierarchy& hierarchy,
                                       const Accessors& accessors, const std::filesystem::path& folder,
                                       Budget& budget, Scene& scene) {
    const auto atRoot = extensionOf(root, "EXT_lights_ies");
    const std::vector<JsonView> profiles = atRoot ? atRoot->list("lights") : std::vector<JsonView>{};
    std::map<int, std::shared_ptr<const LightProfile>> loaded;
    std::vector<PlacedLight> lights;
    const std::vector<JsonView> nodes = root.list("nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto json = extensionOf(nodes[i], "EXT_lights_ies");
        if (!json || !json->has("light")) continue;
        const int index = json->at("light").asIndex(profiles.size());
        if (!hierarchy.nodes[i].inScene || !hierarchy.nodes[i].visible) continue;
        auto& profile = loaded[index];
        if (!profile) {
            profile = loadProfile(profiles[std::size_t(index)], accessors, folder, budget);
            scene.warnings.insert(scene.warnings.end(), profile->warnings.begin(), profile->warnings.end());
        }
        const glm::vec3 color = json->vec3("color", glm::vec3(1));
        if (glm::any(glm::lessThan(color, glm::vec3(0)))) json->at("color").fail("must not be negative");
        constexpr float most = std::numeric_limits<float>::max();
        const glm::vec3 emission = color * json->number("multiplier", 1, {0, most});
        if (!(glm::dot(emission, glm::vec3(1)) <= most)) json->fail("is too bright");
        Light light{.name = profiles[std::size_t(index)].string("name")};
        if (light.name.empty()) light.name = hierarchy.nodes[i].name;
        const std::string note = makeLuminaire(profile, 0, emission, light);
        if (!note.empty()) scene.warnings.push_back(fmt::format("{}: {}", json->pointer(), note));
        lights.push_back({int(i), std::move(light)});
    }
    return lights;
}

}  // namespace penumbra::studio::gltf
