// SPDX-License-Identifier: Apache-2.0
// KHR_lights_punctual; EXT_lights_area as drafted in KhronosGroup/glTF pull request 2525.
#include "studio/scene/gltf/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
        if (const auto extras = json.penumbraExtras(); extras && extras->has(key))
            return extras->numberWithin(key, 0, 0, max);
    return 0;
}

void loadPoint(const JsonView& json, float radius_m, Light& light) {
    const float intensity_cd = json.numberWithin("intensity", 1, 0, maxNumber);
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
        const JsonView spot = json.at("spot");
        const float inner = spot.numberWithin("innerConeAngle", 0, 0, pi / 2);
        // Writers round pi / 2 up.
        const float outer = spot.numberWithin("outerConeAngle", pi / 4, 0, pi / 2 * 1.0001f);
        if (inner >= outer) spot.fail("innerConeAngle must be smaller than outerConeAngle");
        light.cone_rad = {inner, std::min(outer, pi / 2)};
    } else if (type == "directional") {
        light.shape.shape = LightShape::distant;
        light.shape.angle_rad = glm::radians(extrasNumber(node, json, "angle", 180));
        const float illuminance_lux = json.numberWithin("intensity", 1, 0, maxNumber);
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
Light loadArea(const JsonView& json) {
    Light light{.name = json.string("name")};
    const float size_m = json.numberWithin("size", 1, 0, maxNumber);
    const std::string type = json.at("type").asString();
    if (type == "rect") {
        const auto rect = json.find("rect");
        const float aspect = rect ? rect->numberWithin("aspect", 1, 0, maxNumber) : 1;
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
    light.emission = emission(json, Emission::Unit::nits, json.numberWithin("intensity", 1, 0, maxNumber));
    return light;
}

// Calls place(node index, node JSON, light JSON) for each node of the scene that carries a light of
// `extension`.
template <class Place>
void forEachLight(const JsonView& root, const Hierarchy& hierarchy, const std::string& extension,
                  Place place) {
    const auto atRoot = root.extension(extension);
    const std::vector<JsonView> lights = atRoot ? atRoot->list("lights") : std::vector<JsonView>{};
    const std::vector<JsonView> nodes = root.list("nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto reference = nodes[i].extension(extension);
        if (!reference || !reference->has("light")) continue;
        const int light = reference->at("light").asIndex(lights.size());
        if (hierarchy.nodes[i].inScene) place(int(i), nodes[i], lights[std::size_t(light)]);
    }
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
    std::vector<PlacedLight> areas = std::move(luminaires), punctuals;
    const auto place = [&](std::vector<PlacedLight>& lights, int node, Light light) {
        if (light.name.empty()) light.name = hierarchy.nodes[std::size_t(node)].name;
        lights.push_back({node, std::move(light)});
    };
    forEachLight(root, hierarchy, "EXT_lights_area", [&](int node, const JsonView&, const JsonView& json) {
        place(areas, node, loadArea(json));
    });
    forEachLight(root, hierarchy, "KHR_lights_punctual",
                 [&](int node, const JsonView& nodeJson, const JsonView& json) {
                     place(punctuals, node, loadPunctual(json, nodeJson));
                 });
    if (areas.empty()) return punctuals;
    if (!punctuals.empty())
        scene.warnings.push_back(
            fmt::format("/extensions/KHR_lights_punctual: {} lights are ignored, as the file has "
                        "EXT_lights_area or EXT_lights_ies",
                        punctuals.size()));
    return areas;
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

Light lightAt(const PlacedLight& placed, const glm::mat4& worldFromNode) {
    Light light = placed.light;
    place(light, rigidPart(worldFromNode));
    return light;
}

Camera cameraAt(const PlacedCamera& placed, const glm::mat4& worldFromNode) {
    Camera camera = placed.camera;
    camera.worldFromCamera = rigidPart(worldFromNode);
    return camera;
}

}  // namespace penumbra::studio::gltf
