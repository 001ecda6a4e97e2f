// SPDX-License-Identifier: Apache-2.0
// The penumbra command. Results go to standard output, everything else to standard error.
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <new>

#include "apps/penumbra/commands.h"
#include "penumbra/device.h"
#include "studio/context/headless_context.h"
#include "studio/errors.h"

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
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        const bool plain =
            !argument.empty() && argument.find_first_of(" \t'\"$\\*?;&|<>()") == std::string::npos;
        line += plain ? " " + argument : " '" + argument + "'";
    }
    return line;
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
    startLog();
    CLI::App app("Soft shadows of lights that have a size, in real time, judged by ray tracing");
    app.set_version_flag("--version", "penumbra " PENUMBRA_VERSION);
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
    studio::addBench(app);
    studio::addReproduce(app, commandLine);
    studio::addInfo(app);
    studio::addList(app);

    try {
        app.parse(argc, argv);
        return done;
    } catch (const CLI::Success& success) {
        return app.exit(success);
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
        return report(failed, fmt::format("unexpected: {}", error.what()));
    }
}
