// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/penumbra/arguments.h"
#include "studio/measure/point_set.h"

namespace penumbra::studio {

struct MeasureArguments {
    SceneArguments scene;
    std::string points, plane, surface, grid;
    std::string technique = "exact";
    std::vector<std::string> settings;
    std::string over, rows;
    std::vector<std::string> merge;
    std::string csv, plan;
    bool perLight = false, json = false;
    int timedRuns = 0;

    void addTo(CLI::App& command);

    /// The points that are asked for. Throws UsageError for flags that cannot be read, InputError for what
    /// they say.
    PointSet where(const Scene& scene, const SceneMoment& moment) const;
    /// Those of --rows, from 1.
    std::optional<std::pair<int, int>> wantedRows() const;
};

}  // namespace penumbra::studio
