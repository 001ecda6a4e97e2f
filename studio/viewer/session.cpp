// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/session.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "studio/frame/shaders.h"
#include "studio/viewer/light_editing.h"
#include "studio/viewer/shaders.h"

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
                           techniquesOfLights(), techniques_, choices_.light, frame_.readExposureValue(),
                           choices_.luminairesShown);
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
                   choices_.light, choices_.exposureValue, choices_.luminairesShown);
    return {refined_->side(), size.width_px, size.height_px, refined_->exposureValue()};
}

double Session::probeRefined(int attempt) {
    const auto start = Clock::now();
    // Another size each time: of the same picture techniques may have kept what they need.
    refined_->draw(*document_, camera(), width_px_ + attempt, height_px_, techniquesOfLights(), techniques_,
                   choices_.light, frame_.readExposureValue(), choices_.luminairesShown);
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
    frame_.showLuminaires(choices_.luminairesShown);
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
