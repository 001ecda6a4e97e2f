// SPDX-License-Identifier: Apache-2.0
// A JSON value that knows its place in the file, so that whatever is wrong with it can be said where it is
// wrong.
#pragma once

#include <cstdint>
#include <exception>
#include <glm/glm.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::studio {

class JsonView;

/// How a document tells where its values stand. Outlives the views of the document.
class JsonPlaces {
  public:
    virtual ~JsonPlaces() = default;
    /// The exception that tells what is wrong at the value.
    virtual std::exception_ptr errorAt(const JsonView& at, const std::string& problem) const = 0;
    /// What sentences about the value begin with, where its place does not say it: "'radius' ".
    virtual std::string subjectOf(const JsonView& at) const = 0;
};

/// A number's range; an open end is said so in messages.
struct Limits {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double min = -infinity, max = infinity;
};
inline constexpr Limits atLeastZero{0, Limits::infinity};

/// Borrows a value of a parsed document. Every accessor throws by JsonPlaces where the value is not what is
/// asked for.
class JsonView {
  public:
    JsonView(const nlohmann::json& value, std::string pointer, const JsonPlaces& places)
        : value_(&value), pointer_(std::move(pointer)), places_(&places) {}

    const nlohmann::json& value() const { return *value_; }
    const std::string& pointer() const { return pointer_; }  ///< RFC 6901
    [[noreturn]] void fail(const std::string& problem) const {
        std::rethrow_exception(places_->errorAt(*this, problem));
    }

    bool isObject() const { return value_->is_object(); }
    void requireObject() const;
    bool has(std::string_view key) const { return find(key).has_value(); }
    std::optional<JsonView> find(std::string_view key) const;
    JsonView at(std::string_view key) const;
    std::vector<std::string> keys() const;
    /// The elements of an array member; none where it is absent.
    std::vector<JsonView> list(std::string_view key) const;

    std::vector<JsonView> elements() const;
    std::int64_t asInteger(std::int64_t min, std::int64_t max) const;
    /// An integer in [0, size): a reference to one of `size` things.
    int asIndex(std::size_t size) const;
    /// Finite, also as a float.
    float asNumber(const Limits& limits = {}) const;
    bool asBoolean() const;
    const std::string& asString() const;
    /// A text that people see: not empty, without control characters.
    const std::string& asName() const;
    /// An array of exactly `count` numbers.
    std::vector<float> asNumbers(std::size_t count, const Limits& limits = {}) const;
    /// The same with all of their digits: places far from the origin need them. Finite, also as floats.
    std::vector<double> asDoubles(std::size_t count) const;

    // Members that may be absent.
    std::optional<int> index(std::string_view key, std::size_t size) const;
    std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                         std::int64_t max) const;
    float number(std::string_view key, float fallback, const Limits& limits = {}) const;
    bool boolean(std::string_view key, bool fallback) const;
    std::string string(std::string_view key, const std::string& fallback = "") const;
    glm::vec2 vec2(std::string_view key, glm::vec2 fallback) const;
    glm::vec3 vec3(std::string_view key, glm::vec3 fallback, const Limits& limits = {}) const;
    glm::dvec3 dvec3(std::string_view key, glm::dvec3 fallback) const;

  private:
    /// A `predicate` of the value: "must be a number".
    [[noreturn]] void failAs(const std::string& predicate) const {
        fail(places_->subjectOf(*this) + predicate);
    }

    const nlohmann::json* value_;
    std::string pointer_;
    const JsonPlaces* places_;
};

/// The largest integer that every JSON reader keeps exactly.
inline constexpr std::int64_t maxJsonInteger = std::int64_t(1) << 53;

}  // namespace penumbra::studio
