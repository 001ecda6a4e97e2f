// SPDX-License-Identifier: Apache-2.0
// An error or a time instead of settings: --error and --budget-ms.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::studio {

struct AskedFor {
    std::optional<double> error;      ///< of visibility, root mean square in the penumbra
    std::optional<double> budget_ms;  ///< of the device, for a frame's lights together

    void addTo(CLI::App& command);
    void addErrorTo(CLI::App& command);  ///< without the time

    /// The settings of `technique` (parameter, value) that follow. Throws UsageError where a value is out of
    /// range, and where the technique cannot promise what is asked for, with the smallest error that it can.
    std::vector<std::pair<std::string, std::string>> settingsOf(const std::string& technique) const;
};

}  // namespace penumbra::studio
