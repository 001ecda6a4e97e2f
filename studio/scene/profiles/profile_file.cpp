// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/profile_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "studio/errors.h"
#include "studio/scene/file_beside.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

std::string readText(const fs::path& file, const std::string& where) {
    const std::vector<std::byte> bytes = readWholeFile(file, maxProfile_bytes, where);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string extensionOf(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

}  // namespace

bool isProfileName(const fs::path& file) {
    const std::string extension = extensionOf(file);
    return extension == ".ies" || extension == ".ldt";
}

LightProfile readProfile(const fs::path& file, const std::string& named) {
    if (!isProfileName(file))
        throw InputError(fmt::format(
            "'{}' is not a profile that can be read: only LM-63, .ies, and EULUMDAT, .ldt", file.string()));
    const std::string text = readText(file, named);
    if (extensionOf(file) == ".ldt") return parseEulumdat(text, file.string());
    return parseLm63(text, file.string(), [&](const std::string& name, int line) {
        const std::string where = fmt::format("{}:{}", file.string(), line);
        const fs::path tilt = fileBeneath(file.parent_path(), name, where + ": TILT");
        return readText(tilt, where + ": TILT");
    });
}

}  // namespace penumbra::studio
