// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "penumbra/promise.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using AutomaticTest = TechniqueTest;

double countOf(const Statistics& statistics, std::string_view name) {
    for (const Statistic& count : statistics.counts) {
        if (count.name == name) return count.value;
    }
    ADD_FAILURE() << "no count '" << name << "'";
    return NAN;
}

TEST_F(AutomaticTest, KeepsTheErrorThatIsAskedFor) {
    // One scene with several shapes, one with overlaps, one textured light.
    for (const char* name : {"primitives", "overlapping-blockers", "textured-window"}) {
        const Scene scene = makeBuiltin(name);
        const LightResult exact = truth(scene, defaultSize, 1024);
        for (const char* error : {"0.05", "0.02", "0.01"}) {
            const LightResult result = render("auto", scene, defaultSize, {{"max_error", error}});
            EXPECT_LE(judge(exact, result).penumbra_rmse, std::stod(error)) << name;
            EXPECT_LE(countOf(result.statistics, "error promised"), std::stof(error));
        }
    }
}

TEST_F(AutomaticTest, IsTheChosenTechniqueBitByBit) {
    const Scene scene = makeBuiltin("primitives");
    const LightResult result = render("auto", scene, defaultSize, {{"max_error", "0.02"}});
    const Statistics::Chosen& chosen = result.statistics.chosen;
    ASSERT_FALSE(chosen.technique.empty());
    const LightResult same = render(std::string(chosen.technique).c_str(), scene, defaultSize,
                                    {{std::string(chosen.parameter), std::string(chosen.value)}});
    EXPECT_EQ(result.visibility.values, same.visibility.values);
}

TEST_F(AutomaticTest, MoreIsNotPaidThanIsAskedFor) {
    const Scene scene = makeBuiltin("two-boxes");
    const LightResult rough = render("auto", scene, defaultSize, {{"max_error", "1"}});
    const LightResult fine = render("auto", scene, defaultSize, {{"max_error", "0.01"}});
    EXPECT_GT(countOf(rough.statistics, "error promised"), countOf(fine.statistics, "error promised"));
}

TEST_F(AutomaticTest, WhatNobodyPromisesIsRefusedWithTheSmallestThatIs) {
    try {
        render("auto", makeBuiltin("two-boxes"), defaultSize, {{"max_error", "0.00001"}});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Kind::badArgument);
        EXPECT_TRUE(std::string(error.what()).starts_with("max_error: no technique promises less than 0.0"))
            << error.what();
    }
}

TEST_F(AutomaticTest, PromisesAreOrderedAndPossible) {
    for (const TechniqueInfo& info : techniqueCatalog()) {
        for (const Promise& promise : promisesOf(info.name)) {
            EXPECT_GT(promise.penumbraRmse, 0) << info.name;
            EXPECT_LE(promise.penumbraRmse, 1) << info.name;
            EXPECT_GE(promise.cost, 1) << info.name;
        }
    }
    EXPECT_TRUE(promisesOf("none").empty());
}

}  // namespace
}  // namespace penumbra::studio
