// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <array>
#include <iostream>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/papers/paper_report.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/workbench/progress.h"

namespace penumbra::studio {
namespace {

struct PaperEntry {
    std::string_view name;
    Paper (*make)();
};
constexpr std::array<PaperEntry, 4> papers = {{{"kirsch2003", kirsch2003},
                                               {"thesis", thesis},
                                               {"smoothies2003", smoothies2003},
                                               {"schwaerzler2012", schwaerzler2012}}};

struct ReproduceArguments {
    std::string paper;
    SceneArguments view{.size = "480x270"};
    std::string output;
    ReproductionOptions options;
};

/// One of them, or "all". Throws UsageError.
std::vector<Paper> papersOf(const std::string& name) {
    std::vector<Paper> chosen;
    std::vector<std::string_view> names = {"all"};
    for (const PaperEntry& entry : papers) {
        names.push_back(entry.name);
        if (name == entry.name || name == "all") chosen.push_back(entry.make());
    }
    if (chosen.empty()) {
        throw UsageError(fmt::format("there is no paper '{}'; there are: {}{}", name, fmt::join(names, ", "),
                                     didYouMean(name, names)));
    }
    return chosen;
}

void reproducePapers(const ReproduceArguments& arguments, const std::string& commandLine) {
    const std::vector<Paper> chosen = papersOf(arguments.paper);
    ReproductionOptions options = arguments.options;
    options.size = arguments.view.pictureSize();
    if (!options.models.empty() && !std::filesystem::is_directory(options.models)) {
        throw InputError(fmt::format("--models '{}' is no folder; without it built-in scenes stand in",
                                     options.models.string()));
    }
    requireWritableFolder(arguments.output, true);
    Workbench workbench(arguments.view.device);
    workbench.requireSize(options.size);
    const Machine machine = thisMachine(workbench);
    for (const Paper& paper : chosen) {
        Progress progress(paper.name);
        options.progress = [&](double share, const std::string& part) {
            progress.update(share);
            spdlog::info("{}: {}", paper.name, part);
        };
        const PaperResult result = reproduce(workbench, paper, options);
        writeFileAtomically(std::filesystem::path(arguments.output) / (paper.name + ".html"),
                            toHtml(result, machine, options, commandLine));
        std::cout << judgements(result) << std::flush;
    }
}

}  // namespace

void addReproduce(CLI::App& app, const std::string& commandLine) {
    CLI::App* command =
        app.add_subcommand("reproduce", "the figures and tables of the papers, measured again");
    auto arguments = std::make_shared<ReproduceArguments>();
    command
        ->add_option("PAPER", arguments->paper,
                     "one of: kirsch2003, thesis, smoothies2003, schwaerzler2012, all")
        ->required();
    command->add_option("-o,--output", arguments->output, "a folder for PAPER.html")->required();
    command->add_option("--size", arguments->view.size, "WIDTHxHEIGHT in pixels of every picture")
        ->capture_default_str();
    command->add_option("--samples", arguments->options.samples, "rays for each pixel of the truth")
        ->capture_default_str()
        ->check(CLI::Range(2, 65536));
    command->add_option("--rounds", arguments->options.rounds, "measured rounds for each cost")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_option("--models", arguments->options.models,
                        "a folder of models (see docs/command-line.md); without it built-in scenes stand in");
    command->add_option("--device", arguments->view.device, "index from 'penumbra list devices'");
    command->callback([arguments, commandLine] { reproducePapers(*arguments, commandLine); });
}

}  // namespace penumbra::studio
