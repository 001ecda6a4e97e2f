// SPDX-License-Identifier: Apache-2.0
#include "tests/support/json_schema.h"

#include <algorithm>

namespace penumbra::studio {
namespace {

using nlohmann::json;

bool isOfType(const json& value, const std::string& type) {
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    return type == value.type_name();
}

class Check {
  public:
    explicit Check(const json& schema) : schema_(schema) {}

    void run(const json& rule, const json& value, const std::string& place) {
        if (rule.contains("$ref"))
            return run(schema_.at(json::json_pointer(rule["$ref"].get<std::string>().substr(1))), value,
                       place);
        if (rule.contains("const") && value != rule["const"]) return complain(place, "is " + value.dump());
        if (rule.contains("enum") && std::ranges::count(rule["enum"], value) == 0)
            return complain(place, "is " + value.dump());
        if (rule.contains("type")) {
            const json types = rule["type"].is_array() ? rule["type"] : json::array({rule["type"]});
            if (std::ranges::none_of(types, [&](const json& type) { return isOfType(value, type); }))
                return complain(place, "is no " + types.dump());
        }
        if (value.is_number()) {
            if (value < rule.value("minimum", value) || value > rule.value("maximum", value))
                complain(place, "is " + value.dump());
        } else if (value.is_array()) {
            if (value.size() < rule.value("minItems", value.size()) ||
                value.size() > rule.value("maxItems", value.size()))
                complain(place, "has " + std::to_string(value.size()) + " values");
            for (std::size_t i = 0; i < value.size(); ++i)
                run(rule.at("items"), value[i], place + "/" + std::to_string(i));
        } else if (value.is_object()) {
            object(rule, value, place);
        }
    }

    std::vector<std::string> complaints;

  private:
    void object(const json& rule, const json& value, const std::string& place) {
        const json known = rule.value("properties", json::object());
        for (const json& key : rule.value("required", json::array()))
            if (!value.contains(key)) complain(place, "is without " + key.dump());
        for (const auto& [key, inner] : value.items()) {
            const json& other = rule.at("additionalProperties");
            if (known.contains(key))
                run(known[key], inner, place + "/" + key);
            else if (other.is_object())
                run(other, inner, place + "/" + key);
            else
                complain(place, "has '" + key + "'");
        }
    }
    void complain(const std::string& place, const std::string& what) {
        complaints.push_back((place.empty() ? "the whole" : place) + " " + what);
    }

    const json& schema_;
};

}  // namespace

std::vector<std::string> complaintsOf(const nlohmann::json& schema, const std::string& name,
                                      const nlohmann::json& value) {
    Check check(schema);
    check.run(schema.at("$defs").at(name), value, "");
    return check.complaints;
}

}  // namespace penumbra::studio
