// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/document.h"

#include <fmt/format.h>

#include <algorithm>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/picture_decode.h"
#include "studio/scene/builtin/builtin.h"

namespace penumbra::studio::viewer {

Document::Document(Device& device, const std::string& nameOrPath, const OpenOptions& options)
    : nameOrPath_(nameOrPath),
      options_(options),
      scene_(std::make_unique<Scene>(openScene(nameOrPath, options))),
      gpuScene_(device, *scene_),
      lights_(*scene_, sidecar()) {
    take(scene_->at(0));
    bounds_ = moment_.bounds;
    constexpr int steps = 8;
    for (int step = 1; step < steps && duration_s() > 0; ++step) {
        const Bounds moved = scene_->at(duration_s() * step / steps).bounds;
        if (moved.empty()) continue;
        bounds_.include(moved.min);
        bounds_.include(moved.max);
    }
}

void Document::take(SceneMoment moment) {
    moment_ = std::move(moment);
    ownLights_ = moment_.lights;
    update();
}

void Document::setTime(double time_s) {
    take(scene_->at(time_s));
    ++castersRevision_;
}

void Document::update() {
    moment_.lights = lights_.at(moment_, ownLights_);
    gpuScene_.update(moment_);
}

void Document::editLights(std::vector<Light> lights) {
    lights_.edit(std::move(lights), moment_, ownLights_);
    update();
}

void Document::restoreLights(std::shared_ptr<const EditedLights::State> state) {
    lights_.restore(std::move(state));
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
    lights_.save(file);
    return file;
}

void Document::saveLightsAs(const std::filesystem::path& file) {
    if (file.extension() != ".json")
        throw UsageError(fmt::format("'{}': lights are kept in a .json file, for instance {}", file.string(),
                                     std::filesystem::path(file).replace_extension(".lights.json").string()));
    if (!lights_.edited()) editLights(moment_.lights);
    lights_.save(file);
    options_.lightsFile = std::filesystem::absolute(file);
}

int Document::addTexture(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = readWholeFile(file);
    Texture texture;
    texture.picture = int(scene_->pictures.size());
    constexpr int clampToEdge = 33071;
    texture.wrapS = texture.wrapT = clampToEdge;
    scene_->pictures.push_back(decodePicture(bytes, file.string()));
    scene_->textures.push_back(texture);
    return int(scene_->textures.size()) - 1;
}

}  // namespace penumbra::studio::viewer
