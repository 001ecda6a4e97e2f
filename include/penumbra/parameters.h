// SPDX-License-Identifier: Apache-2.0
// A technique describes each of its parameters once; flags, sliders, JSON and the reference page are
// visitors.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "penumbra/export.h"

namespace penumbra {

/// What a person needs to know about a parameter. Its strings, and the names of a choice, are valid for ever.
struct ParameterInfo {
    std::string_view name;       ///< snake_case, as in `--set name=value`
    std::string_view unit = "";  ///< "texels", "m", "deg", ...; empty for a pure number
    std::string_view help = "";  ///< one sentence, with the paper's symbol where it has one
};

template <typename T>
struct Range {
    T min;
    T max;
};

/// Receives every parameter by reference. The value found in a freshly made technique is the default.
class PENUMBRA_API ParameterVisitor {
  public:
    virtual ~ParameterVisitor() = default;
    virtual void boolean(const ParameterInfo& info, bool& value) = 0;
    virtual void integer(const ParameterInfo& info, int& value, Range<int> range) = 0;
    /// A NaN is never stored. A range may end at infinity.
    virtual void real(const ParameterInfo& info, float& value, Range<float> range) = 0;
    /// One of `names`; `value` is its index.
    virtual void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) = 0;
};

class Technique;

/// Sets one parameter from text. Throws Error::Kind::unknownName with the nearest names, or
/// Error::Kind::badArgument with the legal range.
PENUMBRA_API void setParameter(Technique& technique, std::string_view name, std::string_view value);

}  // namespace penumbra
