// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "studio/errors.h"
#include "studio/image/image_io.h"
#include "studio/workbench/shell_word.h"

namespace penumbra::studio::viewer {
namespace {

namespace fs = std::filesystem;

/// A place in the coordinates of the scene's file.
std::string triple(const Scene& scene, const glm::vec3& posWorld) {
    if (scene.worldFromFile == glm::dmat4(1))
        return fmt::format("{},{},{}", posWorld.x, posWorld.y, posWorld.z);
    const glm::dvec3 v = glm::inverse(scene.worldFromFile) * glm::dvec4(posWorld, 1);
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

/// "--look-from=..." in one word each, since a leading minus would look like another flag.
std::string cameraFlags(const Session& session) {
    if (session.choices().sceneCamera >= 0) {
        if (session.choices().sceneCamera == 0) return "";
        return fmt::format(" --camera {}", session.choices().sceneCamera);
    }
    const LookAt look = session.cameraControl().lookAt();
    const Scene& scene = session.document().scene();
    std::string flags =
        fmt::format(" --look-from={} --look-at={}", triple(scene, look.eye), triple(scene, look.target));
    return flags + (look.height_m ? fmt::format(" --ortho-height={}", *look.height_m)
                                  : fmt::format(" --fov={}", look.fov_deg));
}

std::string techniqueFlags(Session& session) {
    const Choices& choices = session.choices();
    std::string flags = " -t " + choices.technique;
    const auto parameters = [&](const std::string& name, const std::string& prefix) {
        if (name == referenceName)
            return fmt::format(" --set {}samples={}", prefix, choices.referenceSamples);
        std::string settings;
        for (const auto& [key, value] : session.techniques().changes(name)) {
            settings += fmt::format(" --set {}{}={}", prefix, key, value);
        }
        return settings;
    };
    flags += parameters(choices.technique, "");
    std::vector<std::string> named;
    for (const Light& light : session.document().moment().lights) {
        const std::string name = session.techniqueOf(light);
        if (name == choices.technique) continue;
        flags += " --technique-of " + shellWord(light.name + "=" + name);
        if (std::ranges::count(named, name) != 0) continue;
        named.push_back(name);
        flags += parameters(name, name + ".");
    }
    return flags;
}

std::string shownName(Shown shown) {
    switch (shown) {
        case Shown::picture:
            return "picture";
        case Shown::difference:
            return "difference";
        case Shown::error:
            return "error";
        case Shown::visibility:
            return "visibility";
        case Shown::illuminance:
            return "illuminance";
    }
    return "";
}

Metadata metadataOf(const Session& session, const std::string& command, float exposureValue) {
    const Choices& choices = session.choices();
    const CanvasOptions options = session.canvasOptions();
    return {
        {"Software", "penumbra viewer"},
        {"penumbra:command", command},
        {"penumbra:exposure_ev", fmt::format("{}", exposureValue)},
        {"penumbra:renderer", session.device().renderer()},
        {"penumbra:shown", shownName(choices.shown)},
        {"penumbra:sides", choices.comparing ? choices.technique + " | " + choices.other : choices.technique},
        {"penumbra:range", fmt::format("{} to {}{}", options.range.min, options.range.max,
                                       options.logarithmic ? ", logarithmic" : "")}};
}

}  // namespace

std::string renderCommand(Session& session, const fs::path& folder, PictureSize size) {
    const Document& document = session.document();
    std::string scene = document.nameOrPath();
    std::error_code error;
    if (fs::exists(scene, error)) scene = fs::absolute(scene, error).string();
    std::string line = "penumbra render " + shellWord(scene);
    const OpenOptions& options = document.options();
    if (document.lights().edited()) {
        const fs::path lights = document.lights().snapshot(folder / "lights");
        line += " --lights " + shellWord(lights.string());
    } else if (options.lightsFile) {
        line += " --lights " + shellWord(fs::absolute(*options.lightsFile, error).string());
    }
    if (options.sun && !document.lights().edited()) {
        line += " --sun=" + shellWord(options.sun->text);
        if (options.sun->setting.north_deg != 0)
            line += fmt::format(" --north {}", options.sun->setting.north_deg);
        if (!options.sun->setting.refraction) line += " --no-refraction";
    }
    if (options.scene) line += fmt::format(" --scene {}", *options.scene);
    const ModelReading& reading = options.reading;
    if (reading.up) line += fmt::format(" --up {}", nameOfUpAxis(*reading.up));
    if (reading.unit_m) line += fmt::format(" --unit {}", nameOfUnit(*reading.unit_m));
    if (reading.glass) line += fmt::format(" --glass {}", nameOfGlass(*reading.glass));
    if (options.animations)
        line += options.animations->empty()
                    ? " --animation=-1"
                    : fmt::format(" --animation {}", fmt::join(*options.animations, ","));
    if (document.time_s() != 0) line += fmt::format(" --time {}", document.time_s());
    if (session.choices().exposureValue)
        line += fmt::format(" --exposure={}", *session.choices().exposureValue);
    if (!session.choices().luminairesShown) line += " --luminaires hidden";
    line += cameraFlags(session) + techniqueFlags(session);
    line += fmt::format(" --size {}x{} -o picture.png", size.width_px, size.height_px);
    return line;
}

void savePicture(const Session& session, const Session::KeptPicture& picture, const fs::path& file,
                 const std::string& command) {
    const auto& [side, width, height, exposureValue] = picture;
    if (file.extension() == ".png") {
        writePng(file, readTexture(side.display.name(), width, height, 3),
                 metadataOf(session, command, exposureValue));
    } else if (file.extension() == ".exr") {
        const Image radiance = readTexture(side.radiance.name(), width, height, 3);
        std::vector<ExrChannel> channels = channelsOf(radiance, "");
        const Image lux = readTexture(side.illuminance.name(), width, height, 1);
        channels.push_back({"illuminance", lux.values});
        writeExr(file, {width, height, std::move(channels), metadataOf(session, command, exposureValue)});
    } else {
        throw UsageError(fmt::format("'{}': pictures are .png or .exr", file.string()));
    }
}

void saveCanvas(const Session& session, const fs::path& file, const std::string& command) {
    const gl::Texture& canvas = session.canvas().texture();
    writePng(file, readTexture(canvas.name(), canvas.width_px(), canvas.height_px(), 3),
             metadataOf(session, command, session.exposureValue()));
}

void Recorder::start(const Plan& plan) {
    if (plan.last < plan.first || plan.first < 0 || !(plan.framesPerSecond > 0)) {
        throw UsageError(
            "a recording needs frames from 0 up, the last not before the first, and a positive "
            "number of them a second");
    }
    std::error_code error;
    fs::create_directories(plan.folder, error);
    if (!fs::is_directory(plan.folder, error)) {
        throw OutputError(fmt::format("{}: is no folder and cannot be made one", plan.folder.string()));
    }
    plan_ = plan;
    next_ = plan.first;
    active_ = true;
}

double Recorder::fraction() const {
    return double(next_ - plan_.first) / double(plan_.last - plan_.first + 1);
}

void Recorder::write(Session& session, const std::string& command) {
    active_ = false;  // unless all goes well
    saveCanvas(session, plan_.folder / fmt::format("frame.{:04}.png", next_), command);
    active_ = ++next_ <= plan_.last;
}

}  // namespace penumbra::studio::viewer
