// SPDX-License-Identifier: Apache-2.0
// What techniques promise, so that somebody who wants a certain error or a certain time need not know them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "penumbra/export.h"

namespace penumbra {

/// A value of one of a technique's parameters.
struct Setting {
    std::string_view parameter, value;
};

/// A setting of a technique, and what it keeps.
struct Promise {
    std::string_view parameter;  ///< to be set to `value`; empty: the technique as it is made
    std::string_view value;
    /// Root mean square error of visibility where the truth lies strictly between 0 and 1: at most this over
    /// the penumbra pixels of every scene that the promise was calibrated on (docs/manual/choosing.md lists
    /// them).
    float penumbraRmse;
    /// Of the device's time, in units of `hard`'s: what to expect before anything has been measured.
    float cost;
    /// What is set besides `parameter`. Its storage is static.
    std::span<const Setting> besides{};
};

/// Those of the technique of that name; none where it makes no promise. Their storage is static.
PENUMBRA_API std::span<const Promise> promisesOf(std::string_view technique);

/// What `auto` keeps where nothing else is asked for.
inline constexpr float defaultMaxError = 0.02f;

/// A technique, with the one of its promises that it is taken for.
struct Choice {
    std::string_view technique;  ///< valid for ever
    Promise promise;
};

/// What keeps an error at the least cost: what `auto` takes where no time is short. Only `technique` where
/// one is named. Nothing where nobody promises so little.
PENUMBRA_API std::optional<Choice> choiceFor(double maxError, std::string_view technique = {});

}  // namespace penumbra
