// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/text_lines.h"

#include <fmt/format.h>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr std::size_t longestLine = std::size_t(1) << 16;

}  // namespace

TextLines::TextLines(const std::filesystem::path& file) : file_(file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw InputError(fmt::format("{}: is a folder, and no file", file.string()));
    stream_.open(file, std::ios::binary);
    if (!stream_) throw InputError(fmt::format("{}: cannot be read; is it there?", file.string()));
}

std::optional<std::string_view> TextLines::next() {
    line_.clear();
    ++number_;
    char c = 0;
    bool any = false;
    while (stream_.get(c)) {
        any = true;
        if (c == '\n') break;
        if (c == '\0') throw InputError(fmt::format("{}: is no text", where()));
        if (line_.size() == longestLine)
            throw InputError(fmt::format("{}: the line does not end; is this a CSV file?", where()));
        line_.push_back(c);
    }
    if (stream_.bad()) throw InputError(fmt::format("{}: cannot be read on", where()));
    if (!any) return std::nullopt;
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
    std::string_view line = line_;
    if (number_ == 1 && line.starts_with(byteOrderMark)) line.remove_prefix(byteOrderMark.size());
    return trimmedField(line);
}

std::string TextLines::where() const {
    return fmt::format("{}:{}", file_.string(), number_);
}

std::string_view trimmedField(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::string shortened(std::string_view text) {
    constexpr std::size_t most = 40;
    std::string result;
    for (const char c : text.substr(0, most)) result.push_back(static_cast<unsigned char>(c) < ' ' ? '?' : c);
    return text.size() > most ? result + "..." : result;
}

}  // namespace penumbra::studio
