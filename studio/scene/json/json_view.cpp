// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/json/json_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::studio {

namespace {

// RFC 6901, section 3.
std::string escaped(std::string_view key) {
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

std::string describe(const Limits& limits) {
    if (limits.max == Limits::infinity) return fmt::format("at least {}", limits.min);
    return fmt::format("between {} and {}", limits.min, limits.max);
}

}  // namespace

void JsonView::requireObject() const {
    if (!value_->is_object()) failAs(fmt::format("must be an object, not {}", value_->type_name()));
}

std::optional<JsonView> JsonView::find(std::string_view key) const {
    requireObject();
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return JsonView(*member, pointer_ + '/' + escaped(key), *places_);
}

JsonView JsonView::at(std::string_view key) const {
    const auto member = find(key);
    if (!member) fail(fmt::format("'{}' is missing", key));
    return *member;
}

std::vector<std::string> JsonView::keys() const {
    requireObject();
    std::vector<std::string> names;
    for (const auto& member : value_->items()) names.push_back(member.key());
    return names;
}

std::vector<JsonView> JsonView::list(std::string_view key) const {
    const auto member = find(key);
    return member ? member->elements() : std::vector<JsonView>{};
}

std::vector<JsonView> JsonView::elements() const {
    if (!value_->is_array()) failAs(fmt::format("must be an array, not {}", value_->type_name()));
    std::vector<JsonView> views;
    views.reserve(value_->size());
    for (const nlohmann::json& element : *value_)
        views.emplace_back(element, fmt::format("{}/{}", pointer_, views.size()), *places_);
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
        failAs(fmt::format("must be an integer from {} to {}", min, max));
    return *integer;
}

int JsonView::asIndex(std::size_t size) const {
    if (size == 0) failAs("refers to something of which the file has none");
    return int(asInteger(0, std::int64_t(std::min<std::size_t>(size, std::numeric_limits<int>::max())) - 1));
}

float JsonView::asNumber(const Limits& limits) const {
    if (!value_->is_number()) failAs(fmt::format("must be a number, not {}", value_->type_name()));
    const double number = value_->get<double>();
    if (!(std::abs(number) <= double(std::numeric_limits<float>::max())))
        failAs(fmt::format("must be a number of ordinary size, not {}", number));
    if (number < limits.min || number > limits.max)
        failAs(fmt::format("must be {}, not {}", describe(limits), number));
    return float(number);
}

bool JsonView::asBoolean() const {
    if (!value_->is_boolean()) failAs(fmt::format("must be true or false, not {}", value_->type_name()));
    return value_->get<bool>();
}

const std::string& JsonView::asString() const {
    if (!value_->is_string()) failAs(fmt::format("must be a string, not {}", value_->type_name()));
    return value_->get_ref<const std::string&>();
}

const std::string& JsonView::asName() const {
    const std::string& text = asString();
    if (text.empty()) failAs("must not be empty");
    if (std::ranges::any_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
        failAs("must not contain control characters");
    return text;
}

std::vector<float> JsonView::asNumbers(std::size_t count, const Limits& limits) const {
    const std::vector<JsonView> views = elements();
    if (views.size() != count) failAs(fmt::format("must have {} numbers, not {}", count, views.size()));
    std::vector<float> numbers;
    for (const JsonView& element : views) numbers.push_back(element.asNumber(limits));
    return numbers;
}

std::vector<double> JsonView::asDoubles(std::size_t count) const {
    asNumbers(count);
    return value_->get<std::vector<double>>();
}

std::optional<int> JsonView::index(std::string_view key, std::size_t size) const {
    const auto member = find(key);
    return member ? std::optional(member->asIndex(size)) : std::nullopt;
}

std::int64_t JsonView::integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                               std::int64_t max) const {
    const auto member = find(key);
    return member ? member->asInteger(min, max) : fallback;
}

float JsonView::number(std::string_view key, float fallback, const Limits& limits) const {
    const auto member = find(key);
    return member ? member->asNumber(limits) : fallback;
}

bool JsonView::boolean(std::string_view key, bool fallback) const {
    const auto member = find(key);
    return member ? member->asBoolean() : fallback;
}

std::string JsonView::string(std::string_view key, const std::string& fallback) const {
    const auto member = find(key);
    return member ? member->asString() : fallback;
}

glm::vec2 JsonView::vec2(std::string_view key, glm::vec2 fallback) const {
    const auto member = find(key);
    if (!member) return fallback;
    const std::vector<float> v = member->asNumbers(2);
    return {v[0], v[1]};
}

glm::vec3 JsonView::vec3(std::string_view key, glm::vec3 fallback, const Limits& limits) const {
    const auto member = find(key);
    if (!member) return fallback;
    const std::vector<float> v = member->asNumbers(3, limits);
    return {v[0], v[1], v[2]};
}

glm::dvec3 JsonView::dvec3(std::string_view key, glm::dvec3 fallback) const {
    const auto member = find(key);
    if (!member) return fallback;
    const std::vector<double> v = member->asDoubles(3);
    return {v[0], v[1], v[2]};
}

}  // namespace penumbra::studio
