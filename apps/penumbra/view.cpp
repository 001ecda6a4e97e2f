// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/viewer/smoke.h"

namespace penumbra::studio {
namespace {

struct ViewArguments {
    SceneArguments scene;
    std::string shaders;
    int smokeFrames = 0;
};

void view(const ViewArguments& arguments) {
    viewer::Viewer window({.scene = arguments.scene.scene,
                           .open = arguments.scene.openOptions(),
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
    command->add_option("--shaders", arguments->shaders,
                        "read shaders from this source tree, and again whenever they change");
    command
        ->add_option("--smoke-frames", arguments->smokeFrames,
                     "show this many frames of everything there is, and exit")
        ->check(CLI::Range(1, 1000000));
    command->callback([arguments] { view(*arguments); });
}

}  // namespace penumbra::studio
