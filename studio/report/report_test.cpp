// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "studio/report/html.h"
#include "studio/report/plot.h"
#include "studio/report/ranking.h"

namespace penumbra::studio {
namespace {

LightComparison light(double penumbra_rmse, double ms) {
    LightComparison light{.light = "key"};
    light.metrics.penumbra_rmse = penumbra_rmse;
    light.milliseconds = {ms};
    return light;
}

/// Of techniques (name, error, cost in ms), one light.
Comparison comparison(std::string scene, std::vector<std::tuple<std::string, double, double>> techniques) {
    Comparison all{.scene = std::move(scene)};
    for (const auto& [name, error, ms] : techniques)
        all.techniques.push_back({.technique = name, .lights = {light(error, ms)}});
    return all;
}

const std::vector<Comparison> two = {comparison("a", {{"hard", 0.3, 10}, {"soft", 0.1, 20}}),
                                     comparison("b", {{"hard", 0.1, 5}, {"soft", 0.05, 40}})};

TEST(Ranking, ErrorsAreMeansAndRatiosGeometricOnes) {
    const std::vector<Rank> ranks = rank(two);
    ASSERT_EQ(ranks.size(), 2u);
    EXPECT_DOUBLE_EQ(ranks[0].penumbra_rmse, 0.2);
    EXPECT_NEAR(ranks[1].penumbra_rmse, 0.075, 1e-15);
    EXPECT_NEAR(ranks[0].ratioToHard.value(), 1, 1e-12);
    EXPECT_NEAR(ranks[1].ratioToHard.value(), std::sqrt(2.0 * 8.0), 1e-12);
    EXPECT_FALSE(ranks[0].flicker.has_value());
}

TEST(Ranking, WithoutHardThereIsNoRatio) {
    const std::vector<Comparison> alone = {comparison("a", {{"soft", 0.1, 20}})};
    EXPECT_FALSE(rank(alone)[0].ratioToHard.has_value());
}

TEST(Ranking, JsonHasTheLeastErrorFirst) {
    const auto json = toJson(two);
    EXPECT_EQ(json.at("comparisons").size(), 2u);
    EXPECT_EQ(json.at("ranking").at(0).at("technique"), "soft");
    EXPECT_EQ(json.at("ranking").at(1).at("technique"), "hard");
}

TEST(Ranking, MarkdownHasARowForEachScene) {
    const std::string markdown = toMarkdown(two);
    EXPECT_NE(markdown.find("| `a` | 0.300 | 0.100 |"), std::string::npos) << markdown;
    EXPECT_NE(markdown.find("| `b` | 1.0 | 8.0 |"), std::string::npos) << markdown;
}

TEST(Html, EscapesWhatIsMarkup) {
    EXPECT_EQ(html::escape("a<b & \"c\">"), "a&lt;b &amp; &quot;c&quot;&gt;");
    const std::vector<std::string> header = {"<x>"};
    EXPECT_NE(html::table(header, {}).find("&lt;x&gt;"), std::string::npos);
}

TEST(Html, PicturesAreInside) {
    const std::string figure = html::figure(Image(2, 1, 3, 0.5f), "grey");
    // The eight bytes that every PNG begins with, and the name of its first chunk, in base 64.
    EXPECT_NE(figure.find("data:image/png;base64,iVBORw0KGgoAAAANSUhEUg"), std::string::npos);
    const std::size_t begin = figure.find("base64,") + 7;
    EXPECT_EQ((figure.find('"', begin) - begin) % 4, 0u) << "base 64 comes in fours";
}

/// The y of the first circle, which is how the first series is marked.
double firstMarkerY(const std::string& svg) {
    const std::string key = "cy=\"";
    return std::stod(svg.substr(svg.find(key) + key.size()));
}

TEST(Plot, LargerIsHigherOnBothKindsOfAxes) {
    for (const bool logarithmic : {false, true}) {
        Plot plot{.title = "t", .x = {.title = "x"}, .y = {.title = "y", .logarithmic = logarithmic}};
        plot.series = {{.name = "s", .points = {{.x = 1, .y = 100}, {.x = 2, .y = 1}}}};
        const double top = firstMarkerY(toSvg(plot));
        plot.series[0].points[0].y = 10;
        plot.series[0].points.push_back({.x = 3, .y = 100});
        EXPECT_LT(top, firstMarkerY(toSvg(plot)));
    }
}

TEST(Plot, DecadesAreEquallyFarApart) {
    const auto yOf = [](double value) {
        Plot plot{.title = "t", .x = {.title = "x"}, .y = {.title = "y", .logarithmic = true}};
        plot.series = {
            {.name = "s", .points = {{.x = 1, .y = value}, {.x = 2, .y = 1}, {.x = 3, .y = 1000}}}};
        return firstMarkerY(toSvg(plot));
    };
    EXPECT_NEAR(yOf(1) - yOf(10), yOf(10) - yOf(100), 0.2) << "tenths of a pixel are written";
}

TEST(Plot, WhatCannotBeShownIsLeftOut) {
    Plot plot{.title = "<t>", .x = {.title = "x"}, .y = {.title = "y", .logarithmic = true}};
    plot.series = {{.name = "s", .points = {{.x = 1, .y = 0}, {.x = 1, .y = NAN}, {.x = INFINITY, .y = 1}}}};
    const std::string svg = toSvg(plot);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_NE(svg.find("&lt;t&gt;"), std::string::npos);
    EXPECT_FALSE(toSvg(Plot{}).empty());
}

}  // namespace
}  // namespace penumbra::studio
