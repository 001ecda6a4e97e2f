// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/json/lined_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "studio/errors.h"
#include "studio/scene/lights/nearest_name.h"

namespace penumbra::studio {
namespace {

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

/// A key as it was before RFC 6901 escaped it.
std::string unescaped(std::string_view escaped) {
    std::string key;
    for (std::size_t i = 0; i < escaped.size(); ++i)
        key += escaped[i] != '~' ? escaped[i] : escaped[++i] == '1' ? '/' : '~';
    return key;
}

/// The value's name for a reader: 'width', 'color'[2], or the file.
std::string nameOf(const std::string& pointer) {
    const auto isNumber = [](std::string_view text) {
        return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    };
    if (pointer.empty()) return "the file";
    const auto slash = pointer.rfind('/');
    const std::string last = pointer.substr(slash + 1);
    if (slash > 0 && isNumber(last)) return fmt::format("{}[{}]", nameOf(pointer.substr(0, slash)), last);
    return fmt::format("'{}'", unescaped(last));
}

}  // namespace

/// Builds the document. The functions and their names are those of nlohmann's SAX interface.
class LinedJson::Builder : public nlohmann::json_sax<nlohmann::json> {
  public:
    Builder(LinedJson& document, const int& line) : document_(document), line_(line) {}

    bool null() override { return add(nullptr), true; }
    bool boolean(bool value) override { return add(value), true; }
    bool number_integer(number_integer_t value) override { return add(value), true; }
    bool number_unsigned(number_unsigned_t value) override { return add(value), true; }
    bool number_float(number_float_t value, const string_t&) override { return add(value), true; }
    bool string(string_t& value) override { return add(std::move(value)), true; }
    bool binary(binary_t&) override { return false; }  // does not occur in text
    bool start_object(std::size_t) override { return open(nlohmann::json::object()); }
    bool start_array(std::size_t) override { return open(nlohmann::json::array()); }
    bool end_object() override { return open_.pop_back(), true; }

    bool end_array() override {
        // Only now do the elements stay where they are.
        const Open& array = open_.back();
        for (std::size_t i = 0; i < array.elements.size(); ++i)
            document_.standing_[&(*array.value)[i]] = array.elements[i];
        return open_.pop_back(), true;
    }

    bool key(string_t& name) override {
        if (open_.back().value->contains(name)) fail(fmt::format("key '{}' is given twice", name));
        key_ = std::move(name);
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
    struct Open {
        nlohmann::json* value;
        std::vector<Standing> elements;  ///< of an array
    };

    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError(fmt::format("{}:{}: {}", document_.fileName_, line_, problem));
    }

    nlohmann::json& add(nlohmann::json value) {
        if (count_ == int(maxValues)) fail(fmt::format("more than {} values", maxValues));
        const Standing standing{line_, count_++};
        if (!open_.empty() && open_.back().value->is_array()) {
            open_.back().elements.push_back(standing);
            return open_.back().value->emplace_back(std::move(value));
        }
        nlohmann::json& added = open_.empty() ? document_.root_ : (*open_.back().value)[key_];
        added = std::move(value);
        document_.standing_[&added] = standing;
        return added;
    }

    bool open(nlohmann::json empty) {
        if (open_.size() == maxDepth) fail(fmt::format("nested more than {} levels deep", maxDepth));
        // Stays where it is while it is open: its parent grows only once it is closed.
        open_.push_back({&add(std::move(empty)), {}});
        return true;
    }

    LinedJson& document_;
    const int& line_;
    std::vector<Open> open_;
    std::string key_;
    int count_ = 0;
};

LinedJson::LinedJson(std::string_view json, std::string fileName) : fileName_(std::move(fileName)) {
    if (json.size() > maxBytes)
        throw InputError(fmt::format("{}: larger than {} MiB", fileName_, maxBytes >> 20));
    int line = 1;
    Builder builder(*this, line);
    nlohmann::json::sax_parse(LineCounter(json.data(), &line), LineCounter(json.data() + json.size(), &line),
                              &builder);
}

std::string LinedJson::placeOf(const JsonView& at) const {
    return fmt::format("{}:{}", fileName_, lineOf(at));
}

std::vector<std::string> LinedJson::keysInOrder(const JsonView& object) const {
    std::vector<std::string> keys = object.keys();
    std::ranges::sort(keys, {},
                      [&](const std::string& key) { return standing_.at(&object.value().at(key)).order; });
    return keys;
}

void LinedJson::checkKeys(const JsonView& object, std::span<const std::string_view> known,
                          std::string_view where) const {
    object.requireObject();
    for (const std::string& key : keysInOrder(object))
        if (std::ranges::find(known, key) == known.end())
            object.at(key).fail(fmt::format("unknown key '{}' in {}{}", key, where, didYouMean(key, known)));
}

std::exception_ptr LinedJson::errorAt(const JsonView& at, const std::string& problem) const {
    return std::make_exception_ptr(InputError(fmt::format("{}: {}", placeOf(at), problem)));
}

std::string LinedJson::subjectOf(const JsonView& at) const {
    return nameOf(at.pointer()) + ' ';
}

}  // namespace penumbra::studio
