// SPDX-License-Identifier: Apache-2.0
// In place of the subcommands that a build for the bench alone leaves out.
#include <fmt/format.h>

#include "apps/penumbra/commands.h"
#include "studio/errors.h"

namespace penumbra::studio {
namespace {

void addAbsent(CLI::App& app, const std::string& name) {
    CLI::App* command = app.add_subcommand(name, "not in this build, which is for the bench alone");
    command->fallthrough(false)->allow_extras();  // whatever flags are meant for the real one
    command->callback([name] {
        throw UsageError(
            fmt::format("'{}' is not in this build, which is for the bench alone; configure with "
                        "PENUMBRA_BENCH_ALONE=OFF",
                        name));
    });
}

}  // namespace

void addView(CLI::App& app) {
    addAbsent(app, "view");
}
void addRender(CLI::App& app, const std::string&) {
    addAbsent(app, "render");
}
void addCompare(CLI::App& app, const std::string&) {
    addAbsent(app, "compare");
}
void addMeasure(CLI::App& app, const std::string&) {
    addAbsent(app, "measure");
}
void addReproduce(CLI::App& app, const std::string&) {
    addAbsent(app, "reproduce");
}

}  // namespace penumbra::studio
