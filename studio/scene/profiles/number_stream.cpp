// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/number_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr std::string_view blanks = " \t\v\f\r\n";

/// Text of a file in a message: short, and nothing that a terminal would obey.
std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 24;
    std::string result = "'";
    for (const char c : text.substr(0, longest)) result += c >= 0x20 && c < 0x7f ? c : '?';
    return result + (text.size() > longest ? "...'" : "'");
}

}  // namespace

std::vector<std::string_view> linesOf(std::string_view text) {
    constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end);
        if (text.starts_with("\r\n"))
            text.remove_prefix(2);
        else if (!text.empty())
            text.remove_prefix(1);
    }
    return lines;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

void failAt(const std::string& fileName, int line, const std::string& problem) {
    throw InputError(fmt::format("{}:{}: {}", fileName, line, problem));
}

std::optional<double> parseNumber(std::string_view text, bool decimalComma) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) return {};
    }
    std::string pointed(text.substr(0, 64));  // no number needs more
    if (pointed.size() < text.size()) return {};
    if (decimalComma) std::ranges::replace(pointed, ',', '.');
    double value = 0;
    const char* const end = pointed.data() + pointed.size();
    const auto parsed = std::from_chars(pointed.data(), end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return {};
    return value;
}

NumberStream::NumberStream(const std::string& fileName, const std::vector<std::string_view>& lines,
                           std::size_t first, Separators separators)
    : fileName_(fileName),
      lines_(lines),
      separators_(separators == Separators::blanks ? blanks : std::string_view(" \t\v\f\r\n,")),
      decimalComma_(separators == Separators::blanks),
      at_(first),
      rest_(first < lines.size() ? lines[first] : std::string_view()),
      line_(int(std::min(first + 1, lines.size()))) {}

std::string_view NumberStream::token() {
    for (;;) {
        const std::size_t begin = rest_.find_first_not_of(separators_);
        if (begin != rest_.npos) {
            rest_.remove_prefix(begin);
            const std::string_view found = rest_.substr(0, rest_.find_first_of(separators_));
            rest_.remove_prefix(found.size());
            line_ = int(at_ + 1);
            return found;
        }
        if (at_ + 1 >= lines_.size()) return {};
        rest_ = lines_[++at_];
    }
}

template <class What>
double NumberStream::number(What what) {
    const std::string_view text = token();
    if (text.empty()) failAt(fileName_, int(lines_.size()), fmt::format("the file ends before {}", what()));
    const auto value = parseNumber(text, decimalComma_);
    if (!value) fail(fmt::format("{} must be a number, not {}", what(), quoted(text)));
    return *value;
}

double NumberStream::next(std::string_view what) {
    return number([&] { return what; });
}

int NumberStream::nextCount(std::string_view what, int least, int most) {
    const double value = next(what);
    if (value != std::floor(value) || value < least || value > most)
        fail(fmt::format("{} must be a whole number from {} to {}, not {:g}", what, least, most, value));
    return int(value);
}

std::vector<double> NumberStream::nextList(std::string_view what, std::size_t count) {
    std::vector<double> values;
    while (values.size() < count) {
        const auto which = [&] { return fmt::format("{} {} of {}", what, values.size() + 1, count); };
        values.push_back(number(which));
    }
    return values;
}

void NumberStream::requireNoMoreNumbers() {
    const std::string_view text = token();
    if (parseNumber(text, decimalComma_))
        fail(fmt::format("{} follows the last value: the counts of angles are too small", quoted(text)));
}

}  // namespace penumbra::studio
