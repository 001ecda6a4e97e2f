// SPDX-License-Identifier: Apache-2.0
// A measurement as text: docs/manual/measuring.md has the forms.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "studio/measure/measurement.h"

namespace penumbra::studio {

/// A row a point, in the order of the set; positions in the file's axes, in metres.
std::string toCsv(const Measurement& measurement, const Scene& scene);

/// Fills what was prepared from CSV files that pieces of the same measurement have written. Throws InputError
/// with file and line for a row that is none of its points or is there twice, for other columns than its own,
/// and where points are missing.
void mergeCsv(Measurement& measurement, const Scene& scene, const std::vector<std::filesystem::path>& files);

/// What was measured, and how.
struct MeasuringHeading {
    std::string scene, technique;
};

/// Writes the JSON of the contract as it goes, so that many points take no memory.
void printJson(std::ostream& out, const Measurement& measurement, const Scene& scene,
               const MeasuringHeading& heading);

/// For people. Of more than `mostRows` points the summary alone.
void printTable(std::ostream& out, const Measurement& measurement, const Scene& scene);

/// "min 120 lx, mean 310 lx, ...": of all points that count.
std::string summaryText(const Measurement& measurement);
/// Of a day: how much of it has direct sun for at least 1.5 hours, as EN 17037 asks.
std::string sunText(const Measurement& measurement);

}  // namespace penumbra::studio
