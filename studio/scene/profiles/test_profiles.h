// SPDX-License-Identifier: Apache-2.0
// Profiles written for the tests, in the styles that published files have.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "studio/errors.h"
#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio::testing {

inline double sine(double degrees) {
    return std::sin(degrees * std::numbers::pi / 180);
}
inline double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180);
}

/// What stands in an LM-63 file; every member as it is written.
struct Lm63Text {
    std::string first = "IESNA:LM-63-2002\n[TEST] own\n";
    std::string tilt = "TILT=NONE\n";
    std::string lamps = "1 -1";
    std::string multiplier = "1";
    int type = 1, unit = 2;
    std::string opening = "0 0 0";
    std::string factors = "1 1 50";
    std::vector<double> verticals, horizontals;
    std::function<double(double vertical, double horizontal)> candela;
    std::string last;

    std::string text() const {
        std::string text = first + tilt;
        text += fmt::format("{} {} {} {} {} {} {}\n{}\n", lamps, multiplier, verticals.size(),
                            horizontals.size(), type, unit, opening, factors);
        for (const auto* angles : {&verticals, &horizontals}) {
            for (const double angle : *angles) text += fmt::format("{} ", angle);
            text += "\n";
        }
        for (const double h : horizontals) {
            for (const double v : verticals) text += fmt::format("{:.6f} ", candela(v, h));
            text += "\n";
        }
        return text + last;
    }
};

/// 0, step, 2 step, ... up to `last`.
inline std::vector<double> steps(double first, double last, double step) {
    std::vector<double> angles;
    for (int i = 0; first + i * step <= last + 1e-9; ++i) angles.push_back(first + i * step);
    return angles;
}

inline LightProfile readLm63(const std::string& text) {
    return parseLm63(text, "lamp.ies", [](const std::string& name, int line) -> std::string {
        throw InputError(fmt::format("lamp.ies:{}: no file '{}'", line, name));
    });
}
inline LightProfile readLm63(const Lm63Text& file) {
    return readLm63(file.text());
}

/// The message with which text is turned down; "accepted" where it is not.
inline std::string lm63Error(const std::string& text) {
    try {
        readLm63(text);
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

inline double candelaAt(const LightProfile& profile, double gamma_deg, double c_deg) {
    return profile.grid.at(directionOf(gamma_deg, c_deg));
}

/// EULUMDAT of `planes` C planes all around of which those of `symmetry` have values.
struct EulumdatText {
    int symmetry = 0, planes = 24;
    std::string length = "600", width = "300", heights = "0\n0\n0\n0";
    std::string factor = "1,0", tilt = "0";
    std::vector<std::string> sets = {"1\nLED\n1000\n4000\n80\n20"};
    std::vector<double> gammas = steps(0, 90, 5);
    std::vector<double> planesWithValues;
    std::function<double(double gamma, double c)> candela;
    std::string lineEnd = "\r\n";

    std::string text() const {
        std::string text =
            fmt::format("Eigenbau\n3\n{}\n{}\n{}\n{}\n5\nOWN\nLeuchte\n7\nown\n2026\n620\n320\n90\n",
                        symmetry, planes, 360.0 / planes, gammas.size());
        text += fmt::format("{}\n{}\n{}\n100\n63\n{}\n{}\n{}\n", length, width, heights, factor, tilt,
                            sets.size());
        for (const std::string& set : sets) text += set + "\n";
        for (int i = 0; i < 10; ++i) text += "0,5\n";
        const auto line = [&](double value) {
            std::string number = fmt::format("{:.4f}\n", value);
            number.replace(number.find('.'), 1, ",");
            text += number;
        };
        for (int i = 0; i < planes; ++i) line(360.0 * i / planes);
        for (const double gamma : gammas) line(gamma);
        for (const double c : planesWithValues)
            for (const double gamma : gammas) line(candela(gamma, c));
        std::string ended;
        for (const char c : text) ended += c == '\n' ? lineEnd : std::string(1, c);
        return ended;
    }
};

}  // namespace penumbra::studio::testing
