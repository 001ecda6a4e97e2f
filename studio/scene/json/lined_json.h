// SPDX-License-Identifier: Apache-2.0
// JSON that knows the line of each value, so that a file written by hand can be corrected by hand.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "studio/scene/json/json_view.h"

namespace penumbra::studio {

/// A parsed document; its views must not outlive it. What is wrong at a value is an InputError of the form
/// "FILE:LINE: PROBLEM".
class LinedJson final : public JsonPlaces {
  public:
    /// What is accepted; more is an error. A file of lights needs a small part of this.
    static constexpr std::size_t maxBytes = 4u << 20;
    static constexpr std::size_t maxValues = 20'000;
    static constexpr std::size_t maxDepth = 64;

    /// Parses a whole document. Throws InputError on bad JSON, on a key that an object has twice and beyond
    /// the limits above.
    LinedJson(std::string_view json, std::string fileName);
    LinedJson(const LinedJson&) = delete;
    LinedJson& operator=(const LinedJson&) = delete;

    JsonView root() const { return {root_, "", *this}; }
    /// Of the value's first character, from 1.
    int lineOf(const JsonView& at) const { return standing_.at(&at.value()).line; }
    /// "FILE:LINE", with which messages begin.
    std::string placeOf(const JsonView& at) const;
    /// The keys of an object in the order of the file.
    std::vector<std::string> keysInOrder(const JsonView& object) const;
    /// Turns down keys that are not among `known`; `where` says of what.
    void checkKeys(const JsonView& object, std::span<const std::string_view> known,
                   std::string_view where) const;

    std::exception_ptr errorAt(const JsonView& at, const std::string& problem) const override;
    std::string subjectOf(const JsonView& at) const override;

  private:
    class Builder;

    struct Standing {
        int line = 1;
        int order = 0;  ///< among the values of the document
    };

    std::string fileName_;
    nlohmann::json root_;
    std::unordered_map<const nlohmann::json*, Standing> standing_;
};

}  // namespace penumbra::studio
