// SPDX-License-Identifier: Apache-2.0
// What is printed with --json has the forms that docs/json.schema.json describes, and no others.
#include <set>

#include "tests/support/command_test.h"
#include "tests/support/json_schema.h"

namespace penumbra::studio {
namespace {

using nlohmann::json;

const std::string examples = PENUMBRA_SOURCE_DIRECTORY "/examples/office/";

class JsonTest : public CommandTest {
  protected:
    /// What a command prints has the form of definition `name`.
    void expectForm(const std::string& name, const std::string& arguments) {
        const Outcome outcome = run(arguments);
        ASSERT_EQ(outcome.exitCode, 0) << arguments << "\n" << outcome.err;
        expectFormOf(name, outcome.out);
    }
    void expectFormOf(const std::string& name, const std::string& text) {
        for (const std::string& complaint : complaintsOf(schema, name, json::parse(text)))
            ADD_FAILURE() << name << ": " << complaint;
        checked.insert(name);
    }

    const json schema = json::parse(readText(PENUMBRA_SOURCE_DIRECTORY "/docs/json.schema.json"));
    std::set<std::string> checked;
};

TEST_F(JsonTest, EverySubcommandKeepsItsForm) {
    const std::string small = " --size 48x32 ", few = small + "--samples 16 --json ";
    expectForm("render", "render many-lights -t auto --json" + small);
    expectForm("frames", "render moving -t hard --frames 1-2 --json" + small);
    expectForm("compare", "compare two-boxes -t auto,exact:samples=16" + few + "-o " + at("one"));
    expectFormOf("compare", readText(at("one/results.json")));
    expectForm("compare", "compare moving -t hard --flicker camera" + few);
    expectForm("compare-several",
               "compare two-boxes torus -t hard,pcf --flicker camera" + few + "-o " + at("two"));
    expectFormOf("compare-several", readText(at("two/results.json")));
    expectForm("bench", "bench two-boxes -t exact:samples=16 --rounds 1" + few + "-o " + at("bench"));
    expectFormOf("bench", readText(at("bench/bench.json")));
    expectForm("measure",
               "measure many-lights --plane=-1,0.002,-1,2,2 --grid 3x2 --per-light --json --timed-runs 2 "
               "--set samples=16");
    expectForm("measure", "measure " + examples +
                              "office.gltf --plane=-2.7,0.72,-1.7,3,0.8 --grid 4x2 --set samples=16 --json "
                              "--sun=52.52,13.405,2026-03-20T12:00+01:00 --over 05:00-13:00/4h");
    expectForm("info-scene", "info moving --json");
    expectForm("info-scene", "info " + examples + "office.gltf --json");
    expectForm("info-nodes", "info " + examples + "office.gltf --nodes --json");
    expectForm("info-luminaire", "info " + examples + "panel.ies --candela 30,0 --json");
    expectForm("info-sun", "info --sun=52.52,13.405,2026-03-20T12:00+01:00 --json");
    expectForm("list-parameters", "list parameters --json");

    // A form that nothing is held against is no form.
    for (const auto& [name, rule] : schema["$defs"].items()) {
        const std::string description = rule.value("description", "");
        const bool isPrinted = description.starts_with("penumbra ");
        EXPECT_TRUE(!isPrinted || checked.contains(name)) << name;
    }
}

TEST_F(JsonTest, OtherFormsAreFound) {
    const json sun = json::parse(run("info --sun=52.52,13.405,2026-03-20T12:00+01:00 --json").out);
    EXPECT_TRUE(complaintsOf(schema, "info-sun", sun).empty());
    const auto changed = [&](const char* patch) { return sun.patch(json::parse(patch)); };
    for (const json& other : {changed(R"([{"op": "remove", "path": "/lux"}])"),
                              changed(R"([{"op": "replace", "path": "/lux", "value": "much"}])"),
                              changed(R"([{"op": "add", "path": "/moon", "value": 1}])"),
                              changed(R"([{"op": "replace", "path": "/format", "value": 2}])")})
        EXPECT_EQ(complaintsOf(schema, "info-sun", other).size(), 1u) << other;
}

}  // namespace
}  // namespace penumbra::studio
