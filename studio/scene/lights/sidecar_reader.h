// SPDX-License-Identifier: Apache-2.0
// Values of a sidecar's JSON, each checked, with messages that name the line.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "studio/errors.h"
#include "studio/scene/lights/located_json.h"
#include "studio/scene/lights/nearest_name.h"

namespace penumbra::studio {

/// A number's range; an open end is said so in messages.
struct Limits {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double min = -infinity, max = infinity;
};
inline constexpr Limits atLeastZero{0, Limits::infinity};

/// The value of a key; null where there is none.
inline const LocatedJson* member(const LocatedJson& object, std::string_view key) {
    const auto found = std::ranges::find(object.members, key, &LocatedJson::Member::key);
    return found == object.members.end() ? nullptr : &found->value;
}

/// Reads values of one file, and says what is wrong with them.
class SidecarReader {
  public:
    explicit SidecarReader(std::string fileName) : fileName_(std::move(fileName)) {}

    /// "FILE:LINE", with which messages begin.
    std::string place(int line) const { return fmt::format("{}:{}", fileName_, line); }

    [[noreturn]] void fail(int line, const std::string& problem) const {
        throw InputError(fmt::format("{}:{}: {}", fileName_, line, problem));
    }

    void expect(const LocatedJson& value, LocatedJson::Kind kind, std::string_view what) const {
        if (value.kind == kind) return;
        const std::string_view wanted = nameOf(kind);
        const bool vowel = wanted[0] == 'a' || wanted[0] == 'o';
        fail(value.line,
             fmt::format("{} must be {} {}, not {}", what, vowel ? "an" : "a", wanted, nameOf(value.kind)));
    }

    float number(const LocatedJson& value, std::string_view what, const Limits& limits = {}) const {
        expect(value, LocatedJson::Kind::number, what);
        if (!std::isfinite(float(value.number)))
            fail(value.line, fmt::format("{} must be a number of ordinary size, not {}", what, value.number));
        if (value.number < limits.min || value.number > limits.max)
            fail(value.line, fmt::format("{} must be {}, not {}", what, describe(limits), value.number));
        return float(value.number);
    }

    template <int count>
    glm::vec<count, float> vector(const LocatedJson& value, std::string_view what,
                                  const Limits& limits = {}) const {
        expect(value, LocatedJson::Kind::array, what);
        if (value.items.size() != count)
            fail(value.line, fmt::format("{} must have {} numbers, not {}", what, count, value.items.size()));
        glm::vec<count, float> result;
        for (int i = 0; i < count; ++i)
            result[i] = number(value.items[i], fmt::format("{}[{}]", what, i), limits);
        return result;
    }

    /// That of a key; `fallback` where the object has none.
    float number(const LocatedJson& object, std::string_view key, float fallback,
                 const Limits& limits) const {
        const LocatedJson* value = member(object, key);
        return value ? number(*value, fmt::format("'{}'", key), limits) : fallback;
    }

    bool boolean(const LocatedJson& object, std::string_view key, bool fallback) const {
        const LocatedJson* value = member(object, key);
        return value ? boolean(*value, fmt::format("'{}'", key)) : fallback;
    }

    bool boolean(const LocatedJson& value, std::string_view what) const {
        expect(value, LocatedJson::Kind::boolean, what);
        return value.boolean;
    }

    const std::string& text(const LocatedJson& value, std::string_view what) const {
        expect(value, LocatedJson::Kind::string, what);
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
        if (limits.max == Limits::infinity) return fmt::format("at least {}", limits.min);
        return fmt::format("between {} and {}", limits.min, limits.max);
    }

    std::string fileName_;
};

}  // namespace penumbra::studio
