// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/exposure_argument.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>

#include "studio/errors.h"
#include "studio/image/image_io.h"

namespace penumbra::studio {
namespace {

constexpr std::string_view key = "penumbra:exposure_ev";
constexpr std::string_view lock = "lock=";
/// From what no eye sees to the sun's own face, and some.
constexpr float darkest_ev = -20, brightest_ev = 40;

std::optional<float> parseValue(std::string_view text) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool good = error == std::errc() && end == text.data() + text.size() && value >= darkest_ev &&
                      value <= brightest_ev;
    return good ? std::optional(value) : std::nullopt;
}

float valueOf(const std::filesystem::path& picture) {
    const Metadata metadata =
        picture.extension() == ".exr" ? readExr(picture).metadata : readPng(picture).metadata;
    const auto found = metadata.find(std::string(key));
    const std::optional<float> value = found == metadata.end() ? std::nullopt : parseValue(found->second);
    if (!value) {
        throw InputError(
            fmt::format("--exposure lock='{}': the picture does not say how it was exposed; name one that "
                        "'penumbra render' wrote, or give a number",
                        picture.string()));
    }
    return *value;
}

}  // namespace

void ExposureArgument::addTo(CLI::App& command) {
    command
        .add_option("--exposure", text,
                    "auto: by the mean of the unshadowed picture; EV: 1.2 x 2^EV nits are white; lock=FILE: "
                    "as that picture of ours")
        ->capture_default_str();
}

std::optional<float> ExposureArgument::value() const {
    if (text == "auto") return std::nullopt;
    if (text.starts_with(lock)) return valueOf(text.substr(lock.size()));
    const std::optional<float> value = parseValue(text);
    if (!value) {
        throw UsageError(
            fmt::format("--exposure '{}' is neither auto, nor lock=FILE, nor a number from {} to {}", text,
                        darkest_ev, brightest_ev));
    }
    return value;
}

void stateExposure(Metadata& metadata, float ev) {
    metadata[std::string(key)] = fmt::format("{}", ev);
}

}  // namespace penumbra::studio
