// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/session.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "studio/frame/shaders.h"
#include "studio/viewer/shaders.h"
#include "studio/workbench/reference_inputs.h"

namespace penumbra::studio::viewer {
namespace {

/// The truth waits until hands have come to rest, so that a drag does not read the device back at every step.
constexpr auto settling = std::chrono::milliseconds(150);

gl::ShaderLibrary makeShaders(const std::filesystem::path& sourceDirectory) {
    gl::ShaderLibrary shaders(sourceDirectory);
    shaders.add(frameShaders());  // the shapes of lights are theirs
    shaders.add(viewerShaders());
    return shaders;
}

class Collector final : public InspectionVisitor {
  public:
    void texture(const InspectedTexture& texture) override { textures.push_back(texture); }
    std::vector<InspectedTexture> textures;
};

}  // namespace

Session::Session(const std::filesystem::path& shaderSourceDirectory)
    : device_({.log = logFromDevice, .shaderSourceDirectory = shaderSourceDirectory}),
      shaders_(makeShaders(shaderSourceDirectory)),
      frame_(device_, shaderSourceDirectory),
      techniques_(device_),
      sides_(device_, frame_),
      canvas_(shaders_),
      inspection_(shaders_),
      shaderSourceDirectory_(shaderSourceDirectory),
      picker_(device_, shaders_) {}

void Session::open(const std::string& nameOrPath, const OpenOptions& options) {
    auto opened = std::make_unique<Document>(device_, nameOrPath, options);
    for (const std::string& warning : opened->scene().warnings) spdlog::warn("{}", warning);
    reference_.stop();
    document_ = std::move(opened);
    casters_.reset();
    picker_.clear();
    choices_.techniqueOfLight.clear();
    choices_.light = 0;
    fitIlluminance();
    useSceneCamera(0);
    problem_.clear();
}

Camera Session::camera() const {
    const std::vector<Camera>& cameras = document_->moment().cameras;
    if (choices_.sceneCamera < 0) return lookAtCamera(control_.lookAt());
    return cameras[std::min(std::size_t(choices_.sceneCamera), cameras.size() - 1)];
}

CameraView Session::cameraView() const {
    return makeCameraView(camera(), document_->moment().bounds, std::max(width_px_, 1),
                          std::max(height_px_, 1));
}

CameraControl& Session::freeCamera() {
    if (choices_.sceneCamera >= 0) {
        control_.startFrom(camera(), document_->bounds());
        choices_.sceneCamera = -1;
    }
    return control_;
}

void Session::useSceneCamera(int index) {
    choices_.sceneCamera = index;
    picker_.clear();
    changedView();
}

void Session::setTime(double time_s) {
    document_->setTime(time_s);
    changedView();
}

void Session::editLights(std::vector<Light> lights) {
    document_->editLights(std::move(lights));
    choices_.light =
        std::min(choices_.light, std::max<std::size_t>(document_->moment().lights.size(), 1) - 1);
    changedView();
}

void Session::revertLights() {
    document_->revertLights();
    choices_.light = 0;
    changedView();
}

Work Session::work() {
    Work now{.lights = document_->lights().state(),
             .light = choices_.light,
             .technique = choices_.technique,
             .other = choices_.other,
             .techniqueOfLight = choices_.techniqueOfLight,
             .parameters = techniques_.allChanges()};
    std::erase_if(now.parameters, [](const auto& technique) { return technique.second.empty(); });
    return now;
}

void Session::restore(const Work& work) {
    choices_.technique = work.technique;
    choices_.other = work.other;
    choices_.techniqueOfLight = work.techniqueOfLight;
    for (const auto& [name, values] : techniques_.allChanges()) {
        if (!work.parameters.contains(name)) techniques_.set(name, {});
    }
    for (const auto& [name, values] : work.parameters) techniques_.set(name, values);
    choices_.light = work.light;
    if (work.lights == document_->lights().state()) return changedLighting();
    document_->restoreLights(work.lights);
    changedView();
}

void Session::changedView() {
    viewStale_ = true;
    referenceStale_ = true;
    truth_.reset();
    reference_.stop();
    changedAt_ = Clock::now();
    changedLighting();
}

void Session::changedLighting() {
    sideStale_ = {true, true};
    picker_.restart();
    changedCanvas();
}

bool Session::wantsTruth() const {
    return choices_.referenceRuns || showsTruth(0) || (showsOther() && showsTruth(1)) ||
           picker_.result().has_value();
}

bool Session::showsOther() const {
    return choices_.comparing || choices_.flipped || choices_.shown == Shown::difference ||
           choices_.shown == Shown::error;
}

bool Session::busy() const {
    return (referenceStale_ && wantsTruth()) || picker_.busy() || reference_.status().working;
}

std::string Session::techniqueOf(const Light& light) const {
    const auto own = choices_.techniqueOfLight.find(light.name);
    return own == choices_.techniqueOfLight.end() ? choices_.technique : own->second;
}

bool Session::update(int width_px, int height_px) {
    if (!document_) return false;
    const int limit = device_.maxTextureSize_px();
    width_px = std::clamp(width_px, 1, limit);
    height_px = std::clamp(height_px, 1, limit);
    if (width_px != width_px_ || height_px != height_px_) {
        width_px_ = width_px;
        height_px_ = height_px;
        picker_.clear();
        changedView();
    }
    try {
        const auto start = Clock::now();
        takeTruth();
        const bool changed = canvasStale_;
        if (changed) {
            isRefined_ = false;
            render(width_px, height_px);
            milliseconds_ = 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
        }
        if (picker_.busy()) {
            const auto traced = reference_.scene();
            picker_.step(frame_, sides_.side(0), *document_, choices_.light, techniques_, traced.get());
        }
        if (referenceStale_ && wantsTruth() && Clock::now() - changedAt_ >= settling) startReference();
        return changed;
    } catch (const std::exception& error) {
        problem_ = error.what();
        viewStale_ = canvasStale_ = false;  // trying again will not help until something changes
        sideStale_ = {false, false};
        referenceStale_ = false;
        picker_.clear();
        return true;
    }
}

bool Session::refine() {
    const bool fits =
        RefinedPicture::samplesPerAxis * std::max(width_px_, height_px_) <= device_.maxTextureSize_px();
    if (canvasStale_ || !problem_.empty() || !fits || choices_.shown != Shown::picture || showsOther() ||
        showsTruth(0))
        return false;
    try {
        if (!refined_) refined_ = std::make_unique<RefinedPicture>(device_, shaderSourceDirectory_);
        refined_->draw(*document_, camera(), width_px_, height_px_, techniquesOfLights(), techniques_,
                       choices_.light, frame_.readExposureValue());
        isRefined_ = true;
    } catch (const std::exception& error) {
        problem_ = error.what();
    }
    return isRefined_;
}

void Session::render(int width_px, int height_px) {
    if (viewStale_) sides_.draw(*document_, camera(), width_px, height_px);
    viewStale_ = false;
    lightSides();
    compose();
    glFinish();
    canvasStale_ = false;
    problem_.clear();
}

std::vector<std::string> Session::techniquesOfLights() const {
    std::vector<std::string> names;
    for (const Light& light : document_->moment().lights) names.push_back(techniqueOf(light));
    return names;
}

void Session::lightSides() {
    frame_.setExposure(choices_.exposureValue);
    const std::vector<Light>& lights = document_->moment().lights;
    const bool judged = sideStale_[0] || (sideStale_[1] && showsOther());
    // B before A: what can be inspected is of A.
    if (sideStale_[1] && showsOther()) {
        const std::vector<std::string> names(lights.size(), choices_.other);
        sides_.light(1, *document_, names, techniques_, truth_.get(), choices_.light);
        sideStale_[1] = false;
    }
    if (sideStale_[0]) {
        sides_.light(0, *document_, techniquesOfLights(), techniques_, truth_.get(), choices_.light);
        sideStale_[0] = false;
    }
    if (judged) judge();
}

void Session::startReference() {
    referenceStale_ = false;
    if (!casters_ || castersRevision_ != document_->castersRevision()) {
        casters_ = std::make_shared<const CasterCopies>(document_->gpuScene().casters());
        castersRevision_ = document_->castersRevision();
    }
    ProgressiveReference::Request request{.casters = casters_,
                                          .receivers = readReceivers(frame_.gbuffer().view()),
                                          .maxSamples = choices_.referenceSamples};
    for (const Light& light : document_->moment().lights) {
        const ShadowInputs inputs = frame_.shadowInputs(light);
        request.lights.push_back(
            {inputs.light, readRadianceTexture(inputs.light.radianceTexture), light.castsShadow});
    }
    reference_.start(std::move(request));
}

bool Session::showsTruth(std::size_t side) const {
    const std::vector<LightStatistics>& lights = sides_.side(side).statistics;
    return std::ranges::count(lights, referenceName, &LightStatistics::technique) != 0;
}

bool Session::complete() const {
    const bool needsTruth = showsTruth(0) || (showsOther() && showsTruth(1));
    return !canvasStale_ && (!needsTruth || (truth_ && truth_->samples == choices_.referenceSamples));
}

void Session::takeTruth() {
    auto best = reference_.best();
    if (best == truth_ || !best) return;
    truth_ = std::move(best);
    for (std::size_t side = 0; side < 2; ++side) {
        if (!showsTruth(side)) continue;
        sideStale_[side] = true;
        canvasStale_ = true;
    }
    judge();
}

void Session::judge() {
    metrics_ = {};
    if (!truth_ || choices_.light >= truth_->lights.size()) return;
    const Image& truth = truth_->lights[choices_.light].visibility;
    for (std::size_t i = 0; i < 2; ++i) {
        const Side& side = sides_.side(i);
        if (sideStale_[i] || choices_.light >= side.visibilities.size()) continue;
        if (side.statistics[choices_.light].technique == referenceName) continue;
        const Image reach = readTexture(side.reach.name(), width_px_, height_px_, 1);
        std::vector<std::uint8_t> reached;
        for (const float irradiance : reach.values) reached.push_back(irradiance > 0);
        const VisibilityBuffer& visibility = side.visibilities[choices_.light];
        metrics_[i] = compareVisibility(truth, frame_.readVisibility(visibility), reached);
    }
}

CanvasOptions Session::canvasOptions() const {
    CanvasOptions options{.shown = choices_.shown, .isolines = choices_.isolines, .light = choices_.light};
    if (choices_.comparing) options.firstColumnOfB = int(std::lround(choices_.wipe * float(width_px_)));
    if (choices_.flipped) options.firstColumnOfB = 0;
    switch (choices_.shown) {
        case Shown::picture:
        case Shown::visibility:
            break;
        case Shown::difference:
        case Shown::error:
            options.range.max = choices_.differenceRange;
            break;
        case Shown::illuminance:
            options.logarithmic = choices_.logarithmic;
            options.range =
                choices_.largestLux > 0
                    ? ValueRange{choices_.logarithmic ? 1e-3f * choices_.largestLux : 0, choices_.largestLux}
                    : niceRange(largestIlluminance_lux_, choices_.logarithmic);
            break;
    }
    return options;
}

void Session::compose() {
    const Side& a = sides_.side(0);
    const Side& b = showsOther() ? sides_.side(1) : a;
    if (choices_.shown == Shown::illuminance && choices_.largestLux <= 0 && largestIlluminance_lux_ <= 0) {
        const Image lux = readTexture(a.illuminance.name(), width_px_, height_px_, 1);
        largestIlluminance_lux_ = std::ranges::max(lux.values);
    }
    canvas_.compose(frame_, a, b, canvasOptions());
}

std::vector<InspectedTexture> Session::inspected() {
    Collector collector;
    const Side& a = sides_.side(0);
    if (choices_.light < a.visibilities.size()) {
        collector.texture({.name = "visibility", .texture = a.visibilities[choices_.light].texture()});
        collector.texture({.name = "reach (unshadowed irradiance)", .texture = a.reach.name()});
    }
    const GBuffer& gbuffer = frame_.gbuffer();
    collector.texture({.name = "normals", .texture = gbuffer.view().normalTexture, .black = -1});
    collector.texture({.name = "albedo", .texture = gbuffer.albedo().name()});
    collector.texture({.name = "depth (reversed)", .texture = gbuffer.view().depthTexture});
    if (choices_.light < a.statistics.size()) {
        const std::string& name = a.statistics[choices_.light].technique;
        if (name != referenceName) techniques_.get(name).inspect(collector);
    }
    return collector.textures;
}

void Session::inspect(const InspectedTexture& texture, int layer, bool stretched) {
    inspection_.inspect(texture, std::clamp(layer, 0, texture.layers - 1), stretched);
}

void Session::reloadShaders() {
    std::string failures;
    for (const std::function<void()>& reload :
         {std::function([&] { device_.reloadShaders(); }), std::function([&] { frame_.reloadShaders(); }),
          std::function([&] { shaders_.reload(); }), std::function([&] {
              if (refined_) refined_->reloadShaders();
          })}) {
        try {
            reload();
        } catch (const Error& error) {
            failures += error.what();
        }
    }
    if (failures.empty()) techniques_.forget();  // maps that they kept are of the shaders before
    changedView();
    shaderProblem_ = failures;
}

}  // namespace penumbra::studio::viewer
