// SPDX-License-Identifier: Apache-2.0
// The penumbra command. Results go to standard output, everything else to standard error.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <new>
#include <span>

#include "apps/penumbra/commands.h"
#include "penumbra/device.h"
#include "penumbra/version.h"
#include "studio/context/headless_context.h"
#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/workbench/shell_word.h"

namespace {

namespace studio = penumbra::studio;

/// The contract with whoever scripts against us; see docs/command-line.md.
enum ExitCode { done = 0, failed = 1, usage = 2, input = 3, noOpenGL = 4, output = 5 };

void startLog() {
    const bool color = std::getenv("NO_COLOR") == nullptr;
    auto log = color ? spdlog::stderr_color_mt("penumbra") : spdlog::stderr_logger_mt("penumbra");
    log->set_pattern("%^%l%$: %v");
    spdlog::set_default_logger(std::move(log));
    spdlog::set_level(spdlog::level::warn);
}

std::string joinArguments(int argc, char** argv) {
    std::string line = "penumbra";
    for (int i = 1; i < argc; ++i) line += " " + studio::shellWord(argv[i]);
    return line;
}

/// Standard streams that are closed would be given to whatever file is opened next; they get the null device,
/// one that cannot be written to for standard output, so that lost results are noticed.
void takeClosedStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) != -1) continue;
        [[maybe_unused]] const int lowest = open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
}

/// Throws OutputError unless all that was printed has arrived.
void requirePrinted() {
    errno = 0;
    const bool printed = std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (printed) return;
    throw studio::OutputError(fmt::format("standard output: {}; the results are not complete",
                                          errno != 0 ? std::strerror(errno) : "cannot be written"));
}

/// The first word must name one of `app`'s subcommands, and so on within it. Throws UsageError with the
/// nearest.
void requireSubcommand(const CLI::App& app, std::span<char* const> words) {
    const std::vector<const CLI::App*> known = app.get_subcommands({});
    if (known.empty()) return;
    const auto word = std::ranges::find_if(words, [](std::string_view w) { return !w.starts_with('-'); });
    if (word == words.end()) return;  // which the parser reports, or prints the help that was asked for
    std::vector<std::string> names;
    for (const CLI::App* subcommand : known) names.push_back(subcommand->get_name());
    const auto found = std::ranges::find(names, std::string_view(*word));
    if (found == names.end()) {
        const std::vector<std::string_view> views(names.begin(), names.end());
        throw studio::UsageError(fmt::format("there is no '{} {}'; there are: {}{}",
                                             app.get_parent() ? "penumbra " + app.get_name() : "penumbra",
                                             *word, fmt::join(names, ", "),
                                             studio::didYouMean(*word, views)));
    }
    requireSubcommand(*known[std::size_t(found - names.begin())], {word + 1, words.end()});
}

int exitCodeOf(penumbra::Error::Kind kind) {
    switch (kind) {
        case penumbra::Error::Kind::badArgument:
        case penumbra::Error::Kind::unknownName:
            return usage;
        case penumbra::Error::Kind::noOpenGL:
        case penumbra::Error::Kind::shader:
        case penumbra::Error::Kind::outOfMemory:
        case penumbra::Error::Kind::lostContext:
            return noOpenGL;
    }
    return failed;
}

int report(int code, std::string_view message) {
    spdlog::error("{}", message);
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    takeClosedStreams();
    startLog();
    // A reader that has gone and a file that may not grow are errors of writing, with a message and an exit
    // code.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    studio::removeUnfinishedFilesOnSignals();
    CLI::App app("Soft shadows of lights that have a size, in real time, judged by ray tracing");
    app.set_version_flag("--version", "penumbra " + std::string(penumbra::version()));
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag_callback(
        "-v,--verbose", [] { spdlog::set_level(spdlog::level::info); }, "say more");
    app.add_flag_callback(
        "-q,--quiet", [] { spdlog::set_level(spdlog::level::err); }, "say errors alone");
    app.footer(
        "Exit codes: 0 done, 1 a requested threshold failed, 2 usage, 3 input missing or invalid,\n"
        "4 no usable OpenGL, 5 output not writable.");
    const std::string commandLine = joinArguments(argc, argv);
    studio::addView(app);
    studio::addRender(app, commandLine);
    studio::addCompare(app, commandLine);
    studio::addMeasure(app, commandLine);
    studio::addBench(app);
    studio::addReproduce(app, commandLine);
    studio::addInfo(app);
    studio::addList(app);

    try {
        requireSubcommand(app, {argv + 1, argv + argc});
        try {
            app.parse(argc, argv);
        } catch (const CLI::Success& help) {
            app.exit(help);
        } catch (const studio::ThresholdError&) {
            requirePrinted();
            throw;
        }
        requirePrinted();
        return done;
    } catch (const CLI::Error& error) {
        return report(usage, fmt::format("{} (see 'penumbra --help')", error.what()));
    } catch (const studio::ThresholdError& error) {
        return report(failed, error.what());
    } catch (const studio::UsageError& error) {
        return report(usage, error.what());
    } catch (const studio::InputError& error) {
        return report(input, error.what());
    } catch (const studio::NoOpenGLError& error) {
        return report(noOpenGL, error.what());
    } catch (const studio::OutputError& error) {
        return report(output, error.what());
    } catch (const penumbra::Error& error) {
        return report(exitCodeOf(error.kind()), error.what());
    } catch (const std::bad_alloc&) {
        return report(input, "not enough memory for this scene at this size");
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) return report(output, fmt::format("standard output: {}", error.what()));
        return report(failed, fmt::format("unexpected: {}", error.what()));
    }
}
