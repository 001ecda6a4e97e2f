// SPDX-License-Identifier: Apache-2.0
// Where the parts of a JSON text lie, so that some of it can be changed while the rest stays letter for
// letter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::studio::viewer {

struct JsonMember {
    std::string key;
    std::string_view value;  ///< as it is written, in the text that it was taken from
};

/// Of an object, in its order. The text must be JSON, as whoever parsed it before knows.
std::vector<JsonMember> jsonMembers(std::string_view object);

/// Of an array, in its order, as they are written.
std::vector<std::string_view> jsonElements(std::string_view array);

/// The array with other elements. Where there are as many, all between them stays; else what stands before
/// the first stands before each.
std::string withElements(std::string_view array, const std::vector<std::string>& elements);

}  // namespace penumbra::studio::viewer
