// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/document.h"

#include <algorithm>

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

void Document::restoreLights(std::shared_ptr<const EditedLights::State> state) {
    lights_.restore(std::move(state));
    moment_ = scene_->at(time_s());
    update();
}

bool Document::isBuiltin() const {
    return std::ranges::find(builtinScenes(), nameOrPath_, &BuiltinInfo::name) != builtinScenes().end();
}

std::filesystem::path Document::sidecar() const {
    if (options_.lightsFile) return *options_.lightsFile;
    if (isBuiltin()) return {};
    return std::filesystem::path(nameOrPath_).replace_extension(".lights.json");
}

std::filesystem::path Document::saveLights() {
    std::filesystem::path file = sidecar();
    if (file.empty()) file = nameOrPath_ + ".lights.json";
    if (!lights_.edited()) editLights(moment_.lights);  // from now on they are the file's
    lights_.save(*scene_, file);
    return file;
}

}  // namespace penumbra::studio::viewer
