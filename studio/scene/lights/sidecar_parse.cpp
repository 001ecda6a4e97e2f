// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <set>
#include <span>

#include "studio/errors.h"
#include "studio/scene/lights/located_json.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/lights/sidecar.h"

namespace penumbra::studio {
namespace {

using Kind = LocatedJson::Kind;

constexpr float pi = std::numbers::pi_v<float>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A number's range; an open end is said so in messages.
struct Limits {
    double min = -infinity, max = infinity;
};
constexpr Limits atLeastZero{0, infinity};

/// Reads values of one file, and says what is wrong with them.
class Reader {
  public:
    explicit Reader(std::string fileName) : fileName_(std::move(fileName)) {}

    [[noreturn]] void fail(int line, const std::string& problem) const {
        throw InputError(fmt::format("{}:{}: {}", fileName_, line, problem));
    }

    void expect(const LocatedJson& value, Kind kind, std::string_view what) const {
        if (value.kind == kind) return;
        const std::string_view wanted = nameOf(kind);
        const bool vowel = wanted[0] == 'a' || wanted[0] == 'o';
        fail(value.line,
             fmt::format("{} must be {} {}, not {}", what, vowel ? "an" : "a", wanted, nameOf(value.kind)));
    }

    float number(const LocatedJson& value, std::string_view what, const Limits& limits = {}) const {
        expect(value, Kind::number, what);
        if (!std::isfinite(float(value.number)))
            fail(value.line, fmt::format("{} must be a number of ordinary size, not {}", what, value.number));
        if (value.number < limits.min || value.number > limits.max)
            fail(value.line, fmt::format("{} must be {}, not {}", what, describe(limits), value.number));
        return float(value.number);
    }

    template <int count>
    glm::vec<count, float> vector(const LocatedJson& value, std::string_view what,
                                  const Limits& limits = {}) const {
        expect(value, Kind::array, what);
        if (value.items.size() != count)
            fail(value.line, fmt::format("{} must have {} numbers, not {}", what, count, value.items.size()));
        glm::vec<count, float> result;
        for (int i = 0; i < count; ++i)
            result[i] = number(value.items[i], fmt::format("{}[{}]", what, i), limits);
        return result;
    }

    bool boolean(const LocatedJson& value, std::string_view what) const {
        expect(value, Kind::boolean, what);
        return value.boolean;
    }

    const std::string& text(const LocatedJson& value, std::string_view what) const {
        expect(value, Kind::string, what);
        if (value.text.empty()) fail(value.line, fmt::format("{} must not be empty", what));
        if (std::ranges::any_of(value.text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
            fail(value.line, fmt::format("{} must not contain control characters", what));
        return value.text;
    }

    /// Turns down keys that are not among `known`.
    void checkKeys(const LocatedJson& object, std::span<const std::string_view> known,
                   std::string_view where) const {
        for (const auto& member : object.members)
            if (std::ranges::find(known, member.key) == known.end())
                fail(member.line, fmt::format("unknown key '{}' in {}{}", member.key, where,
                                              didYouMean(member.key, known)));
    }

  private:
    static std::string describe(const Limits& limits) {
        if (limits.max == infinity) return fmt::format("at least {}", limits.min);
        return fmt::format("between {} and {}", limits.min, limits.max);
    }

    std::string fileName_;
};

const LocatedJson* find(const LocatedJson& object, std::string_view key) {
    const auto member = std::ranges::find(object.members, key, &LocatedJson::Member::key);
    return member == object.members.end() ? nullptr : &member->value;
}

/// A UsdLux schema: its name, what it is here, and the keys that it has beyond the common ones.
struct LightType {
    std::string_view name;
    LightShape shape;
    std::span<const std::string_view> keys;
};

constexpr std::array<std::string_view, 6> rectKeys{
    "width", "height", "texture:file", "twoSided", "shaping:cone:angle", "shaping:cone:softness"};
constexpr std::array<std::string_view, 4> diskKeys{"radius", "twoSided", "shaping:cone:angle",
                                                   "shaping:cone:softness"};
constexpr std::array<std::string_view, 3> sphereKeys{"radius", "shaping:cone:angle", "shaping:cone:softness"};
constexpr std::array<std::string_view, 1> distantKeys{"angle"};
constexpr std::array<LightType, 4> lightTypes{{
    {"RectLight", LightShape::rect, rectKeys},
    {"DiskLight", LightShape::disk, diskKeys},
    {"SphereLight", LightShape::sphere, sphereKeys},
    {"DistantLight", LightShape::distant, distantKeys},
}};

constexpr std::array<std::string_view, 10> commonKeys{"name",     "type",         "intensity", "exposure",
                                                      "color",    "normalize",    "node",      "translation",
                                                      "rotation", "shadow:enable"};

const LightType& readType(const Reader& reader, const LocatedJson& object) {
    const LocatedJson* type = find(object, "type");
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

/// Rotation of the light's frame; a quaternion (x, y, z, w) of length 1, give or take what six digits leave.
glm::mat4 readRotation(const Reader& reader, const LocatedJson& value) {
    const auto xyzw = reader.vector<4>(value, "'rotation'");
    const float length = glm::length(xyzw);
    if (!(std::abs(length - 1) <= 1e-3f))
        reader.fail(
            value.line,
            fmt::format("'rotation' must be a quaternion [x, y, z, w] of length 1, not {:.4g}", length));
    return glm::mat4_cast(glm::normalize(glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z)));
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

/// Luminance from intensity, exposure and colour. A light without size has none: there `intensity` is what an
/// area light shrinking with `normalize` tends to, in candela (a quarter for a sphere, whose area is four
/// times what it shows) or lux; and without `normalize`, which would leave darkness, it is simply candela or
/// lux.
Emission readEmission(const Reader& reader, const LocatedJson& object, const AreaLight& shape) {
    const auto number = [&](std::string_view key, float fallback, const Limits& limits) {
        const LocatedJson* value = find(object, key);
        return value ? reader.number(*value, fmt::format("'{}'", key), limits) : fallback;
    };
    const bool distant = shape.shape == LightShape::distant;
    const float intensity = number("intensity", distant ? 50000.0f : 1.0f, atLeastZero);
    const float exposure = number("exposure", 0, {-100, 100});
    const LocatedJson* color = find(object, "color");
    const LocatedJson* normalize = find(object, "normalize");

    Emission emission;
    emission.value = color ? reader.vector<3>(*color, "'color'", atLeastZero) : glm::vec3(1);
    emission.value *= intensity * std::exp2(exposure);
    const bool normalized = normalize && reader.boolean(*normalize, "'normalize'");
    const float area = sizeFactor(shape);
    if (area > 0) {
        if (normalized) emission.value /= area;
    } else {
        emission.unit = distant ? Emission::Unit::lux : Emission::Unit::candela;
        if (normalized && shape.shape == LightShape::sphere) emission.value *= 0.25f;
    }
    for (int channel = 0; channel < 3; ++channel)
        if (!std::isfinite(emission.value[channel]))
            reader.fail(object.line,
                        "the light is too strong: intensity x 2^exposure x color must stay below 3.4e38");
    return emission;
}

/// UsdLux: from full light at (1 - softness) angle to none at the angle.
std::optional<std::array<float, 2>> readCone(const Reader& reader, const LocatedJson& object) {
    const LocatedJson* angle = find(object, "shaping:cone:angle");
    const LocatedJson* softness = find(object, "shaping:cone:softness");
    if (!angle && !softness) return {};
    const float outer_rad =
        glm::radians(angle ? reader.number(*angle, "'shaping:cone:angle'", {0, 180}) : 90.0f);
    const float soft = softness ? reader.number(*softness, "'shaping:cone:softness'", {0, 1}) : 0.0f;
    return std::array{(1 - soft) * outer_rad, outer_rad};
}

SidecarLight readLight(const Reader& reader, const LocatedJson& object) {
    reader.expect(object, Kind::object, "a light");
    const LightType& type = readType(reader, object);
    std::vector<std::string_view> known(commonKeys.begin(), commonKeys.end());
    known.insert(known.end(), type.keys.begin(), type.keys.end());
    reader.checkKeys(object, known, type.name);

    SidecarLight read;
    AreaLight& shape = read.light.shape;
    shape.shape = type.shape;
    const LocatedJson* name = find(object, "name");
    if (!name) reader.fail(object.line, "a light needs a 'name'");
    read.light.name = reader.text(*name, "'name'");

    // Sizes, UsdLux's where absent.
    const auto size = [&](std::string_view key, float fallback, const Limits& limits) {
        const LocatedJson* value = find(object, key);
        return value ? reader.number(*value, fmt::format("'{}'", key), limits) : fallback;
    };
    if (type.shape == LightShape::rect) {
        shape.width_m = size("width", 1, atLeastZero);
        shape.height_m = size("height", 1, atLeastZero);
    } else if (type.shape == LightShape::distant) {
        shape.angle_rad = std::min(glm::radians(size("angle", 0.53f, {0, 180})), pi);
    } else {
        shape.radius_m = size("radius", 0.5f, atLeastZero);
    }

    read.light.emission = readEmission(reader, object, shape);
    read.light.cone_rad = readCone(reader, object);
    if (const LocatedJson* value = find(object, "twoSided"))
        shape.twoSided = reader.boolean(*value, "'twoSided'");
    if (const LocatedJson* value = find(object, "shadow:enable"))
        read.light.castsShadow = reader.boolean(*value, "'shadow:enable'");
    if (const LocatedJson* value = find(object, "rotation"))
        read.parentFromLight = readRotation(reader, *value);
    if (const LocatedJson* value = find(object, "translation"))
        read.parentFromLight[3] = glm::vec4(reader.vector<3>(*value, "'translation'"), 1);
    if (const LocatedJson* value = find(object, "node")) {
        read.node = reader.text(*value, "'node'");
        read.nodeLine = value->line;
    }
    if (const LocatedJson* value = find(object, "texture:file")) {
        read.textureFile = reader.text(*value, "'texture:file'");
        read.textureLine = value->line;
    }
    return read;
}

SidecarNode readNode(const Reader& reader, const LocatedJson::Member& member) {
    constexpr std::array<std::string_view, 2> keys{"casts", "receives"};
    const std::string where = fmt::format("node '{}'", member.key);
    reader.expect(member.value, Kind::object, where);
    reader.checkKeys(member.value, keys, where);
    SidecarNode node{member.key, {}, {}, member.line};
    if (const LocatedJson* casts = find(member.value, "casts"))
        node.casts = reader.boolean(*casts, "'casts'");
    if (const LocatedJson* receives = find(member.value, "receives"))
        node.receives = reader.boolean(*receives, "'receives'");
    return node;
}

}  // namespace

Sidecar parseSidecar(std::string_view json, const std::string& fileName) {
    const LocatedJson root = parseLocatedJson(json, fileName);
    const Reader reader(fileName);
    reader.expect(root, Kind::object, "the file");
    constexpr std::array<std::string_view, 4> keys{"$schema", "version", "lights", "nodes"};
    reader.checkKeys(root, keys, "the file");
    const LocatedJson* version = find(root, "version");
    if (!version) reader.fail(root.line, "the file needs a \"version\": 1");
    if (reader.number(*version, "'version'") != 1)
        reader.fail(version->line,
                    fmt::format("version {} is not known: this reads version 1", version->number));
    if (const LocatedJson* schema = find(root, "$schema")) reader.text(*schema, "'$schema'");

    Sidecar sidecar{fileName, {}, {}};
    if (const LocatedJson* lights = find(root, "lights")) {
        reader.expect(*lights, Kind::array, "'lights'");
        sidecar.lights.emplace();
        std::set<std::string_view> names;
        for (const LocatedJson& item : lights->items) {
            sidecar.lights->push_back(readLight(reader, item));
            const LocatedJson& name = *find(item, "name");
            if (!names.insert(name.text).second)
                reader.fail(name.line, fmt::format("two lights are named '{}'", name.text));
        }
    }
    if (const LocatedJson* nodes = find(root, "nodes")) {
        reader.expect(*nodes, Kind::object, "'nodes'");
        for (const auto& member : nodes->members) sidecar.nodes.push_back(readNode(reader, member));
    }
    return sidecar;
}

}  // namespace penumbra::studio
