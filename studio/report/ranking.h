// SPDX-License-Identifier: Apache-2.0
// What several comparisons say together: who is nearest to the truth, and at what cost.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studio/report/comparison.h"

namespace penumbra::studio {

/// A technique over all scenes and lights of some comparisons. Errors are means over them.
struct Rank {
    std::string technique;
    double penumbra_rmse = 0, leak = 0, false_shadow = 0, flip = 0;
    std::optional<double> flicker;      ///< where it was measured
    std::optional<double> ratioToHard;  ///< geometric mean over scenes, where `hard` was compared, too
};

/// In the order of the first comparison's techniques. All comparisons have the same.
std::vector<Rank> rank(std::span<const Comparison> comparisons);

/// {"comparisons": [as toJson(Comparison)], "ranking": [...], the least error first}
nlohmann::ordered_json toJson(std::span<const Comparison> comparisons);

/// A page with pictures inside: the ranking by error and by time, then every scene.
std::string toHtml(std::span<const Comparison> comparisons, const std::string& command);

/// Tables in Markdown, a row for each scene and a column for each technique; numbers are means over a scene's
/// lights.
std::string toMarkdown(std::span<const Comparison> comparisons);

/// For a terminal: the ranking by error.
std::string rankingTable(std::span<const Comparison> comparisons);

}  // namespace penumbra::studio
