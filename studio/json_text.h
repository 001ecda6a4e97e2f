// SPDX-License-Identifier: Apache-2.0
// JSON as the command hands it out.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace penumbra::studio {

/// The version of the forms in docs/json.schema.json. It becomes another where a key goes or means something
/// else, not where one is added.
inline constexpr int jsonFormat = 1;

/// Ends with a line break. An object says its `format` first. Names may be in any encoding, as files are.
inline std::string jsonText(const nlohmann::ordered_json& json) {
    nlohmann::ordered_json stated = json;
    if (json.is_object()) {
        stated = {{"format", jsonFormat}};
        stated.update(json);
    }
    return stated.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace penumbra::studio
