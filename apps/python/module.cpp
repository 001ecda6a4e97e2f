// SPDX-License-Identifier: Apache-2.0
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>
#include <utility>

#include "apps/python/bindings.h"
#include "penumbra/version.h"

namespace penumbra::studio::python {
namespace {

/// What the device says goes to standard error, and only what is more than information.
void startLog() {
    auto log =
        std::make_shared<spdlog::logger>("penumbra", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    log->set_pattern("penumbra: %l: %v");
    log->set_level(spdlog::level::warn);
    spdlog::set_default_logger(std::move(log));
}

}  // namespace
}  // namespace penumbra::studio::python

PYBIND11_MODULE(_penumbra, module) {
    using namespace penumbra::studio::python;
    startLog();
    translateErrors();
    module.attr("__version__") = std::string(penumbra::version());
    addCamera(module);
    addMesh(module);
    addScenes(module);
    addFrame(module);
    addRenderer(module);
    addJudging(module);
}
