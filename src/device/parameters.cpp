// SPDX-License-Identifier: Apache-2.0
#include "penumbra/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "penumbra/technique.h"

namespace penumbra {
namespace {

template <typename T>
std::optional<T> parse(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

class Setter final : public ParameterVisitor {
  public:
    Setter(std::string_view name, std::string_view text) : name_(name), text_(text) {}

    void boolean(const ParameterInfo& info, bool& value) override {
        if (!matches(info)) return;
        if (text_ == "true" || text_ == "1" || text_ == "on") {
            value = true;
        } else if (text_ == "false" || text_ == "0" || text_ == "off") {
            value = false;
        } else {
            reject("true or false");
        }
    }
    void integer(const ParameterInfo& info, int& value, Range<int> range) override {
        number(info, value, range);
    }
    void real(const ParameterInfo& info, float& value, Range<float> range) override {
        number(info, value, range);
    }
    void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) override {
        if (!matches(info)) return;
        const auto found = std::ranges::find(names, text_);
        if (found == names.end()) reject("one of " + join(names));
        value = int(found - names.begin());
    }

    void requireFound() const {
        if (found_) return;
        throw Error(Error::Kind::unknownName,
                    "there is no parameter '" + std::string(name_) + "'; there are: " + join(seen_));
    }

  private:
    bool matches(const ParameterInfo& info) {
        seen_.push_back(info.name);
        const bool found = info.name == name_;
        found_ |= found;
        return found;
    }
    template <typename T>
    void number(const ParameterInfo& info, T& value, Range<T> range) {
        if (!matches(info)) return;
        const std::optional<T> parsed = parse<T>(text_);
        // Written so that a NaN, which compares false with everything, is rejected too.
        if (!parsed || !(*parsed >= range.min && *parsed <= range.max)) {
            std::ostringstream legal;
            legal << "a number from " << range.min << " to " << range.max << " " << info.unit;
            reject(legal.str());
        }
        value = *parsed;
    }
    [[noreturn]] void reject(const std::string& legal) const {
        throw Error(Error::Kind::badArgument, "parameter '" + std::string(name_) + "' cannot be '" +
                                                  std::string(text_) + "'; it must be " + legal);
    }
    static std::string join(std::span<const std::string_view> names) {
        std::string result;
        for (const std::string_view name : names) result += (result.empty() ? "" : ", ") + std::string(name);
        return result;
    }

    std::string_view name_, text_;
    std::vector<std::string_view> seen_;
    bool found_ = false;
};

}  // namespace

void setParameter(Technique& technique, std::string_view name, std::string_view value) {
    Setter setter(name, value);
    technique.describe(setter);
    setter.requireFound();
}

}  // namespace penumbra
