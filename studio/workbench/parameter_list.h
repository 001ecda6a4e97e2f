// SPDX-License-Identifier: Apache-2.0
// A technique's parameters as text and numbers: for tables, JSON, settings and commands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "penumbra/penumbra.h"

namespace penumbra::studio {

struct ParameterDescription {
    enum class Kind { boolean, integer, real, choice };

    std::string name, unit, help;
    Kind kind = Kind::boolean;
    std::string value;        ///< as setParameter takes it; of a fresh technique it is the default
    double min = 0, max = 0;  ///< of numbers; may be infinite
    std::vector<std::string> choices;
};

/// All of them, in the technique's own order; numbers in the shortest form that reads back the same.
std::vector<ParameterDescription> describeParameters(Technique& technique);

/// "boolean", "integer", "real" or "choice".
std::string_view nameOf(ParameterDescription::Kind kind);

/// "0 to 1", "1 or more", "any number", "3x3, 5x5", "true or false": what may be set.
std::string legalValues(const ParameterDescription& parameter);

}  // namespace penumbra::studio
