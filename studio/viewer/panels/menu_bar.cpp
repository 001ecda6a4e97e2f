// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "studio/scene/builtin/builtin.h"
#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

/// Size of pictures that are saved, and that commands render.
void drawPictureSizes(Ui& ui, Settings& settings) {
    if (!ui.beginMenu("Size of pictures")) return;
    const auto item = [&](const char* label, int width_px, int height_px) {
        if (!ui.menuItem(label, nullptr,
                         settings.pictureWidth_px == width_px && settings.pictureHeight_px == height_px))
            return;
        settings.pictureWidth_px = width_px;
        settings.pictureHeight_px = height_px;
    };
    item("The window's, in full", 0, 0);
    item("As shown at rest", -1, -1);
    item("1280 x 720", 1280, 720);
    item("1920 x 1080", 1920, 1080);
    item("3840 x 2160", 3840, 2160);
    ImGui::EndMenu();
}

void drawFileMenu(Ui& ui, Session& session, Settings& settings, WindowState& windowState,
                  Requests& requests) {
    if (!ui.beginMenu("File")) return;
    if (ui.menuItem("Open...", "Ctrl+O")) windowState.browser.open(FileBrowser::Wanted::scene, "");
    if (ui.beginMenu("Built-in scenes")) {
        for (const BuiltinInfo& info : builtinScenes()) {
            if (ui.menuItem(std::string(info.name).c_str())) requests.open = std::string(info.name);
            ui.tip(info.summary);
        }
        ImGui::EndMenu();
    }
    if (ui.beginMenu("Recent", !settings.recentFiles.empty())) {
        for (const RecentFile& file : settings.recentFiles) {
            const std::string label =
                file.lights.empty() ? file.scene : fmt::format("{} with {}", file.scene, file.lights);
            if (!ui.menuItem(label.c_str())) continue;
            requests.open = file.scene;
            requests.openLights = file.lights;
        }
        ImGui::EndMenu();
    }
    ImGui::Separator();
    if (ui.menuItem("Save lights", "Ctrl+S", false, session.hasDocument())) requests.saveLights = true;
    if (ui.menuItem("Save lights as...", "Ctrl+Shift+S", false, session.hasDocument()))
        windowState.browser.open(FileBrowser::Wanted::lightsToSave, lightsPathOf(session.document()));
    if (ui.menuItem("Save picture", "F2")) requests.savePicture = true;
    if (ui.menuItem("Save what is shown", "F3")) requests.saveCanvas = true;
    if (ui.menuItem("Save the grid...", nullptr, false, session.grid().measurement() != nullptr))
        windowState.browser.open(FileBrowser::Wanted::grid, gridPathOf(session.document()));
    if (ui.menuItem("Copy command", "Ctrl+C")) requests.copyCommand = true;
    ui.tip("The line that renders this very picture without a window");
    drawPictureSizes(ui, settings);
    ImGui::Separator();
    if (ui.menuItem("Read shaders again", "F5")) requests.reloadShaders = true;
    if (ui.menuItem("Quit", "Ctrl+Q")) requests.quit = true;
    ImGui::EndMenu();
}

void drawEditMenu(Ui& ui, const WindowState& windowState, Requests& requests) {
    if (!ui.beginMenu("Edit")) return;
    if (ui.menuItem("Undo", "Ctrl+Z", false, windowState.canUndo)) requests.undo = true;
    if (ui.menuItem("Redo", "Ctrl+Shift+Z", false, windowState.canRedo)) requests.redo = true;
    ImGui::EndMenu();
}

void drawBookmarks(Ui& ui, Session& session, Requests& requests) {
    ImGui::Separator();
    if (ui.menuItem("Keep this view", "B")) requests.keepView = true;
    std::vector<Bookmark>& bookmarks = session.choices().bookmarks;
    for (const Bookmark& bookmark : std::vector<Bookmark>(bookmarks)) {
        if (ui.menuItem(bookmark.name.c_str())) session.goTo(bookmark);
    }
    if (!bookmarks.empty() && ui.beginMenu("Forget a view")) {
        for (const Bookmark& bookmark : std::vector<Bookmark>(bookmarks)) {
            if (ui.menuItem(fmt::format("Forget {}", bookmark.name).c_str())) std::erase(bookmarks, bookmark);
        }
        ImGui::EndMenu();
    }
}

void drawCameraMenu(Ui& ui, Session& session, Requests& requests) {
    if (!ui.beginMenu("Camera")) return;
    if (ui.menuItem("Frame all", "F")) requests.frameAll = true;
    if (ui.menuItem("Reset", "R")) requests.resetCamera = true;
    ImGui::Separator();
    const std::vector<Camera>& cameras = session.document().moment().cameras;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::string label = fmt::format("{}##camera {}", cameras[i].name, i);
        if (ui.menuItem(label.c_str(), nullptr, session.choices().sceneCamera == int(i))) {
            session.useSceneCamera(int(i));
        }
    }
    drawBookmarks(ui, session, requests);
    ImGui::EndMenu();
}

void drawTechniqueMenu(Ui& ui, Session& session) {
    if (!ui.beginMenu("Technique")) return;
    const std::vector<std::string> names = techniqueChoices();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool isReference = names[i] == referenceName;
        const std::string key = isReference                 ? "0"
                                : names[i] == exactName     ? "E"
                                : names[i] == automaticName ? "A"
                                : i < 9                     ? fmt::format("{}", i + 1)
                                                            : "";
        if (ui.menuItem(names[i].c_str(), key.c_str(), session.choices().technique == names[i])) {
            chooseTechnique(session, names[i]);
        }
    }
    ImGui::EndMenu();
}

/// How far a picture at rest has been refined.
std::string refinementText(const Session& session) {
    if (!session.isRefined()) return "";
    return session.refinedSamples() == 1
               ? ", refined: full resolution"
               : fmt::format(", refined: full resolution, {} samples a pixel", session.refinedSamples());
}

void drawViewMenu(Ui& ui, Session& session, WindowState& windowState) {
    if (!ui.beginMenu("View")) return;
    Choices& choices = session.choices();
    if (ui.menuItem("Wipe between two", "C", choices.comparing)) {
        choices.comparing = !choices.comparing;
        session.changedCanvas();
    }
    const auto item = [&](const char* label, const char* key, Shown shown) {
        if (!ui.menuItem(label, key, choices.shown == shown)) return;
        choices.shown = shown;
        session.changedCanvas();
        if (shown == Shown::illuminance) session.fitIlluminance();
    };
    item("Picture", "P", Shown::picture);
    item("Difference", "X", Shown::difference);
    item("Amount of the difference", "Y", Shown::error);
    item("Visibility", "V", Shown::visibility);
    item("Illuminance", "I", Shown::illuminance);
    ImGui::Separator();
    if (ui.menuItem("Lights themselves", nullptr, choices.luminairesShown)) {
        choices.luminairesShown = !choices.luminairesShown;
        session.changedLighting();
    }
    ui.tip("Shining surfaces of lights that have a size and a place, which block nothing");
    if (ui.menuItem("Place a grid", "M", windowState.placesGrid)) windowState.placesGrid = true;
    ImGui::Separator();
    for (const float scale : {0.25f, 0.5f, 0.75f, 1.0f, 2.0f}) {
        const std::string label = fmt::format("Resolution {:.0f} %", 100 * scale);
        if (ui.menuItem(label.c_str(), nullptr, choices.resolutionScale == scale))
            choices.resolutionScale = scale;
    }
    ImGui::Separator();
    if (ui.menuItem("Panel", "F1", windowState.showsPanel)) windowState.showsPanel = !windowState.showsPanel;
    ImGui::EndMenu();
}

}  // namespace

std::filesystem::path lightsPathOf(const Document& document) {
    const std::filesystem::path sidecar = document.sidecar();
    std::error_code error;
    return std::filesystem::absolute(
        sidecar.empty() ? document.nameOrPath() + ".lights.json" : sidecar.string(), error);
}

std::filesystem::path gridPathOf(const Document& document) {
    const std::filesystem::path file(document.nameOrPath());
    std::error_code error;
    const std::filesystem::path folder = document.isBuiltin()
                                             ? std::filesystem::current_path(error)
                                             : std::filesystem::absolute(file, error).parent_path();
    return folder / (file.stem().string() + ".lux.csv");
}

void drawMenuBar(Ui& ui, Session& session, Settings& settings, WindowState& windowState, Requests& requests) {
    if (!ImGui::BeginMainMenuBar()) return;
    drawFileMenu(ui, session, settings, windowState, requests);
    drawEditMenu(ui, windowState, requests);
    drawCameraMenu(ui, session, requests);
    drawTechniqueMenu(ui, session);
    drawViewMenu(ui, session, windowState);
    if (ui.beginMenu("Help")) {
        if (ui.menuItem("Keys and mouse", "H")) windowState.showsHelp = true;
        ImGui::EndMenu();
    }
    const std::string said =
        fmt::format("{}   |   {}   |   {}x{}{}", session.document().nameOrPath(), session.choices().technique,
                    session.width_px(), session.height_px(), refinementText(session));
    ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(said.c_str()).x - 12 * ui.scale());
    ImGui::TextDisabled("%s", said.c_str());
    ImGui::EndMainMenuBar();
}

}  // namespace penumbra::studio::viewer
