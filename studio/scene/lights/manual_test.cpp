// SPDX-License-Identifier: Apache-2.0
// The manual and the schema say what the parser does.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "studio/errors.h"
#include "studio/scene/lights/sidecar.h"

namespace penumbra::studio {
namespace {

using nlohmann::json;

std::string textOf(const std::string& name) {
    std::ifstream file(std::filesystem::path(PENUMBRA_DOCS) / name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

bool isAccepted(const json& document) {
    try {
        parseSidecar(document.dump(), "f");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

TEST(LightsManual, ItsExamplesParse) {
    const std::string manual = textOf("lights.md"), open = "```json\n", close = "```";
    int examples = 0;
    for (auto at = manual.find(open); at != manual.npos; at = manual.find(open, at)) {
        const auto first = at + open.size();
        at = manual.find(close, first);
        ASSERT_NE(at, manual.npos);
        EXPECT_NO_THROW(parseSidecar(manual.substr(first, at - first), "lights.md"));
        ++examples;
    }
    EXPECT_EQ(examples, 7);
}

/// The schema's description of a property, references followed.
json resolved(const json& schema, json property) {
    while (property.contains("$ref")) {
        const std::string reference = property["$ref"].get<std::string>().substr(1);
        property.erase("$ref");
        json target = schema.at(json::json_pointer(reference));
        target.update(property);  // what is said at the place itself counts
        property = target;
    }
    return property;
}

const char* const types[] = {"RectLight",    "DiskLight",      "SphereLight", "CylinderLight",
                             "DistantLight", "LuminaireLight", "SunLight"};

/// A type's own properties and those of what it builds on.
json propertiesOf(const json& schema, const std::string& type) {
    const json& definition = schema["$defs"][type];
    json properties = json::object();
    if (definition.contains("$ref"))
        properties = propertiesOf(
            schema, definition["$ref"].get<std::string>().substr(std::string("#/$defs/").size()));
    properties.update(definition["properties"]);
    return properties;
}

/// A light of this type with what it cannot do without. The sun is up at the pole, and at the equator at
/// noon.
json leastOf(const std::string& type) {
    json light{{"name", "a"}, {"type", type}};
    if (type == "LuminaireLight") light["file"] = "lamp.ies";
    if (type == "SunLight") light.update({{"latitude", 90}, {"longitude", 0}, {"time", "2026-03-20T14:46Z"}});
    return light;
}

/// Values that the schema allows, and some that it does not, for a property.
void probe(const json& property, std::vector<json>& good, std::vector<json>& bad) {
    const std::string type = property.value("type", "");
    if (property.contains("default")) good.push_back(property["default"]);
    if (type == "number") {
        if (property["maximum"] < 1e38) good.push_back(property["maximum"]);
        good.push_back(property["minimum"]);
        bad = {"1", true, property["minimum"].get<double>() - 0.1, 1e39};
        if (property["maximum"] < 1e38) bad.push_back(property["maximum"].get<double>() + 0.1);
    } else if (type == "boolean") {
        good = {true, false};
        bad = {1, "true", nullptr};
    } else if (type == "string" && property["description"].get<std::string>().starts_with("ISO")) {
        good = {"2026-06-20T14:00+02:00"};
        bad = {"", 1, "noon", "2026-06-20T12:00", "2026-12-20T12:00Z"};
    } else if (type == "string" && property["description"].get<std::string>().starts_with("What the watts")) {
        good = {"Blender 4.2", "blender 3.6.5"};
        bad = {"", 1, "Blender", "Cinema 4D"};
    } else if (type == "string") {
        good = {property["pattern"].get<std::string>().ends_with(")$") ? "inner/lamp.LDT" : "some text"};
        bad = {"", 1, "line\nbreak"};
        if (good[0] != "some text") bad.push_back("lamp.txt");
    } else if (type == "array") {
        bad = {json::array(), {1, 2}, {0, 0, 0, 0, 0}, 1};
    }
}

TEST(LightsSchema, AgreesWithTheParser) {
    const json schema = json::parse(textOf("lights.schema.json"));
    std::set<std::string> allKeys;
    for (const std::string type : types) {
        const json properties = propertiesOf(schema, type);
        for (const auto& [key, property] : properties.items()) allKeys.insert(key);
    }

    const auto document = [](const std::string& type, const std::string& key, const json& value) {
        json light = leastOf(type);
        // Each means nothing without the other.
        if (key == "watts") light["program"] = "Blender 4.2";
        if (key == "program") light["watts"] = 60;
        if (key != "type") light[key] = value;
        return json{{"version", 1}, {"lights", {light}}};
    };
    int probed = 0;
    for (const std::string type : types) {
        const json properties = propertiesOf(schema, type);
        for (const auto& [key, property] : properties.items()) {
            std::vector<json> good, bad;
            probe(resolved(schema, property), good, bad);
            for (const json& value : good)
                EXPECT_TRUE(isAccepted(document(type, key, value))) << type << " " << key << " " << value;
            for (const json& value : bad)
                EXPECT_FALSE(isAccepted(document(type, key, value))) << type << " " << key << " " << value;
            probed += !good.empty() && !bad.empty();
        }
        for (const std::string& key : allKeys) {
            if (properties.contains(key)) continue;
            EXPECT_FALSE(isAccepted(document(type, key, 1))) << type << " " << key;
        }
    }
    EXPECT_EQ(probed, 126);
}

TEST(LightsSchema, NamesWhatMayBeSaidOfTheScenesFile) {
    const json schema = json::parse(textOf("lights.schema.json"));
    const auto names = [](auto table) {
        json all = json::array();
        for (const auto& [name, value] : table) all.push_back(std::string(name));
        return all;
    };
    EXPECT_EQ(schema["properties"]["unit"]["enum"], names(lengthUnits_m()));
    EXPECT_EQ(schema["properties"]["up"]["enum"], names(upAxisNames()));
    EXPECT_EQ(schema["properties"]["glass"]["enum"], names(glassNames()));
    for (const char* const key : {"unit", "up", "glass"})
        for (const json& name : schema["properties"][key]["enum"])
            EXPECT_TRUE(isAccepted({{"version", 1}, {key, name}})) << key << " " << name;
}

TEST(LightsSchema, StatesTheDefaultsOfTheParser) {
    const json schema = json::parse(textOf("lights.schema.json"));
    for (const std::string type : types) {
        const json bare = leastOf(type), properties = propertiesOf(schema, type);
        json explicitly = bare;
        for (const auto& [key, property] : properties.items()) {
            const json description = resolved(schema, property);
            if (description.contains("default") && !key.starts_with("shaping:"))
                explicitly[key] = description["default"];
        }
        const auto parse = [](const json& light) {
            return parseSidecar(json{{"version", 1}, {"lights", {light}}}.dump(), "f").lights->at(0);
        };
        const SidecarLight a = parse(bare), b = parse(explicitly);
        EXPECT_EQ(a.light.shape.width_m, b.light.shape.width_m);
        EXPECT_EQ(a.light.shape.height_m, b.light.shape.height_m);
        EXPECT_EQ(a.light.shape.length_m, b.light.shape.length_m);
        EXPECT_EQ(a.light.shape.radius_m, b.light.shape.radius_m);
        EXPECT_EQ(a.light.shape.angle_rad, b.light.shape.angle_rad);
        EXPECT_EQ(a.light.shape.twoSided, b.light.shape.twoSided);
        EXPECT_EQ(a.light.castsShadow, b.light.castsShadow);
        EXPECT_EQ(a.light.emission.value, b.light.emission.value);
        EXPECT_EQ(a.parentFromLight, b.parentFromLight);
    }
}

}  // namespace
}  // namespace penumbra::studio
