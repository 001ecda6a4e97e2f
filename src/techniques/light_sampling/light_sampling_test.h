// SPDX-License-Identifier: Apache-2.0
// What the tests of this room share.
#pragma once

#include <algorithm>
#include <cmath>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {

/// Maps of 128 texels and few samples keep the tests short.
class LightSamplingTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{120, 68};
    static const Settings& small() {
        static const Settings settings = {{"map_size", "128"}};
        return settings;
    }
    static Settings with(Settings more) {
        more.insert(more.begin(), small().begin(), small().end());
        return more;
    }
    static double count(const LightResult& result, std::string_view name) {
        const auto& counts = result.statistics.counts;
        const auto found = std::ranges::find(counts, name, &Statistic::name);
        return found == counts.end() ? -1 : found->value;
    }
    static double largestDifference(const LightResult& a, const LightResult& b) {
        double largest = 0;
        for (std::size_t i = 0; i < a.visibility.values.size(); ++i) {
            largest = std::max(largest, std::abs(double(a.visibility.values[i]) - b.visibility.values[i]));
        }
        return largest;
    }
    static double rmsDifference(const LightResult& a, const LightResult& b) {
        double squares = 0;
        for (std::size_t i = 0; i < a.visibility.values.size(); ++i) {
            squares += std::pow(double(a.visibility.values[i]) - b.visibility.values[i], 2);
        }
        return std::sqrt(squares / double(a.visibility.values.size()));
    }
};

}  // namespace penumbra::studio
