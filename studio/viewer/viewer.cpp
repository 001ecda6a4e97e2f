// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/viewer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "studio/errors.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/scene/profiles/profile_file.h"

#include <GLFW/glfw3.h>

namespace penumbra::studio::viewer {
namespace {

constexpr std::size_t frameHistory = 240;
constexpr float panelWidth = 330;
constexpr double messageTime_s = 6;

/// Without an argument: balls, boxes and tori under a large light.
constexpr const char* welcomeScene = "primitives";

void applySettings(const Settings& settings, Session& session) {
    Choices& choices = session.choices();
    const bool software = session.device().isSoftware();
    const std::vector<std::string> names = techniqueChoices();
    const auto known = [&](const std::string& name) { return std::ranges::count(names, name) != 0; };
    if (known(settings.technique)) choices.technique = settings.technique;
    if (known(settings.other)) choices.other = settings.other;
    choices.resolutionScale = settings.resolutionScale > 0 ? settings.resolutionScale
                              : software                   ? 0.5f
                                                           : 1.0f;
    choices.referenceSamples = settings.referenceSamples;
    choices.referenceRuns = settings.referenceRuns;
    for (const auto& [name, values] : settings.parameters) {
        if (known(name) && name != referenceName) session.techniques().set(name, values);
    }
}

}  // namespace

Viewer::Viewer(ViewerOptions options)
    : options_(std::move(options)),
      settings_(loadSettings(options_.settings)),
      window_({.width = settings_.width, .height = settings_.height}),
      session_(options_.shaderSourceDirectory),
      ui_(window_.contentScale()),
      shaderWatch_(options_.shaderSourceDirectory) {
    applySettings(settings_, session_);
    windowState_.showsWelcome = options_.scene.empty();
    session_.open(options_.scene.empty() ? welcomeScene : options_.scene, options_.open);
    startAsAsked();
    session_.choices().bookmarks = settings_.bookmarks[openFile().scene];
    history_.start(session_.work());
    if (!options_.scene.empty()) follow();
}

RecentFile Viewer::openFile() const {
    const Document& document = session_.document();
    const auto absolute = [](const std::string& file) {
        std::error_code error;
        const std::filesystem::path path = std::filesystem::canonical(file, error);
        return error ? file : path.string();
    };
    RecentFile file{document.isBuiltin() ? document.nameOrPath() : absolute(document.nameOrPath()), ""};
    if (document.options().lightsFile) file.lights = absolute(document.options().lightsFile->string());
    return file;
}

void Viewer::follow() {
    settings_.addRecent(openFile());
}

std::string Viewer::title() const {
    const Document& document = session_.document();
    std::string title = "Penumbra - " + document.nameOrPath();
    if (document.options().lightsFile)
        title += fmt::format(" with {}", document.options().lightsFile->filename().string());
    return document.lights().unsaved() ? title + " *" : title;
}

void Viewer::startAsAsked() {
    if (!options_.technique.empty()) {
        chooseTechnique(session_, options_.technique);
        if (options_.technique != referenceName) {
            Technique& technique = session_.techniques().get(options_.technique);
            for (const auto& [key, value] : options_.parameters) setParameter(technique, key, value);
        }
    }
    if (options_.time_s != 0) session_.setTime(options_.time_s);
    if (!options_.camera) return;
    const Document& document = session_.document();
    const Camera wanted = options_.camera(document.scene(), document.moment());
    const auto isWanted = [&](const Camera& camera) {
        return camera.name == wanted.name && camera.worldFromCamera == wanted.worldFromCamera;
    };
    const std::vector<Camera>& cameras = document.moment().cameras;
    const auto found = std::ranges::find_if(cameras, isWanted);
    if (found != cameras.end()) return session_.useSceneCamera(int(found - cameras.begin()));
    session_.freeCamera().startFrom(wanted, document.bounds());
    session_.changedView();
}

Viewer::~Viewer() {
    if (options_.keepsSettings) keepSettings();
}

void Viewer::keepSettings() {
    const Choices& choices = session_.choices();
    settings_.bookmarks.erase(openFile().scene);
    if (!choices.bookmarks.empty()) settings_.bookmarks[openFile().scene] = choices.bookmarks;
    settings_.technique = choices.technique;
    settings_.other = choices.other;
    settings_.resolutionScale = choices.resolutionScale;
    settings_.referenceSamples = choices.referenceSamples;
    settings_.referenceRuns = choices.referenceRuns;
    for (const auto& [name, values] : session_.techniques().allChanges()) {
        settings_.parameters.erase(name);
        if (!values.empty()) settings_.parameters[name] = values;
    }
    if (window_.width_px() > 0) window_.size(settings_.width, settings_.height);
    try {
        saveSettings(settings_, options_.settings);
    } catch (const std::exception& error) {
        spdlog::warn("the settings are not kept: {}", error.what());
    }
}

void Viewer::say(const std::string& message, bool isError) {
    windowState_.message = message;
    windowState_.messageIsError = isError;
    windowState_.messageUntil_s = isError ? 1e30 : glfwGetTime() + messageTime_s;
    if (isError) spdlog::error("{}", message);
}

template <typename Action>
void Viewer::attempt(const Action& action) {
    try {
        action();
    } catch (const std::exception& error) {
        say(error.what(), true);
    }
}

bool Viewer::frame(bool wait) {
    // While only rays are traced, frames shall not take the processors away from them.
    const bool active =
        mouse_.busy() || windowState_.playing || recorder_.active() || session_.picker().busy();
    window_.pollEvents(!wait || active ? 0 : session_.busy() ? 0.1 : 0.25);
    if (window_.closeRequested()) {
        if (!session_.document().lights().unsaved()) return false;
        window_.cancelClose();
        keyRequests_.quit = true;
    }
    if (window_.width_px() == 0 || window_.height_px() == 0) return true;  // minimised

    takeFiles();
    window_.beginFrame();
    ui_.begin();
    takeKeys();
    advanceTime();
    if (shaderWatch_.changed()) session_.reloadShaders();
    Requests requests = std::exchange(keyRequests_, {});
    drawPanels(requests);
    mouse_.update(place_, window_, session_, windowState_, ui_.scale());
    carryOut(requests);
    if (!mouse_.busy() && !ImGui::IsAnyItemActive()) history_.note(session_.work());
    windowState_.canUndo = history_.canUndo();
    windowState_.canRedo = history_.canRedo();
    if (const std::string now = title(); now != shownTitle_) {
        shownTitle_ = now;
        window_.setTitle(now);
    }
    updatePicture();
    record();
    drawCanvas();
    drawOverlay();
    window_.draw();
    window_.show();
    return true;
}

void Viewer::open(const std::string& nameOrPath, const std::string& lights) {
    attempt([&] {
        OpenOptions options;
        if (!lights.empty()) options.lightsFile = lights;
        const RecentFile before = openFile();
        const std::vector<Bookmark> bookmarks = session_.choices().bookmarks;
        session_.open(nameOrPath, options);
        settings_.bookmarks[before.scene] = bookmarks;
        session_.choices().bookmarks = settings_.bookmarks[openFile().scene];
        history_.start(session_.work());
        follow();
        windowState_.playing = false;
        const std::vector<std::string>& warnings = session_.document().scene().warnings;
        say(warnings.empty() ? "opened " + nameOrPath : fmt::format("{}", fmt::join(warnings, "\n")));
    });
}

void Viewer::loadProfile(const std::string& file) {
    attempt([&] {
        std::vector<Light> lights = session_.document().moment().lights;
        const std::size_t chosen = session_.choices().light;
        if (chosen >= lights.size()) throw InputError("there is no light to be that luminaire: add one");
        if (lights[chosen].shape.shape == LightShape::distant)
            throw InputError(
                fmt::format("'{}' is a distant light, which is no luminaire: choose another shape or "
                            "light, then load {}",
                            lights[chosen].name, file));
        const std::string note = makeLuminaire(std::make_shared<const LightProfile>(readProfile(file)), 0,
                                               glm::vec3(1), lights[chosen]);
        session_.editLights(std::move(lights));
        say(note.empty() ? "loaded " + file : note);
    });
}

void Viewer::loadTexture(const std::string& file) {
    attempt([&] {
        std::vector<Light> lights = session_.document().moment().lights;
        const std::size_t chosen = session_.choices().light;
        if (chosen >= lights.size() || lights[chosen].shape.shape != LightShape::rect)
            throw InputError("a picture is shown by a rectangle: choose such a light");
        lights[chosen].texture = session_.document().addTexture(file);
        session_.editLights(std::move(lights));
        say("loaded " + file);
    });
}

void Viewer::takeFiles() {
    const std::vector<std::filesystem::path> files = window_.takeDroppedFiles();
    if (files.empty()) return;
    if (isProfileName(files.front())) return loadProfile(files.front().string());
    keyRequests_.open = files.front().string();
}

void Viewer::advanceTime() {
    const double now_s = glfwGetTime();
    const double elapsed_s = now_s - std::exchange(playedAt_s_, now_s);
    if (!recorder_.active()) recordedTime_s_.reset();
    if (recorder_.active()) {
        if (recordedTime_s_ != recorder_.time_s()) session_.setTime(recorder_.time_s());
        recordedTime_s_ = recorder_.time_s();
        return;
    }
    const double duration_s = session_.document().duration_s();
    if (!windowState_.playing || duration_s <= 0) return;
    session_.setTime(std::fmod(session_.document().time_s() + std::min(elapsed_s, 0.25), duration_s));
}

void Viewer::drawPanels(Requests& requests) {
    drawMenuBar(ui_, session_, settings_, windowState_, requests);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float top = ImGui::GetFrameHeight();
    const float width = windowState_.showsPanel ? std::min(panelWidth * ui_.scale(), 0.5f * display.x) : 0;
    place_ = {{width, top}, {std::max(1.0f, display.x - width), std::max(1.0f, display.y - top)}};
    if (windowState_.showsPanel) {
        ImGui::SetNextWindowPos({0, top});
        ImGui::SetNextWindowSize({width, place_.size.y});
        ImGui::Begin("panel", nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoBringToFrontOnFocus);
        drawAnimationPanel(ui_, session_, windowState_, recorder_, requests);
        drawLightsPanel(ui_, session_, windowState_, requests);
        drawColorsPanel(ui_, session_);
        drawMeasurePanel(ui_, session_, windowState_);
        drawTechniquePanel(ui_, session_, settings_, windowState_);
        drawComparePanel(ui_, session_);
        drawInsightPanel(ui_, session_, windowState_, frameTimes_ms_);
        ImGui::End();
    }
    drawHelp(ui_, windowState_);
    windowState_.browser.draw(ui_, requests);
    drawLeavingDialog(requests);
}

void Viewer::drawLeavingDialog(Requests& requests) {
    constexpr const char* title = "Lights are not saved";
    const bool leaves = requests.quit || requests.open;
    if (leaves && session_.document().lights().unsaved()) {
        windowState_.leaving = std::exchange(requests, {});
        ImGui::OpenPopup(title);
    }
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
    ui_.note("The lights of " + session_.document().nameOrPath() + " have changes that no file holds.");
    const bool saves = ui_.button("Save lights and go on");
    ImGui::SameLine();
    const bool drops = ui_.button("Drop the changes");
    ImGui::SameLine();
    const bool stays = ui_.button("Stay");
    if ((saves && saveLights()) || drops) {
        if (drops) session_.revertLights();
        requests = windowState_.leaving.value();
    }
    if (saves || drops || stays) {
        windowState_.leaving.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

std::filesystem::path Viewer::freshPictureName() const {
    const std::string stem = std::filesystem::path(session_.document().nameOrPath()).stem().string();
    const bool isBuiltin = session_.document().isBuiltin();
    const std::filesystem::path folder =
        isBuiltin ? options_.pictures : std::filesystem::path(openFile().scene).parent_path();
    for (int number = 1;; ++number) {
        std::filesystem::path file = folder / fmt::format("{}.{:03}.png", stem, number);
        if (!std::filesystem::exists(file)) return file;
    }
}

bool Viewer::saveLights() {
    attempt([&] {
        const std::string file = session_.document().saveLights().string();
        const bool found = !session_.document().sidecar().empty();
        say(fmt::format("lights saved to {}{}", file,
                        found ? "" : "; --lights " + file + " shows them again"));
    });
    return !session_.document().lights().unsaved();
}

void Viewer::saveLightsAs(const std::string& file) {
    attempt([&] {
        session_.document().saveLightsAs(file);
        follow();
        say("lights saved to " + file);
    });
}

void Viewer::undo(const Requests& requests) {
    if (requests.undo && history_.canUndo()) session_.restore(history_.undo());
    if (requests.redo && history_.canRedo()) session_.restore(history_.redo());
}

void Viewer::carryOut(const Requests& requests) {
    undo(requests);
    if (requests.quit) window_.requestClose();
    if (requests.open) open(*requests.open, requests.openLights);
    if (requests.profile) loadProfile(*requests.profile);
    if (requests.texture) loadTexture(*requests.texture);
    if (requests.addLight) session_.addLight();
    if (requests.keepView) {
        session_.keepView();
        say(fmt::format("kept as {}, under Camera", session_.choices().bookmarks.back().name));
    }
    if (requests.problem) say(*requests.problem);
    if (requests.frameAll) {
        session_.freeCamera().frame(session_.document().bounds(), place_.size.x / place_.size.y);
        session_.changedView();
    }
    if (requests.resetCamera) session_.useSceneCamera(0);
    if (requests.reloadShaders) session_.reloadShaders();
    if (requests.saveLights) saveLights();
    if (requests.saveGrid) {
        attempt([&] {
            session_.grid().save(session_.document(), *requests.saveGrid);
            say("saved " + *requests.saveGrid);
        });
    }
    if (requests.saveLightsAs) saveLightsAs(*requests.saveLightsAs);
    takeAway(requests);
    if (requests.record) {
        attempt([&] {
            recorder_.start(windowState_.recording);
            windowState_.playing = false;
        });
    }
    if (requests.stopRecording) recorder_.stop();
}

void Viewer::takeAway(const Requests& requests) {
    if (requests.copyCommand) {
        attempt([&] {
            window_.setClipboard(renderCommand(session_, options_.data, keptSize()));
            say("copied: the command for this picture");
        });
    }
    if (requests.savePicture || requests.saveCanvas) {
        attempt([&] {
            restoreResolution();
            const std::filesystem::path file = freshPictureName();
            const std::string command = renderCommand(session_, options_.data, keptSize());
            if (requests.saveCanvas) {
                saveCanvas(session_, file, command);
            } else {
                const Session::KeptPicture picture = session_.drawToKeep(keptSize());
                savePicture(session_, picture, file, command);
                savePicture(session_, picture, std::filesystem::path(file).replace_extension(".exr"),
                            command);
            }
            say("saved " + file.string());
        });
    }
}

void Viewer::updatePicture() {
    // While hands move and frames are late, the resolution gives way; at rest it is what was chosen.
    const bool moving = mouse_.busy() || windowState_.playing;
    session_.setHandsMove(moving || ImGui::IsAnyItemActive());
    const double now_s = glfwGetTime();
    if (moving) movedAt_s_ = now_s;
    const float before = slowDown_;
    if (recorder_.active() || (!moving && now_s - movedAt_s_ > 0.25)) slowDown_ = 1;
    const bool drawn = drawPicture();
    constexpr double smallest = 0.3, settling_s = 0.5;
    if (moving || drawn) drawnAt_s_ = now_s;
    if (!moving && !recorder_.active() && slowDown_ == 1 && now_s - drawnAt_s_ > settling_s) {
        const float full = window_.pixelsPerCoordinate();
        session_.refine(int(std::lround(place_.size.x * full)), int(std::lround(place_.size.y * full)),
                        options_.refine_ms);
    }
    if (drawn) {
        frameTimes_ms_.push_back(float(session_.milliseconds()));
        if (frameTimes_ms_.size() > frameHistory) frameTimes_ms_.erase(frameTimes_ms_.begin());
    }
    if (moving && drawn && before == slowDown_ && session_.milliseconds() > options_.late_ms &&
        slowDown_ > smallest) {
        slowDown_ *= 0.7f;
    }
}

bool Viewer::drawPicture() {
    const float scale = session_.choices().resolutionScale * window_.pixelsPerCoordinate() * slowDown_;
    return session_.update(int(std::lround(place_.size.x * scale)), int(std::lround(place_.size.y * scale)));
}

PictureSize Viewer::keptSize() const {
    if (settings_.pictureWidth_px > 0 && settings_.pictureHeight_px > 0 && !session_.showsTruth())
        return {settings_.pictureWidth_px, settings_.pictureHeight_px};
    const bool asShown = settings_.pictureWidth_px < 0 || session_.showsTruth();
    const float scale = window_.pixelsPerCoordinate() * (asShown ? session_.choices().resolutionScale : 1);
    return {std::max(int(std::lround(place_.size.x * scale)), 1),
            std::max(int(std::lround(place_.size.y * scale)), 1)};
}

void Viewer::restoreResolution() {
    slowDown_ = 1;
    drawPicture();
}

void Viewer::record() {
    if (!recorder_.active() || !session_.complete()) return;
    attempt([&] {
        recorder_.write(session_,
                        renderCommand(session_, options_.data, {session_.width_px(), session_.height_px()}));
        if (!recorder_.active()) say("recorded to " + recorder_.plan().folder.string());
    });
}

}  // namespace penumbra::studio::viewer
