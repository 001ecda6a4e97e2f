// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/json_view.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace penumbra::studio::gltf {

namespace {

// RFC 6901, section 3.
std::string escaped(const std::string& key) {
    std::string text;
    for (const char c : key) {
        if (c == '~')
            text += "~0";
        else if (c == '/')
            text += "~1";
        else
            text += c;
    }
    return text;
}

}  // namespace

PlaceError::PlaceError(const std::string& place, const std::string& problem, const std::string& remedy)
    : std::runtime_error(fmt::format("{}{}{}; {}", place, place.empty() ? "" : ": ", problem, remedy)) {}

std::optional<JsonView> JsonView::find(const std::string& key) const {
    if (!value_->is_object()) fail("must be an object");
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return JsonView(*member, pointer_ + '/' + escaped(key));
}

JsonView JsonView::at(const std::string& key) const {
    const auto member = find(key);
    if (!member) fail(fmt::format("'{}' is missing", key));
    return *member;
}

std::vector<std::string> JsonView::keys() const {
    if (!value_->is_object()) fail("must be an object");
    std::vector<std::string> names;
    for (const auto& member : value_->items()) names.push_back(member.key());
    return names;
}

std::vector<JsonView> JsonView::list(const std::string& key) const {
    const auto member = find(key);
    return member ? member->elements() : std::vector<JsonView>{};
}

std::optional<JsonView> JsonView::extension(const std::string& name) const {
    const auto extensions = find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

std::optional<JsonView> JsonView::penumbraExtras() const {
    const auto extras = find("extras");
    return extras && extras->isObject() ? extras->find("penumbra") : std::nullopt;
}

std::vector<JsonView> JsonView::elements() const {
    if (!value_->is_array()) fail("must be an array");
    std::vector<JsonView> views;
    views.reserve(value_->size());
    for (const nlohmann::json& element : *value_)
        views.emplace_back(element, fmt::format("{}/{}", pointer_, views.size()));
    return views;
}

std::int64_t JsonView::asInteger(std::int64_t min, std::int64_t max) const {
    // Exactly representable, however it is written: 1, 1.0 and 1e0 are the same JSON number.
    std::optional<std::int64_t> integer;
    if (value_->is_number_unsigned()) {
        if (const auto big = value_->get<std::uint64_t>(); big <= std::uint64_t(maxJsonInteger))
            integer = big;
    } else if (value_->is_number_integer()) {
        integer = value_->get<std::int64_t>();
    } else if (value_->is_number_float()) {
        const double real = value_->get<double>();
        if (std::trunc(real) == real && std::abs(real) <= double(maxJsonInteger))
            integer = std::int64_t(real);
    }
    if (!integer || *integer < min || *integer > max)
        fail(fmt::format("must be an integer from {} to {}", min, max));
    return *integer;
}

int JsonView::asIndex(std::size_t size) const {
    if (size == 0) fail("refers to something of which the file has none");
    return int(asInteger(0, std::int64_t(std::min<std::size_t>(size, std::numeric_limits<int>::max())) - 1));
}

float JsonView::asNumber() const {
    if (!value_->is_number()) fail("must be a number");
    const double number = value_->get<double>();
    if (!(std::abs(number) <= double(std::numeric_limits<float>::max()))) fail("is too large a number");
    return float(number);
}

bool JsonView::asBoolean() const {
    if (!value_->is_boolean()) fail("must be true or false");
    return value_->get<bool>();
}

const std::string& JsonView::asString() const {
    if (!value_->is_string()) fail("must be a string");
    return value_->get_ref<const std::string&>();
}

std::vector<float> JsonView::asNumbers(std::size_t count) const {
    if (!value_->is_array() || value_->size() != count)
        fail(fmt::format("must be an array of {} numbers", count));
    std::vector<float> numbers;
    for (const JsonView& element : elements()) numbers.push_back(element.asNumber());
    return numbers;
}

std::vector<double> JsonView::asDoubles(std::size_t count) const {
    asNumbers(count);
    return value_->get<std::vector<double>>();
}

std::optional<int> JsonView::index(const std::string& key, std::size_t size) const {
    const auto member = find(key);
    return member ? std::optional(member->asIndex(size)) : std::nullopt;
}

std::int64_t JsonView::integer(const std::string& key, std::int64_t fallback, std::int64_t min,
                               std::int64_t max) const {
    const auto member = find(key);
    return member ? member->asInteger(min, max) : fallback;
}

float JsonView::number(const std::string& key, float fallback) const {
    const auto member = find(key);
    return member ? member->asNumber() : fallback;
}

float JsonView::numberWithin(const std::string& key, float fallback, float min, float max) const {
    const auto member = find(key);
    if (!member) return fallback;
    const float number = member->asNumber();
    if (number < min || number > max)
        member->fail(fmt::format("is {}, but must lie in [{}, {}]", number, min, max));
    return number;
}

bool JsonView::boolean(const std::string& key, bool fallback) const {
    const auto member = find(key);
    return member ? member->asBoolean() : fallback;
}

std::string JsonView::string(const std::string& key, const std::string& fallback) const {
    const auto member = find(key);
    return member ? member->asString() : fallback;
}

glm::vec2 JsonView::vec2(const std::string& key, glm::vec2 fallback) const {
    const auto member = find(key);
    if (!member) return fallback;
    const std::vector<float> v = member->asNumbers(2);
    return {v[0], v[1]};
}

glm::vec3 JsonView::vec3(const std::string& key, glm::vec3 fallback) const {
    const auto member = find(key);
    if (!member) return fallback;
    const std::vector<float> v = member->asNumbers(3);
    return {v[0], v[1], v[2]};
}

glm::dvec3 JsonView::dvec3(const std::string& key, glm::dvec3 fallback) const {
    const auto member = find(key);
    if (!member) return fallback;
    const std::vector<double> v = member->asDoubles(3);
    return {v[0], v[1], v[2]};
}

}  // namespace penumbra::studio::gltf
