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

#include "studio/errors.h"
#include "studio/scene/json/lined_json.h"
#include "studio/scene/lights/black_body.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/lights/radiant_power.h"
#include "studio/scene/lights/sidecar.h"
#include "studio/scene/lights/sidecar_place.h"
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
constexpr std::array<std::string_view, 6> rectKeys{"width",    "height", "texture:file",
                                                   "twoSided", "watts",  "program"};
constexpr std::array<std::string_view, 4> diskKeys{"radius", "twoSided", "watts", "program"};
constexpr std::array<std::string_view, 3> sphereKeys{"radius", "watts", "program"};
constexpr std::array<std::string_view, 2> cylinderKeys{"length", "radius"};
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

constexpr std::array<LightType, 7> lightTypes{{
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
    {"CylinderLight",
     Source::shape,
     LightShape::cylinder,
     {placeKeys, luminanceKeys, shapingKeys, hangingKeys, cylinderKeys}},
    {"DistantLight", Source::shape, LightShape::distant, {placeKeys, luminanceKeys, distantKeys}},
    {"LuminaireLight", Source::luminaire, LightShape::rect, {placeKeys, hangingKeys, luminaireKeys}},
    {"SunLight", Source::sun, LightShape::distant, {sunKeys}},
}};

const LightType& readType(const JsonView& object) {
    std::vector<std::string_view> names;
    for (const LightType& known : lightTypes) names.push_back(known.name);
    const auto type = object.find("type");
    if (!type) object.fail(fmt::format("a light needs a 'type': one of {}", fmt::join(names, ", ")));
    const std::string name = type->asName();
    const auto found = std::ranges::find(lightTypes, name, &LightType::name);
    if (found == lightTypes.end())
        type->fail(fmt::format("unknown type '{}' of light{}", name, didYouMean(name, names)));
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
        case LightShape::cylinder:
            return 2 * pi * shape.radius_m * shape.length_m;
        case LightShape::distant: {
            const float sine = std::sin(0.5f * shape.angle_rad);
            return pi * sine * sine;
        }
    }
    return 0;
}

/// The colour times 2^exposure and `amount`.
glm::vec3 readStrength(const JsonView& object, float amount) {
    glm::vec3 strength = object.vec3("color", glm::vec3(1), atLeastZero);
    const float temperature_K = object.number("colorTemperature", 6500, {1000, 25000});
    if (object.boolean("enableColorTemperature", false)) strength *= blackBodyColor(temperature_K);
    strength *= amount * std::exp2(object.number("exposure", 0, {-100, 100}));
    return strength;
}

void requireFinite(const JsonView& object, const glm::vec3& value) {
    for (int channel = 0; channel < 3; ++channel)
        if (!std::isfinite(value[channel]))
            object.fail("the light is too strong: intensity x 2^exposure x color must stay below 3.4e38");
}

/// Luminance from intensity, exposure and colour. A light without size has none: there `intensity` is what an
/// area light shrinking with `normalize` tends to, in candela (a quarter for a sphere, whose area is four
/// times what it shows, and 1 / pi for a tube, across it) or lux; and without `normalize`, which would leave
/// darkness, it is simply candela or lux.
Emission readEmission(const JsonView& object, const AreaLight& shape) {
    if (statesWatts(object)) {
        Emission emission = readWatts(object, shape);
        emission.value *= readStrength(object, 1);
        requireFinite(object, emission.value);
        return emission;
    }
    const bool distant = shape.shape == LightShape::distant;
    const float intensity = object.number("intensity", distant ? 50000.0f : 1.0f, atLeastZero);
    const bool normalized = object.boolean("normalize", false);

    Emission emission;
    emission.value = readStrength(object, intensity);
    const float area = sizeFactor(shape);
    if (area > 0) {
        if (normalized) emission.value /= area;
    } else {
        emission.unit = distant ? Emission::Unit::lux : Emission::Unit::candela;
        if (normalized && shape.shape == LightShape::sphere) emission.value *= 0.25f;
        if (normalized && shape.shape == LightShape::cylinder) emission.value /= pi;
    }
    requireFinite(object, emission.value);
    return emission;
}

/// UsdLux: from full light at (1 - softness) angle to none at the angle.
std::optional<std::array<float, 2>> readCone(const JsonView& object) {
    if (!object.has("shaping:cone:angle") && !object.has("shaping:cone:softness")) return {};
    const float outer_rad = glm::radians(object.number("shaping:cone:angle", 90, {0, 180}));
    const float soft = object.number("shaping:cone:softness", 0, {0, 1});
    return std::array{(1 - soft) * outer_rad, outer_rad};
}

SidecarProfile readProfileFile(const LinedJson& document, const JsonView& file, std::string_view key) {
    SidecarProfile profile;
    profile.file = file.asName();
    profile.line = document.lineOf(file);
    if (!isProfileName(profile.file))
        file.fail(fmt::format("'{}' must name an LM-63 (.ies) or EULUMDAT (.ldt) file, not '{}'", key,
                              profile.file));
    return profile;
}

std::optional<SidecarProfile> readShapingProfile(const LinedJson& document, const JsonView& object) {
    const auto file = object.find("shaping:ies:file");
    // Read even where there is no file, so that what is wrong with them is said.
    const float angleScale = object.number("shaping:ies:angleScale", 0, {-10, 10});
    const bool normalize = object.boolean("shaping:ies:normalize", false);
    const float turn_deg = object.number("shaping:ies:turn", 0, {-360, 360});
    if (!file) return {};
    SidecarProfile profile = readProfileFile(document, *file, "shaping:ies:file");
    profile.angleScale = angleScale;
    profile.normalize = normalize;
    profile.turn_deg = turn_deg;
    return profile;
}

/// Its shape is known once its file is read.
void readLuminaire(const LinedJson& document, const JsonView& object, SidecarLight& read) {
    const auto file = object.find("file");
    if (!file) object.fail("a LuminaireLight needs a 'file': LM-63 (.ies) or EULUMDAT (.ldt)");
    read.profile = readProfileFile(document, *file, "file");
    read.profile->isLuminaire = true;
    read.profile->turn_deg = object.number("turn", 0, {-360, 360});
    read.light.emission = {Emission::Unit::candela,
                           readStrength(object, object.number("multiplier", 1, atLeastZero))};
    requireFinite(object, read.light.emission.value);
}

void readSun(const LinedJson& document, const JsonView& object, SidecarLight& read) {
    for (const std::string_view key : {"latitude", "longitude", "time"})
        if (!object.has(key)) object.fail(fmt::format("a SunLight needs a '{}'", key));
    const JsonView time = object.at("time");
    const Light sun =
        sunLight(read.light.name,
                 SunOrigin{.latitude_deg = object.at("latitude").asNumber({-90, 90}),
                           .longitude_deg = object.at("longitude").asNumber({-180, 180}),
                           .time = time.asName(),
                           .setting = {.north_deg = object.number("north", 0, {-360, 360}),
                                       .refraction = object.boolean("refraction", true)},
                           .multiplier = readStrength(object, object.number("multiplier", 1, atLeastZero))},
                 document.placeOf(time));
    read.light.shape = sun.shape;
    read.light.sun = sun.sun;
    read.parentFromLight = std::bit_cast<glm::mat4>(sun.shape.worldFromLight);
    read.isInWorld = true;
    read.light.emission = sun.emission;
    requireFinite(object, read.light.emission.value);
}

/// Sizes, UsdLux's where absent; brightness and shaping.
void readShape(const LinedJson& document, const JsonView& object, SidecarLight& read) {
    AreaLight& shape = read.light.shape;
    if (shape.shape == LightShape::rect) {
        shape.width_m = object.number("width", 1, atLeastZero);
        shape.height_m = object.number("height", 1, atLeastZero);
    } else if (shape.shape == LightShape::distant) {
        shape.angle_rad = std::min(glm::radians(object.number("angle", 0.53f, {0, 180})), pi);
    } else {
        if (shape.shape == LightShape::cylinder) shape.length_m = object.number("length", 1, atLeastZero);
        shape.radius_m = object.number("radius", 0.5f, atLeastZero);
    }
    shape.twoSided = object.boolean("twoSided", false);
    read.light.emission = readEmission(object, shape);
    read.light.cone_rad = readCone(object);
    read.profile = readShapingProfile(document, object);
    if (const auto value = object.find("texture:file")) {
        read.textureFile = value->asName();
        read.textureLine = document.lineOf(*value);
    }
}

SidecarLight readLight(const LinedJson& document, const JsonView& object) {
    const LightType& type = readType(object);
    std::vector<std::string_view> known(commonKeys.begin(), commonKeys.end());
    for (const Keys keys : type.keys) known.insert(known.end(), keys.begin(), keys.end());
    document.checkKeys(object, known, type.name);

    SidecarLight read;
    read.light.shape.shape = type.shape;
    const auto name = object.find("name");
    if (!name) object.fail("a light needs a 'name'");
    read.light.name = name->asName();
    read.light.castsShadow = object.boolean("shadow:enable", true);
    switch (type.source) {
        case Source::shape:
            readShape(document, object, read);
            break;
        case Source::luminaire:
            readLuminaire(document, object, read);
            break;
        case Source::sun:
            readSun(document, object, read);
            break;
    }
    readPlace(document, object, read);
    return read;
}

/// The rules of `nodes` or `materials`, one of which is a `kind`.
std::vector<SurfaceRule> readRules(const LinedJson& document, const JsonView& root, std::string_view key,
                                   std::string_view kind) {
    constexpr std::array<std::string_view, 2> keys{"casts", "receives"};
    std::vector<SurfaceRule> rules;
    const auto named = root.find(key);
    if (!named) return rules;
    for (const std::string& name : document.keysInOrder(*named)) {
        const JsonView object = named->at(name);
        document.checkKeys(object, keys, fmt::format("{} '{}'", kind, name));
        SurfaceRule& rule = rules.emplace_back(SurfaceRule{name, {}, {}, document.lineOf(object)});
        if (const auto casts = object.find("casts")) rule.casts = casts->asBoolean();
        if (const auto receives = object.find("receives")) rule.receives = receives->asBoolean();
    }
    return rules;
}

/// One of `legal`, by name.
template <typename Value>
std::optional<Value> readNamed(const JsonView& root, std::string_view key, NamedValues<Value> legal) {
    const auto stated = root.find(key);
    if (!stated) return {};
    const std::string& name = stated->asName();
    if (const std::optional<Value> value = valueNamed(legal, name)) return value;
    stated->fail(fmt::format("{} '{}' is none of: {}", key, name, fmt::join(namesIn(legal), ", ")));
}

std::vector<SidecarLight> readLights(const LinedJson& document, const JsonView& list) {
    std::vector<SidecarLight> lights;
    std::set<std::string> names;
    for (const JsonView& object : list.elements()) {
        lights.push_back(readLight(document, object));
        if (const std::string& name = lights.back().light.name; !names.insert(name).second)
            object.at("name").fail(fmt::format("two lights are named '{}'", name));
    }
    return lights;
}

}  // namespace

Sidecar parseSidecar(std::string_view json, const std::string& fileName) {
    const LinedJson document(json, fileName);
    const JsonView root = document.root();
    constexpr std::array<std::string_view, 8> keys{"$schema", "version", "unit",  "up",
                                                   "glass",   "lights",  "nodes", "materials"};
    document.checkKeys(root, keys, "the file");
    const auto version = root.find("version");
    if (!version) root.fail("the file needs a \"version\": 1");
    if (const float number = version->asNumber(); number != 1)
        version->fail(fmt::format("version {} is not known: this reads version 1", number));
    if (const auto schema = root.find("$schema")) schema->asName();

    Sidecar sidecar{.fileName = fileName,
                    .reading = {.unit_m = readNamed(root, "unit", lengthUnits_m()),
                                .up = readNamed(root, "up", upAxisNames()),
                                .glass = readNamed(root, "glass", glassNames())}};
    if (const auto lights = root.find("lights")) sidecar.lights = readLights(document, *lights);
    sidecar.surfaces = {readRules(document, root, "materials", "material"),
                        readRules(document, root, "nodes", "node")};
    return sidecar;
}

}  // namespace penumbra::studio
