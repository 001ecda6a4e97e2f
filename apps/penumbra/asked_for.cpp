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

const Promise& cheapestFor(double error, const std::string& technique) {
    const std::span<const Promise> promises = promisesOf(technique);
    const Promise* cheapest = nullptr;
    double smallest = 1;
    for (const Promise& promise : promises) {
        smallest = std::min(smallest, double(promise.penumbraRmse));
        if (double(promise.penumbraRmse) > error) continue;
        if (cheapest == nullptr || promise.cost < cheapest->cost) cheapest = &promise;
    }
    if (cheapest != nullptr) return *cheapest;
    throw UsageError(
        promises.empty()
            ? fmt::format("--error: '{}' promises no error; '-t {}' takes what does", technique, automatic)
            : fmt::format("--error {:g}: the smallest that '{}' can promise is {:g}", error, technique,
                          smallest));
}

}  // namespace

void AskedFor::addTo(CLI::App& command) {
    command.add_option("--error", error,
                       "the root mean square error of visibility in the penumbra to keep, at the least cost");
    command.add_option(
        "--budget-ms", budget_ms,
        "milliseconds of the device's time (software: of the process's) that a light may take");
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
    const Promise& promise = cheapestFor(*error, technique);
    if (!promise.parameter.empty()) settings.emplace_back(promise.parameter, promise.value);
    return settings;
}

}  // namespace penumbra::studio
