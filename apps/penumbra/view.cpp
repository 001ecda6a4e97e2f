// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/errors.h"
#include "studio/viewer/smoke.h"
#include "studio/workbench/any_technique.h"

namespace penumbra::studio {
namespace {

struct ViewArguments {
    SceneArguments scene;
    std::string technique;
    std::vector<std::string> settings;
    std::string shaders;
    int smokeFrames = 0;
};

/// What -t and --set ask for; no technique where neither is given.
Contender contenderOf(const ViewArguments& arguments) {
    Contender wanted;
    if (!arguments.technique.empty()) wanted = parseTechnique(arguments.technique);
    for (const std::string& text : arguments.settings) {
        const Setting setting = parseSetting(text);
        if (!setting.technique.empty() && setting.technique != wanted.technique)
            throw UsageError(fmt::format("--set '{}': -t chooses another technique", text));
        wanted.settings.emplace_back(setting.key, setting.value);
    }
    if (wanted.technique.empty() && !wanted.settings.empty()) wanted.technique = defaultTechnique();
    return wanted;
}

void view(const ViewArguments& arguments) {
    const Contender wanted = contenderOf(arguments);
    viewer::Viewer window(
        {.scene = arguments.scene.scene,
         .open = arguments.scene.openOptions(),
         .technique = wanted.technique,
         .parameters = wanted.settings,
         .time_s = arguments.scene.time_s,
         .camera = [&](const Scene& scene,
                       const SceneMoment& moment) { return arguments.scene.cameraIn(scene, moment); },
         .shaderSourceDirectory = arguments.shaders,
         .keepsSettings = arguments.smokeFrames == 0});
    if (arguments.smokeFrames > 0) return viewer::runSmoke(window, arguments.smokeFrames);
    while (window.frame()) {
    }
}

}  // namespace

void addView(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "look at a scene in a window");
    auto arguments = std::make_shared<ViewArguments>();
    arguments->scene.addSceneTo(*command, false);
    arguments->scene.addCameraTo(*command);
    command->add_option("-t,--technique", arguments->technique,
                        "NAME, or NAME:KEY=VALUE with a parameter, of side A; else that of the last time");
    command->add_option("--set", arguments->settings, "KEY=VALUE: a parameter of it; may be repeated")
        ->take_all();
    command->add_option("--shaders", arguments->shaders,
                        "read shaders from this source tree, and again whenever they change");
    command
        ->add_option("--smoke-frames", arguments->smokeFrames,
                     "show this many frames of everything there is, and exit")
        ->check(CLI::Range(1, 1000000));
    command->callback([arguments] { view(*arguments); });
}

}  // namespace penumbra::studio
