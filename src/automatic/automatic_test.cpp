// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "penumbra/promise.h"
#include "src/automatic/budget_keeper.h"
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

TEST_F(AutomaticTest, TakesTheChoiceThatIsStated) {
    const Scene scene = makeBuiltin("two-boxes");
    for (const char* error : {"1", "0.3", "0.03", "0.02", "0.01", "0.005"}) {
        const auto taken = render("auto", scene, {32, 24}, {{"max_error", error}}).statistics.chosen;
        const std::optional<Choice> choice = choiceFor(std::stof(error));
        ASSERT_TRUE(choice) << error;
        EXPECT_EQ(taken.technique, choice->technique) << error;
        EXPECT_EQ(taken.value, choice->promise.value) << error;
    }
    EXPECT_FALSE(choiceFor(1e-5));
    EXPECT_FALSE(choiceFor(1, "none"));
    EXPECT_EQ(choiceFor(0.02f, "exact")->technique, "exact");
}

TEST_F(AutomaticTest, ATimeThatNothingKeepsIsToldOfAndSoIsTheErrorThatGaveWay) {
    const std::unique_ptr<Technique> automatic = workbench().makeTechnique("auto");
    setParameter(*automatic, "budget_ms", "0.001");
    const Scene scene = makeBuiltin("many-lights");
    workbench().open(scene);
    const SceneMoment moment = scene.at(0);
    LightResult last;
    for (int frame = 0; frame < BudgetKeeper::framesBetweenChanges; ++frame)
        last = workbench().run("auto", *automatic, moment, moment.cameras.front(), {16, 12}).lights.back();
    EXPECT_EQ(countOf(last.statistics, "error gave way to the budget"), 1);
    EXPECT_EQ(countOf(last.statistics, "budget gave way"), 1);
    setParameter(*automatic, "budget_ms", "1e9");
    last = workbench().run("auto", *automatic, moment, moment.cameras.front(), {16, 12}).lights.back();
    EXPECT_EQ(countOf(last.statistics, "error gave way to the budget"), 0);
    EXPECT_EQ(countOf(last.statistics, "budget gave way"), 0);
}

TEST_F(AutomaticTest, ErrorsAndTimesThatCannotBeAreRefused) {
    const std::unique_ptr<Technique> automatic = workbench().makeTechnique("auto");
    for (const auto& [parameter, value] :
         std::initializer_list<std::pair<const char*, const char*>>{{"max_error", "0"},
                                                                    {"max_error", "-0.1"},
                                                                    {"max_error", "nan"},
                                                                    {"max_error", "1.01"},
                                                                    {"budget_ms", "0"},
                                                                    {"budget_ms", "-4"},
                                                                    {"budget_ms", "nan"}}) {
        EXPECT_THROW(setParameter(*automatic, parameter, value), Error) << parameter << " = " << value;
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
