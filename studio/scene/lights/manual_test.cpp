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
    EXPECT_EQ(examples, 5);
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
    } else if (type == "string") {
        good = {"some text"};
        bad = {"", 1, "line\nbreak"};
    } else if (type == "array") {
        bad = {json::array(), {1, 2}, {0, 0, 0, 0, 0}, 1};
    }
}

TEST(LightsSchema, AgreesWithTheParser) {
    const json schema = json::parse(textOf("lights.schema.json"));
    const json& definitions = schema["$defs"];
    std::set<std::string> allKeys;
    for (const std::string type : {"RectLight", "DiskLight", "SphereLight", "DistantLight"})
        for (const auto& [key, property] : definitions[type]["properties"].items()) allKeys.insert(key);

    const auto document = [](const std::string& type, const std::string& key, const json& value) {
        json light{{"name", "a"}, {"type", type}};
        if (key != "type") light[key] = value;
        return json{{"version", 1}, {"lights", {light}}};
    };
    int probed = 0;
    for (const std::string type : {"RectLight", "DiskLight", "SphereLight", "DistantLight"}) {
        json properties = definitions["Light"]["properties"];
        properties.update(definitions[type]["properties"]);
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
    EXPECT_EQ(probed, 4 * 9 + 6 + 4 + 3 + 1);
}

TEST(LightsSchema, StatesTheDefaultsOfTheParser) {
    const json schema = json::parse(textOf("lights.schema.json"));
    for (const std::string type : {"RectLight", "DiskLight", "SphereLight", "DistantLight"}) {
        json bare{{"name", "a"}, {"type", type}}, explicitly = bare;
        json properties = schema["$defs"]["Light"]["properties"];
        properties.update(schema["$defs"][type]["properties"]);
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
