// SPDX-License-Identifier: Apache-2.0
// Numbers of a text, one after the other, each with its line: wherever the writer has broken his lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::studio {

/// Text as lines, whatever ends them (LF, CR LF, CR); a byte order mark is left out.
std::vector<std::string_view> linesOf(std::string_view text);

std::string_view trimmed(std::string_view text);

/// Throws InputError "FILE:LINE: PROBLEM".
[[noreturn]] void failAt(const std::string& fileName, int line, const std::string& problem);

/// A finite number that is all of `text`; a leading '+' is allowed, as is a decimal comma where
/// `decimalComma` says so.
std::optional<double> parseNumber(std::string_view text, bool decimalComma);

enum class Separators {
    blanksAndCommas,  ///< LM-63; decimal points
    blanks,           ///< EULUMDAT; decimal points or commas
};

class NumberStream {
  public:
    /// From `lines[first]` on. `lines` and what they view must outlive this.
    NumberStream(const std::string& fileName, const std::vector<std::string_view>& lines, std::size_t first,
                 Separators separators);

    /// The next number; `what` is for the message where there is none, or one that is not.
    double next(std::string_view what);

    /// A whole number from `least` to `most`.
    int nextCount(std::string_view what, int least, int most);

    /// As many numbers as stated. Memory grows with what is there, not with what is stated.
    std::vector<double> nextList(std::string_view what, std::size_t count);

    /// Of the number read last, 1-based.
    int line() const { return line_; }

    [[noreturn]] void fail(const std::string& problem) const { failAt(fileName_, line_, problem); }

    /// Throws if the rest begins with a number. Text may follow.
    void requireNoMoreNumbers();

  private:
    /// Empty at the end.
    std::string_view token();
    /// `what` says what is missing or wrong, and is asked only then.
    template <class What>
    double number(What what);

    const std::string& fileName_;
    const std::vector<std::string_view>& lines_;
    std::string_view separators_;
    bool decimalComma_;
    std::size_t at_;
    std::string_view rest_;
    int line_;
};

}  // namespace penumbra::studio
