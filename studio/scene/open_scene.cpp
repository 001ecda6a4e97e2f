// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/open_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "studio/errors.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/defaults.h"
#include "studio/scene/gltf/gltf.h"
#include "studio/scene/hints.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/lights/sidecar.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

/// A scene without its animations.
class StandsStill : public Scene::Motion {
  public:
    explicit StandsStill(std::shared_ptr<const Scene::Motion> inner) : inner_(std::move(inner)) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, 0);
        moment.time_s = time_s;
        return moment;
    }

  private:
    std::shared_ptr<const Scene::Motion> inner_;
};

/// The sun, beside the lights that a file has named, or in place of the scene's own. It stands still: an
/// animation lasts seconds.
class WithSun : public Scene::Motion {
  public:
    WithSun(std::shared_ptr<const Scene::Motion> inner, Light sun, bool keepsLights)
        : inner_(std::move(inner)), sun_(std::move(sun)), keepsLights_(keepsLights) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, time_s);
        if (!keepsLights_) moment.lights.clear();
        const auto isTaken = [&](const std::string& name) {
            return std::ranges::find(moment.lights, name, &Light::name) != moment.lights.end();
        };
        Light sun = sun_;
        for (int number = 2; isTaken(sun.name); ++number) sun.name = fmt::format("{} {}", sun_.name, number);
        moment.lights.push_back(std::move(sun));
        return moment;
    }

  private:
    std::shared_ptr<const Scene::Motion> inner_;
    Light sun_;
    bool keepsLights_;
};

Scene openBuiltin(const std::string& name, const OpenOptions& options) {
    Scene scene = makeBuiltin(name);
    if (options.scene.value_or(0) != 0)
        throw InputError(
            fmt::format("built-in scene '{}' has no scene {}: it has one, 0", name, *options.scene));
    if (options.animations && options.animations->empty()) {
        for (Animation& animation : scene.animations) animation.plays = false;
        scene.motion = std::make_shared<StandsStill>(scene.motion);
    }
    for (const int index : options.animations.value_or(std::vector<int>{}))
        if (index < 0 || std::size_t(index) >= scene.animations.size())
            throw InputError(fmt::format("built-in scene '{}' has no animation {}: it has {}", name, index,
                                         scene.animations.size()));
    return scene;
}

Scene openFile(const fs::path& file, const OpenOptions& options, const ModelReading& reading) {
    std::error_code error;
    if (fs::is_directory(file, error))
        throw InputError(fmt::format("'{}' is a directory: name a .gltf or .glb file in it", file.string()));
    if (!fs::exists(file, error)) {
        std::vector<std::string_view> names;
        for (const BuiltinInfo& info : builtinScenes()) names.push_back(info.name);
        const std::string hint = didYouMean(file.string(), names);
        throw InputError(
            fmt::format("there is no file and no built-in scene '{}'{}", file.string(),
                        hint.empty() ? "; 'penumbra list scenes' names the built-in ones" : hint));
    }
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    if (extension != ".gltf" && extension != ".glb")
        throw InputError(fmt::format("'{}' is not a scene that can be read: only glTF 2.0, .gltf or .glb{}",
                                     file.string(), wayToGltf(file)));
    GltfOptions gltf;
    gltf.scene = options.scene;
    gltf.glass = reading.glass.value_or(gltf.glass);
    gltf.unit_m = reading.unit_m.value_or(gltf.unit_m);
    gltf.up = reading.up.value_or(gltf.up);
    gltf.animations = options.animations;
    Scene scene = loadGltf(file, gltf);
    const SceneMoment start = scene.at(0);
    if (!reading.unit_m)
        if (const auto hint = unitHint(start))
            scene.warnings.push_back(fmt::format("{} {}", file.string(), *hint));
    if (!reading.up)
        if (const auto hint = upHint(scene, start))
            scene.warnings.push_back(fmt::format("{} {}", file.string(), *hint));
    return scene;
}

/// The file that is asked for or, of a scene that is a file, the one beside it.
std::optional<fs::path> lightsFileOf(const std::string& nameOrPath, const OpenOptions& options) {
    if (options.lightsFile || isBuiltin(nameOrPath)) return options.lightsFile;
    const fs::path beside = fs::path(nameOrPath).replace_extension(".lights.json");
    std::error_code error;
    return fs::exists(beside, error) ? std::optional(beside) : std::nullopt;
}

}  // namespace

Scene openScene(const std::string& nameOrPath, const OpenOptions& options) {
    const bool builtin = isBuiltin(nameOrPath);
    const std::optional<fs::path> lightsFile = lightsFileOf(nameOrPath, options);
    std::optional<Sidecar> sidecar;
    if (lightsFile) sidecar = readSidecar(*lightsFile);
    const ModelReading reading = options.reading.orElse(sidecar ? sidecar->reading : ModelReading());
    Scene scene = builtin ? openBuiltin(nameOrPath, options) : openFile(nameOrPath, options, reading);
    if (builtin && !reading.saysNothing())
        scene.warnings.push_back(
            fmt::format("built-in scene '{}' is in metres with Y up and without glass: 'unit', 'up' and "
                        "'glass' are said of it in vain",
                        nameOrPath));

    if (sidecar) applySidecar(scene, *sidecar, lightsFile->parent_path());
    if (options.sun) {
        Light sun = sunLight("sun", options.sun->place, options.sun->setting, "--sun");
        scene.motion =
            std::make_shared<WithSun>(scene.motion, std::move(sun), sidecar && sidecar->lights.has_value());
    }
    scene.motion = withSizes(scene.motion, options.lightSizes);
    addDefaults(scene, nameOrPath);
    if (const auto hint = sizelessHint(scene.at(0)))
        scene.warnings.push_back(fmt::format("{}: {}", nameOrPath, *hint));
    return scene;
}

}  // namespace penumbra::studio
