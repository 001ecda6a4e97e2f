// SPDX-License-Identifier: Apache-2.0
// What both formats ask of their numbers.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studio/scene/profiles/light_profile.h"
#include "studio/scene/profiles/number_stream.h"

namespace penumbra::studio {

/// Reads angles; throws unless they increase and lie within [least, most].
std::vector<double> readAngles(NumberStream& numbers, std::string_view what, std::size_t count, double least,
                               double most);

/// Reads `count` candela values times `factor`; throws unless each is at least 0 and of ordinary size.
std::vector<float> readCandela(NumberStream& numbers, std::size_t count, double factor);

/// Throws where there are more values than maxProfileValues.
void requireFewValues(const NumberStream& numbers, std::size_t horizontals, std::size_t verticals);

/// Makes C planes at `planes_deg` (increasing; the last may be a whole turn after the first) a grid's: what
/// they span decides on its symmetry. Throws where that is none. `values` follow the planes.
void setPlanes(CandelaGrid& grid, std::vector<double> planes_deg, std::vector<float> values,
               const NumberStream& numbers);

}  // namespace penumbra::studio
