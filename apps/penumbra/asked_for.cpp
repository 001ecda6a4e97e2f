// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/asked_for.h"

#include <fmt/format.h>

#include <algorithm>

#include "penumbra/promise.h"
#include "studio/errors.h"

namespace penumbra::studio {
namespace {

/// The one that takes its settings from what is asked for.
constexpr std::string_view automatic = "auto";

Promise cheapestFor(double error, const std::string& technique) {
    // Errors that promises name are floats.
    if (const std::optional<Choice> choice = choiceFor(float(error), technique)) return choice->promise;
    const std::span<const Promise> promises = promisesOf(technique);
    if (promises.empty()) {
        throw UsageError(
            fmt::format("--error: '{}' promises no error; '-t {}' takes what does", technique, automatic));
    }
    throw UsageError(
        fmt::format("--error {:g}: the smallest that '{}' can promise is {:g}", error, technique,
                    std::ranges::min_element(promises, {}, &Promise::penumbraRmse)->penumbraRmse));
}

}  // namespace

void AskedFor::addErrorTo(CLI::App& command) {
    command.add_option("--error", error,
                       "the root mean square error of visibility in the penumbra to keep, at the least cost");
}

void AskedFor::addTo(CLI::App& command) {
    addErrorTo(command);
    command.add_option(
        "--budget-ms", budget_ms,
        "milliseconds of the device's time (software: of the process's) that a frame's lights may take");
}

std::vector<std::pair<std::string, std::string>> AskedFor::settingsOf(const std::string& technique) const {
    if (error && !(*error > 0 && *error <= 1))
        throw UsageError(fmt::format("--error {:g}: must lie above 0, and be 1 at most", *error));
    if (budget_ms && !(*budget_ms > 0))
        throw UsageError(fmt::format("--budget-ms {:g}: must be positive", *budget_ms));
    std::vector<std::pair<std::string, std::string>> settings;
    if (technique == automatic) {
        if (error) settings.emplace_back("max_error", fmt::format("{}", *error));
        if (budget_ms) settings.emplace_back("budget_ms", fmt::format("{}", *budget_ms));
        return settings;
    }
    if (budget_ms) {
        throw UsageError(fmt::format(
            "--budget-ms: '{}' does what it does however long that takes; '-t {}' keeps to a time", technique,
            automatic));
    }
    if (!error) return settings;
    const Promise promise = cheapestFor(*error, technique);
    if (!promise.parameter.empty()) settings.emplace_back(promise.parameter, promise.value);
    for (const Setting& setting : promise.besides) settings.emplace_back(setting.parameter, setting.value);
    return settings;
}

}  // namespace penumbra::studio
