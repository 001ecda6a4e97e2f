// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/session.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "studio/frame/shaders.h"
#include "studio/viewer/canvas_io.h"
#include "studio/viewer/light_editing.h"
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

/// Of illuminance: from what a few pixels in a hundred fall below to what next to none exceeds, on nice
/// levels. Where logarithmic at most four decades, else from 0.
ValueRange rangeThatShows(std::vector<float> lux, bool logarithmic) {
    std::erase_if(lux, [](float value) { return !(value > 0) || !std::isfinite(value); });
    if (lux.empty()) return niceRange(0, logarithmic);
    std::ranges::sort(lux);
    const auto at = [&](double share) { return lux[std::size_t(share * double(lux.size() - 1))]; };
    constexpr double low = 0.02, high = 0.995;
    ValueRange range = niceRange(at(high), logarithmic);
    if (!logarithmic) return range;
    constexpr float decades = 1e-4f, narrowest = 0.2f;
    const float least = std::clamp(at(low), decades * range.max, narrowest * range.max);
    const std::vector<float> below = niceLevels(0.1f * least, least);
    range.min = below.empty() ? least : below.back();
    return range;
}

/// A number for each line in about every hundredth part of the picture, so far apart that they can be read.
std::vector<IsolineNumber> numbersOn(const Image& levels) {
    constexpr int parts = 9;
    const int block = std::max({levels.width_px, levels.height_px, parts}) / parts;
    std::vector<IsolineNumber> numbers;
    for (int top = 0; top < levels.height_px; top += block) {
        for (int left = 0; left < levels.width_px; left += block) {
            const glm::vec2 middle(float(left) + 0.5f * float(block), float(top) + 0.5f * float(block));
            std::optional<IsolineNumber> nearest;
            float nearest_px = 0.5f * float(block);
            for (int y = top; y < std::min(top + block, levels.height_px); ++y) {
                for (int x = left; x < std::min(left + block, levels.width_px); ++x) {
                    if (levels.at(x, y) == noIsoline) continue;
                    const float distance_px = glm::distance(middle, glm::vec2(x, y));
                    if (distance_px >= nearest_px) continue;
                    nearest_px = distance_px;
                    nearest = IsolineNumber{x, y, levels.at(x, y)};
                }
            }
            const auto isNear = [&](const IsolineNumber& other) {
                return glm::distance(glm::vec2(other.x, other.y), glm::vec2(nearest->x, nearest->y)) <
                       0.6f * float(block);
            };
            if (nearest && std::ranges::none_of(numbers, isNear)) numbers.push_back(*nearest);
        }
    }
    return numbers;
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
      picker_(device_, shaders_),
      grid_(device_) {}

void Session::open(const std::string& nameOrPath, const OpenOptions& options) {
    auto opened = std::make_unique<Document>(device_, nameOrPath, options);
    for (const std::string& warning : opened->scene().warnings) spdlog::warn("{}", warning);
    reference_.stop();
    document_ = std::move(opened);
    casters_.reset();
    picker_.clear();
    choices_.techniqueOfLight.clear();
    choices_.bookmarks.clear();
    choices_.grid.reset();
    grid_.forget();
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

void Session::keepView() {
    CameraControl view = control_;
    if (choices_.sceneCamera >= 0) view.startFrom(camera(), document_->bounds());
    const auto isTaken = [&](const std::string& name) {
        return std::ranges::count(choices_.bookmarks, name, &Bookmark::name) > 0;
    };
    std::string name;
    for (std::size_t number = choices_.bookmarks.size() + 1; name.empty() || isTaken(name); ++number)
        name = fmt::format("View {}", number);
    choices_.bookmarks.push_back({name, view.lookAt()});
}

void Session::goTo(const Bookmark& bookmark) {
    freeCamera().lookFrom(bookmark.look);
    picker_.clear();
    changedView();
}

SurfacePoint Session::lookedAt() const {
    if (const auto surface = surfaceAt(frame_, width_px_ / 2, height_px_ / 2)) return *surface;
    return {document_->bounds().center(), {0, 1, 0}};
}

void Session::addLight() {
    const SurfacePoint looked = lookedAt();
    const glm::vec3 eye(camera().worldFromCamera[3]);
    constexpr float ofTheWay = 0.5f, leastShare = 1e-3f;
    const float most_m = std::max(document_->bounds().radius(), leastShare);
    const float distance_m =
        std::clamp(ofTheWay * glm::distance(eye, looked.posWorld), leastShare * most_m, most_m);
    std::vector<Light> lights = document_->moment().lights;
    lights.push_back(newLight(looked.posWorld, looked.normalWorld, distance_m));
    choices_.light = lights.size() - 1;
    editLights(std::move(lights));
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
             .parameters = techniques_.allChanges(),
             .bookmarks = choices_.bookmarks,
             .grid = choices_.grid};
    std::erase_if(now.parameters, [](const auto& technique) { return technique.second.empty(); });
    return now;
}

void Session::restore(const Work& work) {
    choices_.technique = work.technique;
    choices_.other = work.other;
    choices_.techniqueOfLight = work.techniqueOfLight;
    choices_.bookmarks = work.bookmarks;
    choices_.grid = work.grid;
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
            refinedSamples_ = 0;
            render(width_px, height_px);
            milliseconds_ = 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
            refiningCost_.drawn(milliseconds_);
        }
        if (picker_.busy()) {
            const auto traced = reference_.scene();
            const std::vector<Light>& lights = document_->moment().lights;
            const std::string first =
                choices_.light < lights.size() ? techniqueOf(lights[choices_.light]) : choices_.technique;
            picker_.step(frame_, sides_.side(0), *document_, choices_.light, first, techniques_,
                         traced.get());
        }
        grid_.update(*document_, choices_.grid, handsMove_);
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

void Session::refine(int width_px, int height_px, double budget_ms) {
    if (canvasStale_ || !problem_.empty() || isRefined() || choices_.shown != Shown::picture ||
        showsOther() || showsTruth(0))
        return;
    try {
        if (!refined_) refined_ = std::make_unique<RefinedPicture>(device_, shaderSourceDirectory_);
        const double pixels = double(width_px) * height_px / (double(width_px_) * height_px_);
        for (const int perAxis : {RefinedPicture::mostSamplesPerAxis, 1}) {
            const bool isFiner = perAxis * width_px > width_px_;
            const bool fits = perAxis * std::max(width_px, height_px) <= device_.maxTextureSize_px();
            const int samples = perAxis * perAxis;
            const auto probe = [&](int attempt) { return probeRefined(attempt); };
            if (!isFiner || !fits || !refiningCost_.isWithin(budget_ms, pixels * samples, probe)) continue;
            refined_->draw(*document_, camera(), perAxis * width_px, perAxis * height_px,
                           techniquesOfLights(), techniques_, choices_.light, frame_.readExposureValue());
            refinedSamples_ = samples;
            return;
        }
    } catch (const std::exception& error) {
        problem_ = error.what();
    }
}

Session::KeptPicture Session::drawToKeep(PictureSize size) {
    if ((size.width_px == width_px_ && size.height_px == height_px_) || showsTruth(0))
        return {sides_.side(0), width_px_, height_px_, frame_.readExposureValue()};
    if (!refined_) refined_ = std::make_unique<RefinedPicture>(device_, shaderSourceDirectory_);
    refinedSamples_ = 0;
    refined_->draw(*document_, camera(), size.width_px, size.height_px, techniquesOfLights(), techniques_,
                   choices_.light, choices_.exposureValue);
    return {refined_->side(), size.width_px, size.height_px, refined_->exposureValue()};
}

double Session::probeRefined(int attempt) {
    const auto start = Clock::now();
    // Another size each time: of the same picture techniques may have kept what they need.
    refined_->draw(*document_, camera(), width_px_ + attempt, height_px_, techniquesOfLights(), techniques_,
                   choices_.light, frame_.readExposureValue());
    glFinish();
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
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
                    : fittedLux_.value_or(niceRange(0, choices_.logarithmic));
            break;
    }
    return options;
}

void Session::compose() {
    const Side& a = sides_.side(0);
    const Side& b = showsOther() ? sides_.side(1) : a;
    if (choices_.shown == Shown::illuminance && choices_.largestLux <= 0 && !fittedLux_)
        fittedLux_ = rangeThatShows(readTexture(a.illuminance.name(), width_px_, height_px_, 1).values,
                                    choices_.logarithmic);
    canvas_.compose(frame_, a, b, canvasOptions());
    numberIsolines();
}

void Session::numberIsolines() {
    isolineNumbers_.clear();
    if (choices_.shown != Shown::illuminance || !choices_.isolines) return;
    const Image levels = readTexture(canvas_.isolines().name(), width_px_, height_px_, 1);
    isolineNumbers_ = numbersOn(levels);
}

bool Session::isCertain(double error) const {
    constexpr double share = 0.1;
    return truth_ && choices_.light < truth_->lights.size() &&
           truth_->lights[choices_.light].noise_rms < share * error;
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
