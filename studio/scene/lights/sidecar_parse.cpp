// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "studio/scene/lights/black_body.h"
#include "studio/scene/lights/sidecar.h"
#include "studio/scene/lights/sidecar_place.h"
#include "studio/scene/lights/sidecar_reader.h"
#include "studio/scene/profiles/profile_file.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

using Keys = std::span<const std::string_view>;

constexpr std::array<std::string_view, 7> commonKeys{
    "name", "type", "exposure", "color", "enableColorTemperature", "colorTemperature", "shadow:enable"};
constexpr std::array<std::string_view, 4> placeKeys{"node", "translation", "rotation", "aim"};
constexpr std::array<std::string_view, 1> hangingKeys{"below"};
constexpr std::array<std::string_view, 2> luminanceKeys{"intensity", "normalize"};
constexpr std::array<std::string_view, 6> shapingKeys{"shaping:cone:angle",    "shaping:cone:softness",
                                                      "shaping:ies:file",      "shaping:ies:angleScale",
                                                      "shaping:ies:normalize", "shaping:ies:turn"};
constexpr std::array<std::string_view, 4> rectKeys{"width", "height", "texture:file", "twoSided"};
constexpr std::array<std::string_view, 2> diskKeys{"radius", "twoSided"};
constexpr std::array<std::string_view, 1> sphereKeys{"radius"};
constexpr std::array<std::string_view, 3> distantKeys{"angle", "azimuth", "altitude"};
constexpr std::array<std::string_view, 3> luminaireKeys{"file", "multiplier", "turn"};
constexpr std::array<std::string_view, 6> sunKeys{"latitude", "longitude",  "time",
                                                  "north",    "refraction", "multiplier"};

/// What a light says of itself beyond UsdLux's schemas.
enum class Source { shape, luminaire, sun };

/// A schema, of UsdLux but for the last two: its name, what it is here, and the keys that it has beyond the
/// common ones.
struct LightType {
    std::string_view name;
    Source source;
    LightShape shape;
    std::array<Keys, 5> keys;
};

constexpr std::array<LightType, 6> lightTypes{{
    {"RectLight",
     Source::shape,
     LightShape::rect,
     {placeKeys, luminanceKeys, shapingKeys, hangingKeys, rectKeys}},
    {"DiskLight",
     Source::shape,
     LightShape::disk,
     {placeKeys, luminanceKeys, shapingKeys, hangingKeys, diskKeys}},
    {"SphereLight",
     Source::shape,
     LightShape::sphere,
     {placeKeys, luminanceKeys, shapingKeys, hangingKeys, sphereKeys}},
    {"DistantLight", Source::shape, LightShape::distant, {placeKeys, luminanceKeys, distantKeys}},
    {"LuminaireLight", Source::luminaire, LightShape::rect, {placeKeys, hangingKeys, luminaireKeys}},
    {"SunLight", Source::sun, LightShape::distant, {sunKeys}},
}};

const LightType& readType(const SidecarReader& reader, const LocatedJson& object) {
    const LocatedJson* type = member(object, "type");
    std::vector<std::string_view> names;
    for (const LightType& known : lightTypes) names.push_back(known.name);
    if (!type)
        reader.fail(object.line, fmt::format("a light needs a 'type': one of {}", fmt::join(names, ", ")));
    const std::string& name = reader.text(*type, "'type'");
    const auto found = std::ranges::find(lightTypes, name, &LightType::name);
    if (found == lightTypes.end())
        reader.fail(type->line, fmt::format("unknown type '{}' of light{}", name, didYouMean(name, names)));
    return *found;
}

/// The area by which UsdLux's `normalize` divides; of a distant light it is pi sin^2(angle/2), which turns
/// illuminance into luminance.
float sizeFactor(const AreaLight& shape) {
    switch (shape.shape) {
        case LightShape::rect:
            return shape.width_m * shape.height_m;
        case LightShape::disk:
            return pi * shape.radius_m * shape.radius_m;
        case LightShape::sphere:
            return 4 * pi * shape.radius_m * shape.radius_m;
        case LightShape::distant: {
            const float sine = std::sin(0.5f * shape.angle_rad);
            return pi * sine * sine;
        }
    }
    return 0;
}

/// The colour times 2^exposure and `amount`.
glm::vec3 readStrength(const SidecarReader& reader, const LocatedJson& object, float amount) {
    const LocatedJson* color = member(object, "color");
    glm::vec3 strength = color ? reader.vector<3>(*color, "'color'", atLeastZero) : glm::vec3(1);
    const float temperature_K = reader.number(object, "colorTemperature", 6500, {1000, 25000});
    if (reader.boolean(object, "enableColorTemperature", false)) strength *= blackBodyColor(temperature_K);
    strength *= amount * std::exp2(reader.number(object, "exposure", 0, {-100, 100}));
    return strength;
}

void requireFinite(const SidecarReader& reader, const LocatedJson& object, const glm::vec3& value) {
    for (int channel = 0; channel < 3; ++channel)
        if (!std::isfinite(value[channel]))
            reader.fail(object.line,
                        "the light is too strong: intensity x 2^exposure x color must stay below 3.4e38");
}

/// Luminance from intensity, exposure and colour. A light without size has none: there `intensity` is what an
/// area light shrinking with `normalize` tends to, in candela (a quarter for a sphere, whose area is four
/// times what it shows) or lux; and without `normalize`, which would leave darkness, it is simply candela or
/// lux.
Emission readEmission(const SidecarReader& reader, const LocatedJson& object, const AreaLight& shape) {
    const bool distant = shape.shape == LightShape::distant;
    const float intensity = reader.number(object, "intensity", distant ? 50000.0f : 1.0f, atLeastZero);
    const bool normalized = reader.boolean(object, "normalize", false);

    Emission emission;
    emission.value = readStrength(reader, object, intensity);
    const float area = sizeFactor(shape);
    if (area > 0) {
        if (normalized) emission.value /= area;
    } else {
        emission.unit = distant ? Emission::Unit::lux : Emission::Unit::candela;
        if (normalized && shape.shape == LightShape::sphere) emission.value *= 0.25f;
    }
    requireFinite(reader, object, emission.value);
    return emission;
}

/// UsdLux: from full light at (1 - softness) angle to none at the angle.
std::optional<std::array<float, 2>> readCone(const SidecarReader& reader, const LocatedJson& object) {
    if (!member(object, "shaping:cone:angle") && !member(object, "shaping:cone:softness")) return {};
    const float outer_rad = glm::radians(reader.number(object, "shaping:cone:angle", 90, {0, 180}));
    const float soft = reader.number(object, "shaping:cone:softness", 0, {0, 1});
    return std::array{(1 - soft) * outer_rad, outer_rad};
}

SidecarProfile readProfileFile(const SidecarReader& reader, const LocatedJson& file, std::string_view key) {
    SidecarProfile profile;
    profile.file = reader.text(file, fmt::format("'{}'", key));
    profile.line = file.line;
    if (!isProfileName(profile.file))
        reader.fail(file.line, fmt::format("'{}' must name an LM-63 (.ies) or EULUMDAT (.ldt) file, not '{}'",
                                           key, profile.file));
    return profile;
}

std::optional<SidecarProfile> readShapingProfile(const SidecarReader& reader, const LocatedJson& object) {
    const LocatedJson* file = member(object, "shaping:ies:file");
    // Read even where there is no file, so that what is wrong with them is said.
    const float angleScale = reader.number(object, "shaping:ies:angleScale", 0, {-10, 10});
    const bool normalize = reader.boolean(object, "shaping:ies:normalize", false);
    const float turn_deg = reader.number(object, "shaping:ies:turn", 0, {-360, 360});
    if (!file) return {};
    SidecarProfile profile = readProfileFile(reader, *file, "shaping:ies:file");
    profile.angleScale = angleScale;
    profile.normalize = normalize;
    profile.turn_deg = turn_deg;
    return profile;
}

/// Its shape is known once its file is read.
void readLuminaire(const SidecarReader& reader, const LocatedJson& object, SidecarLight& read) {
    const LocatedJson* file = member(object, "file");
    if (!file) reader.fail(object.line, "a LuminaireLight needs a 'file': LM-63 (.ies) or EULUMDAT (.ldt)");
    read.profile = readProfileFile(reader, *file, "file");
    read.profile->isLuminaire = true;
    read.profile->turn_deg = reader.number(object, "turn", 0, {-360, 360});
    read.light.emission = {Emission::Unit::candela,
                           readStrength(reader, object, reader.number(object, "multiplier", 1, atLeastZero))};
    requireFinite(reader, object, read.light.emission.value);
}

void readSun(const SidecarReader& reader, const LocatedJson& object, SidecarLight& read) {
    for (const std::string_view key : {"latitude", "longitude", "time"})
        if (!member(object, key)) reader.fail(object.line, fmt::format("a SunLight needs a '{}'", key));
    const LocatedJson& time = *member(object, "time");
    SunPlace place;
    place.latitude_deg = reader.number(*member(object, "latitude"), "'latitude'", {-90, 90});
    place.longitude_deg = reader.number(*member(object, "longitude"), "'longitude'", {-180, 180});
    place.utc_days = parseSunTime(reader.text(time, "'time'"), reader.place(time.line));
    const SunSetting setting{.north_deg = reader.number(object, "north", 0, {-360, 360}),
                             .refraction = reader.boolean(object, "refraction", true)};
    const Light sun = sunLight(read.light.name, place, setting, reader.place(time.line));
    read.light.shape = sun.shape;
    read.parentFromLight = std::bit_cast<glm::mat4>(sun.shape.worldFromLight);
    read.isInWorld = true;
    read.light.emission = sun.emission;
    read.light.emission.value *=
        readStrength(reader, object, reader.number(object, "multiplier", 1, atLeastZero));
    requireFinite(reader, object, read.light.emission.value);
}

/// Sizes, UsdLux's where absent; brightness and shaping.
void readShape(const SidecarReader& reader, const LocatedJson& object, SidecarLight& read) {
    AreaLight& shape = read.light.shape;
    if (shape.shape == LightShape::rect) {
        shape.width_m = reader.number(object, "width", 1, atLeastZero);
        shape.height_m = reader.number(object, "height", 1, atLeastZero);
    } else if (shape.shape == LightShape::distant) {
        shape.angle_rad = std::min(glm::radians(reader.number(object, "angle", 0.53f, {0, 180})), pi);
    } else {
        shape.radius_m = reader.number(object, "radius", 0.5f, atLeastZero);
    }
    shape.twoSided = reader.boolean(object, "twoSided", false);
    read.light.emission = readEmission(reader, object, shape);
    read.light.cone_rad = readCone(reader, object);
    read.profile = readShapingProfile(reader, object);
    if (const LocatedJson* value = member(object, "texture:file")) {
        read.textureFile = reader.text(*value, "'texture:file'");
        read.textureLine = value->line;
    }
}

SidecarLight readLight(const SidecarReader& reader, const LocatedJson& object) {
    reader.expect(object, LocatedJson::Kind::object, "a light");
    const LightType& type = readType(reader, object);
    std::vector<std::string_view> known(commonKeys.begin(), commonKeys.end());
    for (const Keys keys : type.keys) known.insert(known.end(), keys.begin(), keys.end());
    reader.checkKeys(object, known, type.name);

    SidecarLight read;
    read.light.shape.shape = type.shape;
    const LocatedJson* name = member(object, "name");
    if (!name) reader.fail(object.line, "a light needs a 'name'");
    read.light.name = reader.text(*name, "'name'");
    read.light.castsShadow = reader.boolean(object, "shadow:enable", true);
    switch (type.source) {
        case Source::shape:
            readShape(reader, object, read);
            break;
        case Source::luminaire:
            readLuminaire(reader, object, read);
            break;
        case Source::sun:
            readSun(reader, object, read);
            break;
    }
    readPlace(reader, object, read);
    return read;
}

SidecarNode readNode(const SidecarReader& reader, const LocatedJson::Member& named) {
    constexpr std::array<std::string_view, 2> keys{"casts", "receives"};
    const std::string where = fmt::format("node '{}'", named.key);
    reader.expect(named.value, LocatedJson::Kind::object, where);
    reader.checkKeys(named.value, keys, where);
    SidecarNode node{named.key, {}, {}, named.line};
    if (const LocatedJson* casts = member(named.value, "casts"))
        node.casts = reader.boolean(*casts, "'casts'");
    if (const LocatedJson* receives = member(named.value, "receives"))
        node.receives = reader.boolean(*receives, "'receives'");
    return node;
}

}  // namespace

Sidecar parseSidecar(std::string_view json, const std::string& fileName) {
    const LocatedJson root = parseLocatedJson(json, fileName);
    const SidecarReader reader(fileName);
    reader.expect(root, LocatedJson::Kind::object, "the file");
    constexpr std::array<std::string_view, 4> keys{"$schema", "version", "lights", "nodes"};
    reader.checkKeys(root, keys, "the file");
    const LocatedJson* version = member(root, "version");
    if (!version) reader.fail(root.line, "the file needs a \"version\": 1");
    if (reader.number(*version, "'version'") != 1)
        reader.fail(version->line,
                    fmt::format("version {} is not known: this reads version 1", version->number));
    if (const LocatedJson* schema = member(root, "$schema")) reader.text(*schema, "'$schema'");

    Sidecar sidecar{fileName, {}, {}};
    if (const LocatedJson* lights = member(root, "lights")) {
        reader.expect(*lights, LocatedJson::Kind::array, "'lights'");
        sidecar.lights.emplace();
        std::set<std::string_view> names;
        for (const LocatedJson& item : lights->items) {
            sidecar.lights->push_back(readLight(reader, item));
            const LocatedJson& name = *member(item, "name");
            if (!names.insert(name.text).second)
                reader.fail(name.line, fmt::format("two lights are named '{}'", name.text));
        }
    }
    if (const LocatedJson* nodes = member(root, "nodes")) {
        reader.expect(*nodes, LocatedJson::Kind::object, "'nodes'");
        for (const auto& named : nodes->members) sidecar.nodes.push_back(readNode(reader, named));
    }
    return sidecar;
}

}  // namespace penumbra::studio
