// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/penumbra/commands.h"
#include "studio/context/headless_context.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {
namespace {

void listTechniques() {
    for (const TechniqueInfo& info : allTechniques()) fmt::print("{:<14} {}\n", info.name, info.summary);
}

void listScenes() {
    for (const BuiltinInfo& info : builtinScenes()) fmt::print("{:<22} {}\n", info.name, info.summary);
}

void listDevices() {
    const std::vector<HeadlessDevice> devices = listHeadlessDevices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        fmt::print("{:<3} {}{}\n", i, devices[i].name,
                   devices[i].usable ? "" : fmt::format(" (not usable: {})", devices[i].whyNot));
    }
    if (devices.empty()) throw NoOpenGLError("EGL offers no device; install libegl1 and libgl1-mesa-dri");
}

}  // namespace

void addList(CLI::App& app) {
    CLI::App* list = app.add_subcommand("list", "what there is: techniques, built-in scenes, devices");
    list->require_subcommand(1);
    list->add_subcommand("techniques", "names for -t")->callback(listTechniques);
    list->add_subcommand("scenes", "built-in scenes")->callback(listScenes);
    list->add_subcommand("devices", "indices for --device")->callback(listDevices);
}

}  // namespace penumbra::studio
