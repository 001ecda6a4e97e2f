// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/located_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

using Kind = LocatedJson::Kind;

/// Walks the text for nlohmann's parser and counts lines on the way. The parser calls its handler as soon as
/// it has read a token, and for a number it has read one character more. So a newline counts only once the
/// character after it is read: then the count is that of the token.
class LineCounter {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    LineCounter(const char* at, int* line) : at_(at), line_(line) {}
    reference operator*() const { return *at_; }
    LineCounter& operator++() {
        *line_ += afterNewline_;
        afterNewline_ = *at_ == '\n';
        ++at_;
        return *this;
    }
    LineCounter operator++(int) {
        LineCounter before = *this;
        ++*this;
        return before;
    }
    bool operator==(const LineCounter& other) const { return at_ == other.at_; }

  private:
    const char* at_;
    int* line_;
    bool afterNewline_ = false;
};

/// Builds the tree. The functions and their names are those of nlohmann's SAX interface.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    TreeBuilder(const std::string& fileName, const int& line) : fileName_(fileName), line_(line) {}

    LocatedJson& root() { return root_; }

    bool null() override { return add(Kind::null), true; }
    bool boolean(bool value) override { return add(Kind::boolean).boolean = value, true; }
    bool number_integer(number_integer_t value) override { return addNumber(double(value)); }
    bool number_unsigned(number_unsigned_t value) override { return addNumber(double(value)); }
    bool number_float(number_float_t value, const string_t&) override { return addNumber(value); }
    bool string(string_t& value) override { return add(Kind::string).text = std::move(value), true; }
    bool binary(binary_t&) override { return false; }  // does not occur in text
    bool start_object(std::size_t) override { return open(Kind::object); }
    bool start_array(std::size_t) override { return open(Kind::array); }
    bool end_object() override { return open_.pop_back(), true; }
    bool end_array() override { return open_.pop_back(), true; }

    bool key(string_t& name) override {
        auto& members = open_.back()->members;
        if (std::ranges::find(members, name, &LocatedJson::Member::key) != members.end())
            fail(fmt::format("key '{}' is given twice", name));
        members.push_back({std::move(name), line_, {}});
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
        // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error ...": from the
        // second colon.
        const std::string_view what = error.what();
        const auto colon = what.find(": ");
        fail(fmt::format("not JSON: {}", colon == what.npos ? what : what.substr(colon + 2)));
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError(fmt::format("{}:{}: {}", fileName_, line_, problem));
    }

    LocatedJson& add(Kind kind) {
        if (++count_ > maxLocatedJsonValues) fail(fmt::format("more than {} values", maxLocatedJsonValues));
        LocatedJson value;
        value.kind = kind;
        value.line = line_;
        if (open_.empty()) return root_ = std::move(value);
        LocatedJson& parent = *open_.back();
        if (parent.kind == Kind::array) return parent.items.emplace_back(std::move(value));
        return parent.members.back().value = std::move(value);
    }

    bool addNumber(double value) { return add(Kind::number).number = value, true; }

    bool open(Kind kind) {
        if (open_.size() == maxLocatedJsonDepth)
            fail(fmt::format("nested more than {} levels deep", maxLocatedJsonDepth));
        // Stays where it is while it is open: its parent grows only once it is closed.
        open_.push_back(&add(kind));
        return true;
    }

    const std::string& fileName_;
    const int& line_;
    LocatedJson root_;
    std::vector<LocatedJson*> open_;
    std::size_t count_ = 0;
};

}  // namespace

LocatedJson parseLocatedJson(std::string_view json, const std::string& fileName) {
    if (json.size() > maxLocatedJsonBytes)
        throw InputError(fmt::format("{}: larger than {} MiB", fileName, maxLocatedJsonBytes >> 20));
    int line = 1;
    TreeBuilder builder(fileName, line);
    nlohmann::json::sax_parse(LineCounter(json.data(), &line), LineCounter(json.data() + json.size(), &line),
                              &builder);
    return std::move(builder.root());
}

std::string_view nameOf(Kind kind) {
    switch (kind) {
        case Kind::null:
            return "null";
        case Kind::boolean:
            return "boolean";
        case Kind::number:
            return "number";
        case Kind::string:
            return "string";
        case Kind::array:
            return "array";
        case Kind::object:
            return "object";
    }
    return "";
}

}  // namespace penumbra::studio
