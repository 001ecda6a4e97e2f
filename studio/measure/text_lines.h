// SPDX-License-Identifier: Apache-2.0
// Text files of any size, line by line.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace penumbra::studio {

class TextLines {
  public:
    /// Throws InputError where the file cannot be read.
    explicit TextLines(const std::filesystem::path& file);

    /// The next line without its end, blanks around it and a byte order mark; valid until the next call. None
    /// at the end. Throws InputError for a line that no text has (64 KiB) and for one with a zero byte.
    std::optional<std::string_view> next();

    /// "FILE:LINE", of the last line.
    std::string where() const;

  private:
    std::filesystem::path file_;
    std::ifstream stream_;
    std::string line_;
    std::size_t number_ = 0;
};

/// Without blanks at its ends.
std::string_view trimmedField(std::string_view text);

/// What a message can hold of a text from a file.
std::string shortened(std::string_view text);

}  // namespace penumbra::studio
