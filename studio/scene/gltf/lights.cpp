// SPDX-License-Identifier: Apache-2.0
// KHR_lights_punctual; EXT_lights_area as drafted in KhronosGroup/glTF pull request 2525.
#include "studio/scene/gltf/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "studio/scene/gltf/extensions.h"
#include "studio/scene/gltf/unit_vector.h"
#include "studio/scene/lights/light_units.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio::gltf {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float maxNumber = std::numeric_limits<float>::max();

glm::vec3 loadColor(const JsonView& json) {
    const glm::vec3 color = json.vec3("color", glm::vec3(1));
    if (glm::any(glm::lessThan(color, glm::vec3(0)))) json.at("color").fail("must not be negative");
    return color;
}

Emission emission(const JsonView& json, Emission::Unit unit, float amount) {
    const glm::vec3 value = loadColor(json) * amount;
    if (!(glm::dot(value, glm::vec3(1)) <= maxNumber)) json.fail("is too bright for its size");
    return {unit, value};
}

// The node's own word goes before the light's.
float extrasNumber(const JsonView& node, const JsonView& light, const char* key, float max) {
    for (const JsonView& json : {node, light})
        if (const auto extras = penumbraExtrasOf(json); extras && extras->has(key))
            return extras->number(key, 0, {0, max});
    return 0;
}

void loadPoint(const JsonView& json, float radius_m, Light& light) {
    const float intensity_cd = json.number("intensity", 1, {0, maxNumber});
    light.shape.radius_m = radius_m;
    light.emission = radius_m > 0 ? emission(json, Emission::Unit::nits,
                                             radianceFromIntensity_nits(intensity_cd, radius_m))
                                  : emission(json, Emission::Unit::candela, intensity_cd);
}

Light loadPunctual(const JsonView& json, const JsonView& node) {
    Light light{.name = json.string("name")};
    const std::string type = json.at("type").asString();
    if (type == "point") {
        light.shape.shape = LightShape::sphere;
        loadPoint(json, extrasNumber(node, json, "radius", maxNumber), light);
    } else if (type == "spot") {
        light.shape.shape = LightShape::disk;
        loadPoint(json, extrasNumber(node, json, "radius", maxNumber), light);
        // Writers round pi / 2 up, and write equal angles for a hard edge: three.js by default, Blender for a
        // blend of 0.
        constexpr float rounding = 1.0001f;
        const JsonView spot = json.at("spot");
        const float outer = spot.number("outerConeAngle", pi / 4, {0, pi / 2 * rounding});
        const float inner = spot.number("innerConeAngle", 0, {0, pi / 2 * rounding});
        if (inner > outer * rounding) spot.fail("innerConeAngle is larger than outerConeAngle");
        light.cone_rad = {std::min({inner, outer, pi / 2}), std::min(outer, pi / 2)};
    } else if (type == "directional") {
        light.shape.shape = LightShape::distant;
        light.shape.angle_rad = glm::radians(extrasNumber(node, json, "angle", 180));
        const float illuminance_lux = json.number("intensity", 1, {0, maxNumber});
        light.emission = light.shape.angle_rad > 0
                             ? emission(json, Emission::Unit::nits,
                                        radianceFromIlluminance_nits(illuminance_lux, light.shape.angle_rad))
                             : emission(json, Emission::Unit::lux, illuminance_lux);
    } else {
        json.at("type").fail(fmt::format("'{}' is not point, spot or directional", type));
    }
    return light;
}

// `size` is the height of a rect, `rect.aspect` its width over its height; a disk's `size` is its diameter.
// `intensity` is the surface's luminance.
Light loadArea(const JsonView& json, float defaultIntensity_nits) {
    Light light{.name = json.string("name")};
    const float size_m = json.number("size", 1, {0, maxNumber});
    const std::string type = json.at("type").asString();
    if (type == "rect") {
        const auto rect = json.find("rect");
        const float aspect = rect ? rect->number("aspect", 1, {0, maxNumber}) : 1;
        light.shape.shape = LightShape::rect;
        light.shape.width_m = aspect * size_m;
        light.shape.height_m = size_m;
        if (!(light.shape.width_m <= maxNumber)) json.fail("is too wide");
    } else if (type == "disk") {
        light.shape.shape = LightShape::disk;
        light.shape.radius_m = 0.5f * size_m;
    } else {
        json.at("type").fail(fmt::format("'{}' is not rect or disk", type));
    }
    light.emission =
        emission(json, Emission::Unit::nits, json.number("intensity", defaultIntensity_nits, {0, maxNumber}));
    return light;
}

/// Reads the lights of one extension: load(light JSON, node JSON) makes a light of one node.
template <class Load>
void loadEach(const JsonView& root, const Hierarchy& hierarchy, const std::string& extension, LightSize size,
              Load load, std::vector<PlacedLight>& placed, Scene& scene) {
    const auto atRoot = extensionOf(root, extension);
    const std::vector<JsonView> lights = atRoot ? atRoot->list("lights") : std::vector<JsonView>{};
    const std::vector<JsonView> nodes = root.list("nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto reference = extensionOf(nodes[i], extension);
        if (!reference || !reference->has("light")) continue;
        const JsonView& json = lights[std::size_t(reference->at("light").asIndex(lights.size()))];
        const Node& node = hierarchy.nodes[i];
        if (!node.inScene || !node.visible) continue;
        try {
            Light light = load(json, nodes[i]);
            if (light.name.empty()) light.name = node.name;
            placed.push_back({int(i), std::move(light), size});
        } catch (const PlaceError& error) {
            // Blender writes a lamp of negative power so, and the rest of the file is as good as any.
            scene.warnings.push_back(fmt::format("{}: light '{}' is left out: {}", nodes[i].pointer(),
                                                 json.string("name", node.name), error.what()));
        }
    }
}

// Babylon.js takes the draft's default intensity for 1, and leaves it out where a light's is.
float defaultAreaIntensity_nits(const JsonView& root, Scene& scene) {
    constexpr float ofTheDraft = 1000, ofBabylon = 1;
    const std::string generator = root.at("asset").string("generator");
    if (!generator.starts_with("Babylon.js") || !extensionOf(root, "EXT_lights_area")) return ofTheDraft;
    scene.warnings.push_back(fmt::format(
        "/asset/generator: {} leaves out an intensity of 1 in EXT_lights_area; it is taken for 1 nit",
        generator));
    return ofBabylon;
}

// Linked duplicates share their light's name: their nodes' names tell them apart, or else a number.
void tellApart(std::vector<PlacedLight>& lights, const Hierarchy& hierarchy) {
    std::map<std::string, int> uses;
    for (const PlacedLight& placed : lights) ++uses[placed.light.name];
    std::set<std::string> taken;
    for (const auto& [name, count] : uses)
        if (count == 1) taken.insert(name);
    for (PlacedLight& placed : lights) {
        if (uses[placed.light.name] == 1) continue;
        std::string name = hierarchy.nodes[std::size_t(placed.node)].name;
        if (name == fmt::format("node {}", placed.node)) name = placed.light.name;  // it has none of its own
        for (int number = 2; !taken.insert(name).second; ++number)
            name = fmt::format("{} {}", placed.light.name, number);
        placed.light.name = std::move(name);
    }
}

void nameRanges(const JsonView& root, Scene& scene) {
    const auto atRoot = extensionOf(root, "KHR_lights_punctual");
    if (!atRoot) return;
    const std::vector<JsonView> lights = atRoot->list("lights");
    const auto count =
        std::ranges::count_if(lights, [](const JsonView& light) { return light.has("range"); });
    if (count > 0)
        scene.warnings.push_back(
            fmt::format("{}/lights: {} of them have a range; it is left out, as light goes on for ever",
                        atRoot->pointer(), count));
}

Camera loadCamera(const JsonView& json) {
    Camera camera{.name = json.string("name")};
    const std::string type = json.at("type").asString();
    if (type == "perspective") {
        const JsonView perspective = json.at("perspective");
        camera.yfov_rad = perspective.at("yfov").asNumber();
        if (!(camera.yfov_rad > 0 && camera.yfov_rad < pi))
            perspective.at("yfov").fail("must lie between 0 and pi");
    } else if (type == "orthographic") {
        const JsonView ymag = json.at("orthographic").at("ymag");
        camera.orthographicHeight_m = 2 * std::abs(ymag.asNumber());
        if (!(*camera.orthographicHeight_m > 0 && *camera.orthographicHeight_m <= maxNumber))
            ymag.fail("must not be zero, nor huge");
    } else {
        json.at("type").fail(fmt::format("'{}' is not perspective or orthographic", type));
    }
    return camera;
}

}  // namespace

std::vector<PlacedLight> loadLights(const JsonView& root, const Hierarchy& hierarchy,
                                    std::vector<PlacedLight> luminaires, Scene& scene) {
    std::vector<PlacedLight> lights = std::move(luminaires);
    const float intensity_nits = defaultAreaIntensity_nits(root, scene);
    loadEach(
        root, hierarchy, "EXT_lights_area", LightSize::scalesWithNode,
        [&](const JsonView& json, const JsonView&) { return loadArea(json, intensity_nits); }, lights, scene);
    loadEach(root, hierarchy, "KHR_lights_punctual", LightSize::itsOwn, loadPunctual, lights, scene);
    tellApart(lights, hierarchy);
    nameRanges(root, scene);
    return lights;
}

std::vector<PlacedCamera> loadCameras(const JsonView& root, const Hierarchy& hierarchy) {
    std::vector<Camera> cameras;
    for (const JsonView& json : root.list("cameras")) cameras.push_back(loadCamera(json));
    std::vector<PlacedCamera> placed;
    const std::vector<JsonView> nodes = root.list("nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (const auto index = nodes[i].index("camera", cameras.size());
            index && hierarchy.nodes[i].inScene) {
            Camera& camera = placed.emplace_back(PlacedCamera{int(i), cameras[std::size_t(*index)]}).camera;
            if (camera.name.empty()) camera.name = hierarchy.nodes[i].name;
        }
    return placed;
}

glm::mat4 rigidPart(const glm::mat4& affine) {
    const glm::vec3 z = unitOr(affine[2], {0, 0, 1});
    // Where +Y is lost, any direction across Z will do: the axis least along it.
    const glm::vec3 spare = std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    const glm::vec3 x =
        unitOr(glm::cross(unitOr(affine[1], spare), z), unitOr(glm::cross(spare, z), {1, 0, 0}));
    return {glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), affine[3]};
}

float largestScale(const glm::mat4& affine) {
    return std::max({glm::length(glm::vec3(affine[0])), glm::length(glm::vec3(affine[1])),
                     glm::length(glm::vec3(affine[2]))});
}

Light lightAt(const PlacedLight& placed, const glm::mat4& worldFromNode) {
    Light light = placed.light;
    if (placed.size == LightSize::scalesWithNode) {
        const float scale = largestScale(worldFromNode);
        light.shape.width_m *= scale;
        light.shape.height_m *= scale;
        light.shape.radius_m *= scale;
    }
    place(light, rigidPart(worldFromNode));
    return light;
}

Camera cameraAt(const PlacedCamera& placed, const glm::mat4& worldFromNode) {
    Camera camera = placed.camera;
    camera.worldFromCamera = rigidPart(worldFromNode);
    return camera;
}

}  // namespace penumbra::studio::gltf
