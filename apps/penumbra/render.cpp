// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/asked_for.h"
#include "apps/penumbra/commands.h"
#include "apps/penumbra/exposure_argument.h"
#include "studio/errors.h"
#include "studio/image/downsample.h"
#include "studio/image/image_io.h"
#include "studio/json_text.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/dark_light.h"
#include "studio/workbench/progress.h"
#include "studio/workbench/reference_technique.h"
#include "studio/workbench/settle.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

/// From a frame in ten days to more than any machine makes.
constexpr double slowest_fps = 1e-6, fastest_fps = 1e6;

/// Of --antialias: 64 samples a pixel.
constexpr int finestAntialias = 8;

/// --frames A-B[xSTEP]
struct FrameRange {
    int first = 0, last = 0, step = 1;
};

FrameRange parseFrames(const std::string& text) {
    FrameRange range;
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto number = [&](int& value) {
        const auto [next, error] = std::from_chars(at, end, value);
        at = next;
        return error == std::errc() && value >= 0;
    };
    const auto skip = [&](char c) { return at != end && *at == c && ++at; };
    bool good = number(range.first) && skip('-') && number(range.last);
    if (good && at != end) good = skip('x') && number(range.step);
    if (!good || at != end || range.step < 1 || range.last < range.first) {
        throw UsageError(
            fmt::format("--frames '{}' is not FIRST-LAST or FIRST-LASTxSTEP, for instance 1-100x2", text));
    }
    return range;
}

/// "out.####.png" -> "out.0007.png"; without '#' the number goes before the extension.
fs::path numbered(const fs::path& path, int frame) {
    std::string name = path.filename().string();
    std::size_t begin = name.find('#');
    std::size_t count = 0;
    if (begin == std::string::npos) {
        begin = name.size() - path.extension().string().size();
        name.insert(begin, ".####");
        ++begin;
    }
    while (begin + count < name.size() && name[begin + count] == '#') ++count;
    return path.parent_path() / name.replace(begin, count, fmt::format("{:0{}}", frame, count));
}

struct RenderArguments {
    SceneArguments scene;
    std::string technique{defaultTechnique()};
    std::string output;
    std::string visibility;
    std::vector<std::string> techniqueOfLight;
    AskedFor askedFor;
    std::vector<std::string> settings;
    ExposureArgument exposure;
    int antialias = 1;
    std::string frames;
    double framesPerSecond = 24;
    bool skipExisting = false;
    bool json = false;
    std::optional<bool> smoothTerminator;
    std::string luminaires = "shown";

    /// Pictures of files are smooth where nothing else was asked; what is measured is not.
    bool isTerminatorSmooth() const {
        return smoothTerminator.value_or(!isBuiltin(scene.scene) && visibility.empty());
    }
};

enum class PictureFormat { png, exr };

PictureFormat formatOf(const fs::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".png") return PictureFormat::png;
    if (extension == ".exr") return PictureFormat::exr;
    throw UsageError(fmt::format("-o '{}': pictures are .png or .exr", path.string()));
}

void writePicture(const fs::path& path, const TechniqueResult& result, const Metadata& metadata) {
    if (formatOf(path) == PictureFormat::png) {
        writePng(path, result.display, metadata);
    } else {
        const Image& radiance = result.radiance;
        writeExr(path, {radiance.width_px, radiance.height_px, channelsOf(radiance, ""), metadata});
    }
}

/// Channel V for one light, LIGHT.V for several; V.R, V.G, V.B for a textured one. That of one light also as
/// Y, or R, G and B, which every program shows.
void writeVisibility(const fs::path& path, const TechniqueResult& result, const Metadata& metadata) {
    ExrPicture picture{result.display.width_px, result.display.height_px, {}, metadata};
    for (const LightResult& light : result.lights) {
        const std::string name = result.lights.size() == 1 ? "V" : light.light + ".V";
        for (ExrChannel& channel : channelsOf(light.visibility, name))
            picture.channels.push_back(std::move(channel));
    }
    if (result.lights.size() == 1) {
        const Image& seen = result.lights.front().visibility;
        for (ExrChannel& channel : channelsOf(seen, seen.channels == 1 ? "Y" : ""))
            picture.channels.push_back(std::move(channel));
    }
    if (picture.channels.empty()) {
        picture.channels.push_back({"V", std::vector<float>(result.display.pixelCount(), 1.0f)});
    }
    writeExr(path, picture);
}

/// The result as if pixels were `factor` times as large.
void downsample(TechniqueResult& result, int factor) {
    result.display = downsampledSrgb(std::move(result.display), factor);
    result.radiance = downsampled(result.radiance, factor);
    for (LightResult& light : result.lights) light.visibility = downsampled(light.visibility, factor);
}

nlohmann::ordered_json statisticsJson(const Statistics& statistics) {
    nlohmann::ordered_json json = {{"counts", nlohmann::json::object()},
                                   {"passes_ms", nlohmann::json::object()}};
    for (const Statistic& count : statistics.counts) json["counts"][std::string(count.name)] = count.value;
    for (const PassTime& pass : statistics.passes)
        json["passes_ms"][std::string(pass.name)] = pass.milliseconds;
    if (const Statistics::Chosen& chosen = statistics.chosen; !chosen.technique.empty()) {
        json["chosen"] = {{"technique", chosen.technique}};
        for (const penumbra::Setting& setting : settingsOf(chosen))
            json["chosen"][std::string(setting.parameter)] = setting.value;
    }
    return json;
}

/// The technique of -t, and those that --technique-of gives to single lights.
class RenderTechniques {
  public:
    RenderTechniques(Workbench& workbench, const RenderArguments& arguments, const std::vector<Light>& lights)
        : main_(parseTechnique(arguments.technique).technique) {
        make(workbench, parseTechnique(arguments.technique));
        for (const std::string& text : arguments.techniqueOfLight) {
            // Both a light's name and a technique's settings may hold '=': the longest name that fits is
            // meant.
            const Light* light = nullptr;
            for (const Light& candidate : lights) {
                if (!text.starts_with(candidate.name + "=")) continue;
                if (light == nullptr || candidate.name.size() > light->name.size()) light = &candidate;
            }
            if (light == nullptr) {
                throw UsageError(
                    fmt::format("--technique-of '{}' is not LIGHT=NAME; the scene's lights are: {}", text,
                                namesOf(lights)));
            }
            const Contender wanted = parseTechnique(text.substr(light->name.size() + 1));
            nameOfLight_[light->name] = wanted.technique;
            make(workbench, wanted);
        }
        for (const auto& [name, technique] : techniques_) {
            for (const auto& [parameter, value] : arguments.askedFor.settingsOf(name))
                setParameter(*technique, parameter, value);
        }
        for (const std::string& setting : arguments.settings) set(setting);
    }

    Technique& main() const { return *techniques_.at(main_); }
    Technique& of(const Light& light) const {
        const auto found = nameOfLight_.find(light.name);
        return found == nameOfLight_.end() ? main() : *techniques_.at(found->second);
    }

  private:
    void make(Workbench& workbench, const Contender& wanted) {
        std::unique_ptr<Technique>& technique = techniques_[wanted.technique];
        if (technique == nullptr) technique = workbench.makeTechnique(wanted.technique);
        for (const auto& [key, value] : wanted.settings) setParameter(*technique, key, value);
    }

    /// "KEY=VALUE" is for the technique of -t, "NAME.KEY=VALUE" for one in use.
    void set(const std::string& text) {
        const Setting setting = parseSetting(text);
        const auto found = techniques_.find(setting.technique.empty() ? main_ : setting.technique);
        if (found == techniques_.end()) {
            throw UsageError(
                fmt::format("--set '{}': no light uses the technique '{}'", text, setting.technique));
        }
        setParameter(*found->second, setting.key, setting.value);
    }

    static std::string namesOf(const std::vector<Light>& lights) {
        std::vector<std::string> names;
        for (const Light& light : lights) names.push_back(light.name);
        return fmt::format("{}", fmt::join(names, ", "));
    }

    std::string main_;
    std::map<std::string, std::string> nameOfLight_;
    std::map<std::string, std::unique_ptr<Technique>> techniques_;
};

class RenderCommand {
  public:
    RenderCommand(const RenderArguments& arguments, const std::string& commandLine)
        : arguments_(arguments), metadata_(pictureMetadata(commandLine)) {}

    void run() {
        const PictureSize size = arguments_.scene.pictureSize();
        checkOutputs();
        const std::optional<float> exposure = arguments_.exposure.value();
        const Scene scene = arguments_.scene.open();
        Workbench workbench(arguments_.scene.device);
        requireSize(workbench, size);
        workbench.frame().setExposure(exposure);
        workbench.frame().setSmoothTerminator(arguments_.isTerminatorSmooth());
        workbench.frame().showLuminaires(arguments_.luminaires == "shown");
        const RenderTechniques techniques(workbench, arguments_, scene.at(arguments_.scene.time_s).lights);
        workbench.open(scene);

        Progress progress(arguments_.technique);
        const FrameRange range = arguments_.frames.empty() ? FrameRange{} : parseFrames(arguments_.frames);
        for (int frame = range.first; frame <= range.last; frame += range.step) {
            const auto outputs = outputsOf(frame);
            if (arguments_.skipExisting && allExist(outputs)) continue;
            const double done = double(frame - range.first) / (range.last - range.first + range.step);
            if (auto* reference = dynamic_cast<ReferenceTechnique*>(&techniques.main())) {
                const double share = double(range.step) / (range.last - range.first + range.step);
                reference->setProgress(
                    [&, done, share](double fraction) { progress.update(done + share * fraction); });
            }
            progress.update(done);
            renderFrame(workbench, techniques, scene, frame, size, outputs);
        }
        if (arguments_.json) std::cout << jsonText(report_);
    }

  private:
    struct Outputs {
        fs::path picture, visibility;
    };

    void requireSize(Workbench& workbench, PictureSize size) const {
        workbench.requireSize(size);
        const int side_px = std::max(size.width_px, size.height_px);
        const int most = workbench.device().maxTextureSize_px() / side_px;
        if (arguments_.antialias > most) {
            throw UsageError(
                fmt::format("--antialias {}: the device makes pictures of this size with at most {}",
                            arguments_.antialias, most));
        }
    }

    void checkOutputs() const {
        for (const std::string& file : {arguments_.output, arguments_.visibility}) {
            if (!file.empty()) requireWritableFolder(fs::path(file).parent_path());
        }
        if (!arguments_.output.empty()) formatOf(arguments_.output);
        if (!arguments_.visibility.empty() && formatOf(arguments_.visibility) != PictureFormat::exr) {
            throw UsageError(
                fmt::format("--visibility '{}': visibility is written as .exr", arguments_.visibility));
        }
        if (arguments_.output.empty() && arguments_.visibility.empty() && !arguments_.json) {
            throw UsageError(
                "nothing to do: ask for a picture (-o), the visibility (--visibility) or --json");
        }
    }

    Outputs outputsOf(int frame) const {
        Outputs outputs{arguments_.output, arguments_.visibility};
        if (arguments_.frames.empty()) return outputs;
        if (!outputs.picture.empty()) outputs.picture = numbered(outputs.picture, frame);
        if (!outputs.visibility.empty()) outputs.visibility = numbered(outputs.visibility, frame);
        return outputs;
    }

    static bool allExist(const Outputs& outputs) {
        return (outputs.picture.empty() || fs::exists(outputs.picture)) &&
               (outputs.visibility.empty() || fs::exists(outputs.visibility));
    }

    void renderFrame(Workbench& workbench, const RenderTechniques& techniques, const Scene& scene, int frame,
                     PictureSize size, const Outputs& outputs) {
        const double time_s =
            arguments_.frames.empty() ? arguments_.scene.time_s : frame / arguments_.framesPerSecond;
        const SceneMoment moment = scene.at(time_s);
        const int factor = arguments_.antialias;
        const PictureSize drawn{size.width_px * factor, size.height_px * factor};
        const auto techniqueOf = [&](const Light& light) -> Technique& { return techniques.of(light); };
        const Camera& camera = arguments_.scene.cameraIn(scene, moment);
        if (!std::exchange(isSettled_, true)) settle(workbench, techniqueOf, moment, camera, drawn);
        TechniqueResult result = workbench.run(arguments_.technique, techniqueOf, moment, camera, drawn);
        warnOfDarkLights(scene, moment, result);
        downsample(result, factor);
        stateExposure(metadata_, result.exposureValue);
        if (!outputs.picture.empty()) writePicture(outputs.picture, result, metadata_);
        if (!outputs.visibility.empty()) writeVisibility(outputs.visibility, result, metadata_);

        nlohmann::ordered_json json = {
            {"scene", arguments_.scene.scene},         {"technique", arguments_.technique},
            {"size", {size.width_px, size.height_px}}, {"time_s", time_s},
            {"exposure_ev", result.exposureValue},     {"luminaires", arguments_.luminaires},
            {"lights", nlohmann::json::array()}};
        for (const LightResult& light : result.lights) {
            json["lights"].push_back(
                {{"light", light.light}, {"statistics", statisticsJson(light.statistics)}});
        }
        if (arguments_.frames.empty()) {
            report_ = std::move(json);
        } else {
            report_.push_back(std::move(json));
        }
    }

    /// Of each light once, however many frames there are.
    void warnOfDarkLights(const Scene& scene, const SceneMoment& moment, const TechniqueResult& result) {
        for (std::size_t i = 0; i < result.lights.size(); ++i) {
            if (!isDark(result.lights[i]) || !darkLights_.insert(result.lights[i].light).second) continue;
            spdlog::warn("light '{}' lights nothing of the picture{}", result.lights[i].light,
                         whyDark(scene, moment, moment.lights[i]));
        }
    }

    /// It would reach what is seen, were nothing in its way.
    static bool isDark(const LightResult& light) {
        const auto channels = std::size_t(light.visibility.channels);
        bool isReached = false;
        for (std::size_t i = 0; i < light.reach.values.size(); ++i) {
            if (!(light.reach.values[i] > 0)) continue;
            isReached = true;
            for (std::size_t k = 0; k < channels; ++k)
                if (light.visibility.values[i * channels + k] > 0) return false;
        }
        return isReached;
    }

    const RenderArguments& arguments_;
    Metadata metadata_;
    std::set<std::string> darkLights_;
    bool isSettled_ = false;  ///< an animation's later frames follow from the first
    nlohmann::ordered_json report_;
};

}  // namespace

void addRender(CLI::App& app, const std::string& commandLine) {
    CLI::App* command = app.add_subcommand("render", "render a picture, its visibility, or an animation");
    auto arguments = std::make_shared<RenderArguments>();
    arguments->scene.addTo(*command);
    command
        ->add_option("-t,--technique", arguments->technique,
                     "NAME, or NAME:KEY=VALUE with a parameter; see 'penumbra list techniques'")
        ->capture_default_str();
    command
        ->add_option("--technique-of", arguments->techniqueOfLight,
                     "LIGHT=NAME: another technique for one light; may be repeated")
        ->take_all();
    command->add_option("-o,--output", arguments->output,
                        "the picture: .png (as shown) or .exr (linear, nits)");
    command->add_option("--visibility", arguments->visibility,
                        "the visibility buffer of each light, as .exr");
    command
        ->add_option("--set", arguments->settings,
                     "KEY=VALUE: a parameter of the technique, NAME.KEY=VALUE of one of --technique-of; may "
                     "be repeated")
        ->take_all();
    arguments->askedFor.addTo(*command);
    arguments->exposure.addTo(*command);
    command
        ->add_option("--antialias", arguments->antialias,
                     "N: the mean of N x N samples of shading and visibility a pixel")
        ->check(CLI::Range(1, finestAntialias))
        ->capture_default_str();
    command
        ->add_option_function<std::string>(
            "--terminator",
            [arguments](const std::string& which) { arguments->smoothTerminator = which == "smooth"; },
            "smooth: no facets of smoothly shaded meshes in their shadows; faceted: as the triangles are; "
            "else "
            "smooth in pictures of files, where no --visibility is asked for")
        ->check(CLI::IsMember({"smooth", "faceted"}));
    command
        ->add_option("--luminaires", arguments->luminaires,
                     "shown: lights that have a size and a place are seen in the picture; hidden: only what "
                     "they light")
        ->check(CLI::IsMember({"shown", "hidden"}))
        ->capture_default_str();
    command->add_option("--frames", arguments->frames,
                        "A-B or A-BxSTEP: an animation, into numbered files (#### in -o)");
    command->add_option("--fps", arguments->framesPerSecond, "frames for each second of the animation")
        ->check(finiteWithin(slowest_fps, fastest_fps, "frames a second"))
        ->capture_default_str();
    command->add_flag("--skip-existing", arguments->skipExisting, "leave out frames whose files are there");
    command->add_flag("--json", arguments->json, "print statistics as JSON");
    command->callback([arguments, commandLine] { RenderCommand(*arguments, commandLine).run(); });
}

}  // namespace penumbra::studio
