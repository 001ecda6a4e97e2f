// SPDX-License-Identifier: Apache-2.0
// JSON that knows the line of each value, so that a file written by hand can be corrected by hand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::studio {

/// A JSON value and where it stands. Only the member that belongs to its kind is set.
struct LocatedJson {
    enum class Kind { null, boolean, number, string, array, object };
    struct Member;

    Kind kind = Kind::null;
    int line = 1;  ///< of the value's first character
    bool boolean = false;
    double number = 0;
    std::string text;
    std::vector<LocatedJson> items;
    std::vector<Member> members;  ///< in the order of the file; no key twice
};

struct LocatedJson::Member {
    std::string key;
    int line = 1;  ///< of the key
    LocatedJson value;
};

/// What parseLocatedJson accepts; more is an error. A file of lights needs a small part of this.
inline constexpr std::size_t maxLocatedJsonBytes = 4u << 20;
inline constexpr std::size_t maxLocatedJsonValues = 20'000;
inline constexpr std::size_t maxLocatedJsonDepth = 64;

/// Parses a whole document. Throws InputError, beginning with "FILE:LINE: ", on bad JSON, on a key that an
/// object has twice and beyond the limits above.
LocatedJson parseLocatedJson(std::string_view json, const std::string& fileName);

/// "string", "object", ... for messages.
std::string_view nameOf(LocatedJson::Kind kind);

}  // namespace penumbra::studio
