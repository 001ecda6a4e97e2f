// SPDX-License-Identifier: Apache-2.0
// As much of JSON Schema as docs/json.schema.json is written in.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace penumbra::studio {

/// What of `value` is not as definition `name` of `schema` says, each with its place; nothing where all is.
std::vector<std::string> complaintsOf(const nlohmann::json& schema, const std::string& name,
                                      const nlohmann::json& value);

}  // namespace penumbra::studio
