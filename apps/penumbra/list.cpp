// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/context/headless_context.h"
#include "studio/errors.h"
#include "studio/json_text.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/workbench/parameter_list.h"

namespace penumbra::studio {
namespace {

/// A technique's parameters with their defaults; of all techniques without a name. Each is made on a device,
/// since it alone can say.
class ParameterLists {
  public:
    explicit ParameterLists(const std::string& name) {
        for (const TechniqueInfo& info : allTechniques()) {
            if (name.empty() || name == info.name) infos_.push_back(info);
        }
        if (infos_.empty()) parseTechnique(name);  // says what there is
    }

    void print() {
        for (const TechniqueInfo& info : infos_) {
            std::cout << fmt::format("{}: {}\n", info.name, info.summary);
            for (const ParameterDescription& parameter : of(info)) {
                std::cout << fmt::format("  {}={}{}\n      {} ({})\n", parameter.name, parameter.value,
                                         parameter.unit.empty() ? "" : " " + parameter.unit, parameter.help,
                                         legalValues(parameter));
            }
        }
    }

    void printJson() {
        nlohmann::ordered_json json = {{"techniques", nlohmann::json::array()}};
        for (const TechniqueInfo& info : infos_) {
            nlohmann::ordered_json parameters = nlohmann::json::array();
            for (const ParameterDescription& parameter : of(info)) parameters.push_back(toJson(parameter));
            json["techniques"].push_back(
                {{"technique", info.name}, {"summary", info.summary}, {"parameters", std::move(parameters)}});
        }
        std::cout << jsonText(json);
    }

  private:
    std::vector<ParameterDescription> of(const TechniqueInfo& info) {
        return describeParameters(*makeAnyTechnique(device_, info.name));
    }

    /// A number, or null where there is no limit, which JSON cannot say.
    static nlohmann::ordered_json limit(double value) {
        return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    }

    static nlohmann::ordered_json toJson(const ParameterDescription& parameter) {
        using Kind = ParameterDescription::Kind;
        nlohmann::ordered_json json = {{"name", parameter.name},
                                       {"type", nameOf(parameter.kind)},
                                       {"unit", parameter.unit},
                                       {"default", parameter.value},
                                       {"help", parameter.help}};
        if (parameter.kind == Kind::integer || parameter.kind == Kind::real) {
            json["min"] = limit(parameter.min);
            json["max"] = limit(parameter.max);
        }
        if (parameter.kind == Kind::choice) json["choices"] = parameter.choices;
        return json;
    }

    HeadlessContext context_;
    Device device_;
    std::vector<TechniqueInfo> infos_;
};

void listTechniques() {
    for (const TechniqueInfo& info : allTechniques()) {
        std::cout << fmt::format("{:<14} {}\n", info.name, info.summary);
    }
}

void listScenes() {
    for (const BuiltinInfo& info : builtinScenes()) {
        std::cout << fmt::format("{:<22} {}\n", info.name, info.summary);
    }
}

void listDevices() {
    const std::vector<HeadlessDevice> devices = listHeadlessDevices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        std::cout << fmt::format(
            "{:<3} {}{}\n", i, devices[i].name,
            devices[i].usable ? "" : fmt::format(" (not usable: {})", devices[i].whyNot));
    }
    if (devices.empty()) throw NoOpenGLError("EGL offers no device; install libegl1 and libgl1-mesa-dri");
}

}  // namespace

void addList(CLI::App& app) {
    CLI::App* list =
        app.add_subcommand("list", "what there is: techniques, parameters, built-in scenes, devices");
    list->require_subcommand(1);

    auto name = std::make_shared<std::string>();
    CLI::App* techniques = list->add_subcommand("techniques", "names for -t; with a NAME its parameters");
    techniques->add_option("NAME", *name, "a technique");
    techniques->callback([name] { name->empty() ? listTechniques() : ParameterLists(*name).print(); });

    auto isJson = std::make_shared<bool>(false);
    CLI::App* parameters = list->add_subcommand("parameters", "keys for --set, of all techniques or of NAME");
    parameters->add_option("NAME", *name, "a technique");
    parameters->add_flag("--json", *isJson, "print them as JSON");
    parameters->callback([name, isJson] {
        ParameterLists lists(*name);
        *isJson ? lists.printJson() : lists.print();
    });

    list->add_subcommand("scenes", "built-in scenes")->callback(listScenes);
    list->add_subcommand("devices", "indices for --device")->callback(listDevices);
}

}  // namespace penumbra::studio
