// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace penumbra::studio {

/// Each adds its subcommand, which runs while the command line is parsed and throws what went wrong (see
/// main.cpp). `commandLine` is what the user typed, for the metadata of pictures.
void addRender(CLI::App& app, const std::string& commandLine);
void addCompare(CLI::App& app, const std::string& commandLine);
void addBench(CLI::App& app);
void addReproduce(CLI::App& app, const std::string& commandLine);
void addInfo(CLI::App& app);
void addList(CLI::App& app);
void addMeasure(CLI::App& app, const std::string& commandLine);
void addView(CLI::App& app);

}  // namespace penumbra::studio
