// SPDX-License-Identifier: Apache-2.0
// Every technique once, made when it is first asked for, with its parameters as text.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "penumbra/penumbra.h"

namespace penumbra::studio::viewer {

/// NAME, VALUE as setParameter takes them.
using ParameterValues = std::vector<std::pair<std::string, std::string>>;

/// All parameters with their values; numbers in the shortest form that reads back the same.
ParameterValues parameterValues(Technique& technique);

class TechniqueBank {
  public:
    explicit TechniqueBank(Device& device) : device_(device) {}

    /// Throws Error::Kind::unknownName.
    Technique& get(std::string_view name);

    const ParameterValues& defaults(std::string_view name) { return entry(name).defaults; }
    /// What differs from the defaults: "KEY=VALUE" of the command's --set.
    ParameterValues changes(std::string_view name);
    /// Back to the defaults, then `values`; those that the technique does not know or allow are left out.
    /// Does not make a technique that nobody has asked for yet.
    void set(std::string_view name, const ParameterValues& values);

    /// Changes of all techniques that were made or set so far, by technique; empty where all is default.
    std::map<std::string, ParameterValues> allChanges();

    /// Throws all techniques away, keeping their parameters: what they held is made anew.
    void forget();

  private:
    struct Entry {
        std::unique_ptr<Technique> technique;
        ParameterValues defaults;
    };
    Entry& entry(std::string_view name);
    static void apply(std::string_view name, Technique& technique, const ParameterValues& values);

    Device& device_;
    std::map<std::string, Entry, std::less<>> entries_;
    std::map<std::string, ParameterValues, std::less<>> wanted_;  ///< of techniques that are not made yet
};

}  // namespace penumbra::studio::viewer
