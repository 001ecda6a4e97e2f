// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "studio/bench/bench_report.h"
#include "studio/papers/reproduction.h"

namespace penumbra::studio {

/// One page with all its pictures inside: figures, tables, the paper's numbers beside ours as ratios, and
/// what the numbers say of the paper's claims.
std::string toHtml(const PaperResult& result, const Machine& machine, const ReproductionOptions& options,
                   const std::string& command);

/// What the numbers say, a line each, for a terminal.
std::string judgements(const PaperResult& result);

}  // namespace penumbra::studio
