// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/document.h"

#include <fmt/format.h>

#include <algorithm>

#include "studio/errors.h"
#include "studio/scene/builtin/builtin.h"

namespace penumbra::studio::viewer {

Document::Document(Device& device, const std::string& nameOrPath, const OpenOptions& options)
    : nameOrPath_(nameOrPath),
      options_(options),
      scene_(std::make_unique<Scene>(openScene(nameOrPath, options))),
      gpuScene_(device, *scene_) {
    moment_ = scene_->at(0);
    bounds_ = moment_.bounds;
    constexpr int steps = 8;
    for (int step = 1; step < steps && duration_s() > 0; ++step) {
        const Bounds moved = scene_->at(duration_s() * step / steps).bounds;
        if (moved.empty()) continue;
        bounds_.include(moved.min);
        bounds_.include(moved.max);
    }
    update();
}

double Document::duration_s() const {
    const auto index = std::size_t(std::max(options_.animation, 0));
    if (options_.animation < 0 || index >= scene_->animations.size()) return 0;
    return scene_->animations[index].duration_s;
}

void Document::setTime(double time_s) {
    moment_ = scene_->at(time_s);
    update();
    ++castersRevision_;
}

void Document::update() {
    lights_.apply(moment_);
    gpuScene_.update(moment_);
}

void Document::editLights(std::vector<Light> lights) {
    lights_.edit(std::move(lights));
    update();
}

void Document::revertLights() {
    lights_.revert();
    setTime(time_s());
}

std::filesystem::path Document::saveLights() {
    const bool builtin =
        std::ranges::find(builtinScenes(), nameOrPath_, &BuiltinInfo::name) != builtinScenes().end();
    if (builtin && !options_.lightsFile) {
        throw OutputError(
            fmt::format("'{0}' is a built-in scene: start with --lights {0}.lights.json to have "
                        "a file to save its lights in",
                        nameOrPath_));
    }
    const std::filesystem::path file =
        options_.lightsFile.value_or(std::filesystem::path(nameOrPath_).replace_extension(".lights.json"));
    lights_.save(*scene_, moment_, file);
    return file;
}

}  // namespace penumbra::studio::viewer
