// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "studio/scene/lights/sidecar.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::ordered_json;

/// The shortest decimal that reads back as the same float, where the double next to it would have 17 digits.
Json number(float value) {
    return Json::parse(fmt::format("{}", value));
}

/// The same for a double that is no float.
Json number(double value) {
    return double(float(value)) == value ? number(float(value)) : Json(value);
}

template <int count>
Json list(const glm::vec<count, float>& values) {
    Json json = Json::array();
    for (int i = 0; i < count; ++i) json.push_back(number(values[i]));
    return json;
}

std::string_view typeOf(LightShape shape) {
    switch (shape) {
        case LightShape::rect:
            return "RectLight";
        case LightShape::disk:
            return "DiskLight";
        case LightShape::sphere:
            return "SphereLight";
        case LightShape::distant:
            return "DistantLight";
        case LightShape::cylinder:
            return "CylinderLight";
    }
    return "";
}

/// Luminance as intensity and colour whose largest part is 1, as a person writes it. Where rounding keeps
/// their product from being the same float again, all of it stands in the colour.
void writeEmission(Json& json, const char* key, const glm::vec3& value) {
    const float largest = std::max({value.r, value.g, value.b});
    glm::vec3 color = largest > 0 ? value / largest : glm::vec3(1);
    for (int channel = 0; channel < 3; ++channel) {
        for (const float neighbour :
             {color[channel], std::nextafter(color[channel], 0.0f), std::nextafter(color[channel], 2.0f)}) {
            if (neighbour * largest != value[channel]) continue;
            color[channel] = neighbour;
            break;
        }
    }
    const bool exact = color * largest == value;
    json[key] = exact ? number(largest) : number(1.0f);
    json["color"] = list(exact ? color : value);
}

void writeSize(Json& json, const AreaLight& shape) {
    switch (shape.shape) {
        case LightShape::rect:
            json["width"] = number(shape.width_m);
            json["height"] = number(shape.height_m);
            break;
        case LightShape::disk:
        case LightShape::sphere:
            json["radius"] = number(shape.radius_m);
            break;
        case LightShape::cylinder:
            json["length"] = number(shape.length_m);
            json["radius"] = number(shape.radius_m);
            break;
        case LightShape::distant:
            json["angle"] = number(glm::degrees(shape.angle_rad));
            break;
    }
}

void writeShaping(Json& json, const SidecarProfile& profile) {
    json["shaping:ies:file"] = profile.file;
    if (profile.angleScale != 0) json["shaping:ies:angleScale"] = number(profile.angleScale);
    if (profile.normalize) json["shaping:ies:normalize"] = true;
    if (profile.turn_deg != 0) json["shaping:ies:turn"] = number(profile.turn_deg);
}

Json writeSun(const Light& light) {
    const SunOrigin& sun = *light.sun;
    Json json = {{"name", light.name},
                 {"type", "SunLight"},
                 {"latitude", number(sun.latitude_deg)},
                 {"longitude", number(sun.longitude_deg)},
                 {"time", sun.time}};
    if (sun.setting.north_deg != 0) json["north"] = number(sun.setting.north_deg);
    if (!sun.setting.refraction) json["refraction"] = false;
    if (sun.multiplier != glm::vec3(1)) writeEmission(json, "multiplier", sun.multiplier);
    if (!light.castsShadow) json["shadow:enable"] = false;
    return json;
}

Json write(const SidecarLight& written) {
    if (written.light.sun) return writeSun(written.light);
    const Light& light = written.light;
    const bool isLuminaire = written.profile && written.profile->isLuminaire;
    Json json = {{"name", light.name}, {"type", isLuminaire ? "LuminaireLight" : typeOf(light.shape.shape)}};
    if (isLuminaire) {
        json["file"] = written.profile->file;
        if (written.profile->turn_deg != 0) json["turn"] = number(written.profile->turn_deg);
        writeEmission(json, "multiplier", light.emission.value);
    } else {
        writeSize(json, light.shape);
        writeEmission(json, "intensity", light.emission.value);
        if (written.profile) writeShaping(json, *written.profile);
    }
    if (!written.textureFile.empty()) json["texture:file"] = written.textureFile;
    if (light.shape.twoSided && !isLuminaire) json["twoSided"] = true;
    if (!light.castsShadow) json["shadow:enable"] = false;
    if (light.cone_rad) {
        const auto [inner_rad, outer_rad] = *light.cone_rad;
        json["shaping:cone:angle"] = number(glm::degrees(outer_rad));
        json["shaping:cone:softness"] = number(outer_rad > 0 ? 1 - inner_rad / outer_rad : 0);
    }
    if (!written.node.empty()) json[written.isBelow ? "below" : "node"] = written.node;
    for (int i = 0; i < 3; ++i) json["translation"].push_back(number(written.parentFromLight[3][i]));
    const glm::quat rotation = glm::normalize(glm::quat_cast(glm::mat3(written.parentFromLight)));
    json["rotation"] = list(glm::vec4(rotation.x, rotation.y, rotation.z, rotation.w));
    return json;
}

/// As the value of a key, or nothing where there are none.
std::string write(std::string_view key, const std::vector<SurfaceRule>& rules) {
    if (rules.empty()) return "";
    Json json = Json::object();
    for (const SurfaceRule& rule : rules) {
        Json& written = json[rule.name] = Json::object();
        if (rule.casts) written["casts"] = *rule.casts;
        if (rule.receives) written["receives"] = *rule.receives;
    }
    return fmt::format(",\n  \"{}\": {}", key, json.dump());
}

}  // namespace

std::string formatLight(const SidecarLight& light) {
    return write(light).dump();
}

std::string formatSidecar(const Sidecar& sidecar) {
    // One line a light, as a person would write it: nlohmann's indentation would put every number on its own.
    std::string text = "{\n  \"version\": 1";
    const ModelReading& reading = sidecar.reading;
    if (reading.unit_m) text += fmt::format(",\n  \"unit\": \"{}\"", nameOfUnit(*reading.unit_m));
    if (reading.up) text += fmt::format(",\n  \"up\": \"{}\"", nameOfUpAxis(*reading.up));
    if (reading.glass) text += fmt::format(",\n  \"glass\": \"{}\"", nameOfGlass(*reading.glass));
    if (sidecar.lights) {
        text += ",\n  \"lights\": [";
        for (const SidecarLight& light : *sidecar.lights) {
            text += (&light == sidecar.lights->data() ? "\n    " : ",\n    ") + formatLight(light);
        }
        text += sidecar.lights->empty() ? "]" : "\n  ]";
    }
    text += write("materials", sidecar.surfaces.materials);
    text += write("nodes", sidecar.surfaces.nodes);
    return text + "\n}\n";
}

}  // namespace penumbra::studio
