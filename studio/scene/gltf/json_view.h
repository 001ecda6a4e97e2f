// SPDX-License-Identifier: Apache-2.0
// A JSON value that knows its place in the file, so that whatever is wrong with it can be said where it is
// wrong.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra::studio::gltf {

/// What is wrong at one place of a file; loadGltf turns it into an InputError that names the file too.
struct PlaceError : std::runtime_error {
    PlaceError(const std::string& place, const std::string& problem,
               const std::string& remedy = "re-export the file, or check it with gltf-validator");
};

/// A file that is named but is not there, or lies where nothing is read from.
struct MissingFile : PlaceError {
    using PlaceError::PlaceError;
};

/// Borrows a value of a parsed document. Every accessor throws PlaceError where the value is not what is
/// asked for.
class JsonView {
  public:
    JsonView(const nlohmann::json& value, std::string pointer)
        : value_(&value), pointer_(std::move(pointer)) {}

    const std::string& pointer() const { return pointer_; }
    [[noreturn]] void fail(const std::string& problem) const { throw PlaceError(pointer_, problem); }

    bool isObject() const { return value_->is_object(); }
    bool has(const std::string& key) const { return find(key).has_value(); }
    std::optional<JsonView> find(const std::string& key) const;
    JsonView at(const std::string& key) const;
    std::vector<std::string> keys() const;
    /// The elements of an array member; none where it is absent.
    std::vector<JsonView> list(const std::string& key) const;
    /// `extensions.NAME`, where present.
    std::optional<JsonView> extension(const std::string& name) const;
    /// `extras.penumbra`, where present. Extras that are not an object are somebody else's.
    std::optional<JsonView> penumbraExtras() const;

    std::vector<JsonView> elements() const;
    std::int64_t asInteger(std::int64_t min, std::int64_t max) const;
    /// An integer in [0, size): a reference to one of `size` things.
    int asIndex(std::size_t size) const;
    /// Finite, also as a float.
    float asNumber() const;
    bool asBoolean() const;
    const std::string& asString() const;
    /// An array of exactly `count` numbers.
    std::vector<float> asNumbers(std::size_t count) const;
    /// The same with all of their digits: places far from the origin need them. Finite, also as floats.
    std::vector<double> asDoubles(std::size_t count) const;

    // Members that may be absent.
    std::optional<int> index(const std::string& key, std::size_t size) const;
    std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t min,
                         std::int64_t max) const;
    float number(const std::string& key, float fallback) const;
    float numberWithin(const std::string& key, float fallback, float min, float max) const;
    bool boolean(const std::string& key, bool fallback) const;
    std::string string(const std::string& key, const std::string& fallback = "") const;
    glm::vec2 vec2(const std::string& key, glm::vec2 fallback) const;
    glm::vec3 vec3(const std::string& key, glm::vec3 fallback) const;
    glm::dvec3 dvec3(const std::string& key, glm::dvec3 fallback) const;

  private:
    const nlohmann::json* value_;
    std::string pointer_;
};

/// The largest integer that every JSON reader keeps exactly.
inline constexpr std::int64_t maxJsonInteger = std::int64_t(1) << 53;

}  // namespace penumbra::studio::gltf
