// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/asked_for.h"
#include "apps/penumbra/commands.h"
#include "apps/penumbra/info_nodes.h"
#include "apps/penumbra/info_profile.h"
#include "apps/penumbra/info_scene.h"
#include "apps/penumbra/info_sun.h"
#include "studio/errors.h"
#include "studio/scene/profiles/profile_file.h"

namespace penumbra::studio {
namespace {

struct InfoArguments {
    SceneArguments scene;
    std::optional<std::string> nodes;  ///< the pattern that their names match; empty: all
    std::vector<std::string> candela;
    AskedFor askedFor;
    bool json = false;
};

void info(const InfoArguments& arguments) {
    if (arguments.scene.scene.empty()) {
        const auto sun = arguments.scene.sun.option();
        if (!sun) throw UsageError("name a scene, a luminaire's file or a place and time (--sun)");
        return printSun(*sun, arguments.json);
    }
    if (isProfileName(arguments.scene.scene)) {
        if (arguments.nodes)
            throw UsageError(fmt::format("--nodes is for scenes, not for '{}'", arguments.scene.scene));
        return printProfile(arguments.scene.scene, arguments.candela, arguments.json);
    }
    if (!arguments.candela.empty())
        throw UsageError(
            fmt::format("--candela is for luminaires (.ies, .ldt), not for '{}'", arguments.scene.scene));
    arguments.askedFor.settingsOf(std::string(defaultTechnique()));  // refuses what cannot be
    const Scene scene = openScene(arguments.scene.scene, arguments.scene.openOptions());
    if (!arguments.nodes) {
        return printScene(scene, arguments.scene.scene, arguments.askedFor.error.value_or(defaultMaxError),
                          arguments.json);
    }
    printNodes(scene, scene.at(0), arguments.nodes->empty() ? "*" : *arguments.nodes, arguments.json);
}

}  // namespace

void addInfo(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info",
                                           "what a scene holds (triangles, bounds, lights, animations, "
                                           "warnings), a luminaire's file, or where the sun stands");
    auto arguments = std::make_shared<InfoArguments>();
    arguments->scene.addSceneTo(*command, false);
    CLI::Option* nodes =
        command
            ->add_option("--nodes", arguments->nodes,
                         "bounds, materials and triangles of each node whose name matches: --nodes=Window*")
            ->expected(0, 1);
    command
        ->add_option("--candela", arguments->candela,
                     "GAMMA,C in degrees: what a luminaire (.ies, .ldt) sends there; may be repeated")
        ->take_all();
    command->add_flag("--json", arguments->json, "as JSON");
    arguments->askedFor.addErrorTo(*command);
    command->callback([arguments, nodes] {
        if (nodes->count() > 0 && !arguments->nodes) arguments->nodes.emplace();
        info(*arguments);
    });
}

}  // namespace penumbra::studio
