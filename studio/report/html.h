// SPDX-License-Identifier: Apache-2.0
// Pages that open from disk, alone: pictures are held inside.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studio/image/image.h"

namespace penumbra::studio::html {

std::string escape(std::string_view text);

/// `image` (values as they shall be shown) under its caption, which is text.
std::string figure(const Image& image, std::string_view caption);

/// A table whose first column is text and whose other columns are numbers, aligned right. Cells are text,
/// in which "\n" starts a new line.
std::string table(std::span<const std::string> header, std::span<const std::vector<std::string>> rows);

/// A whole page; `body` is HTML, `title` text.
std::string page(std::string_view title, std::string_view body);

}  // namespace penumbra::studio::html
