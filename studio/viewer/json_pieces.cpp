// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/json_pieces.h"

#include <nlohmann/json.hpp>

namespace penumbra::studio::viewer {
namespace {

class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    void skipSpace() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
    /// Takes it where it comes next.
    bool take(char wanted) {
        skipSpace();
        if (at_ == text_.size() || text_[at_] != wanted) return false;
        ++at_;
        return true;
    }
    std::string_view value() {
        skipSpace();
        const std::size_t begin = at_;
        int depth = 0;
        do {
            if (at_ == text_.size()) break;
            const char c = text_[at_];
            if (c == '"')
                skipString();
            else if (c == '{' || c == '[')
                ++depth, ++at_;
            else if (c == '}' || c == ']')
                --depth, ++at_;
            else if (depth == 0)
                at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
            else
                ++at_;
        } while (depth > 0);
        return text_.substr(begin, at_ - begin);
    }

  private:
    void skipString() {
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) at_ += text_[at_] == '\\';
        at_ = std::min(at_ + 1, text_.size());
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

std::vector<JsonMember> jsonMembers(std::string_view object) {
    std::vector<JsonMember> members;
    Scanner scanner(object);
    if (!scanner.take('{') || scanner.take('}')) return members;
    do {
        const std::string_view key = scanner.value();
        scanner.take(':');
        members.push_back({nlohmann::json::parse(key).get<std::string>(), scanner.value()});
    } while (scanner.take(','));
    return members;
}

std::vector<std::string_view> jsonElements(std::string_view array) {
    std::vector<std::string_view> elements;
    Scanner scanner(array);
    if (!scanner.take('[') || scanner.take(']')) return elements;
    do {
        elements.push_back(scanner.value());
    } while (scanner.take(','));
    return elements;
}

std::string withElements(std::string_view array, const std::vector<std::string>& elements) {
    const std::vector<std::string_view> before = jsonElements(array);
    if (elements.empty()) return "[]";
    std::string text;
    if (before.empty()) {
        for (const std::string& element : elements) text += (text.empty() ? "[\n    " : ",\n    ") + element;
        return text + "\n  ]";
    }
    const auto placeOf = [&](std::string_view element) { return std::size_t(element.data() - array.data()); };
    const std::string_view lead = array.substr(1, placeOf(before.front()) - 1);
    const std::string_view tail = array.substr(placeOf(before.back()) + before.back().size());
    text = array.substr(0, placeOf(before.front()));
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (i > 0 && elements.size() == before.size()) {
            const std::size_t end = placeOf(before[i - 1]) + before[i - 1].size();
            text += array.substr(end, placeOf(before[i]) - end);
        } else if (i > 0) {
            text += ",";
            text += lead;
        }
        text += elements[i];
    }
    return text.append(tail);
}

}  // namespace penumbra::studio::viewer
