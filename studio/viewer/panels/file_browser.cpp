// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/panels/file_browser.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace penumbra::studio::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostEntries = 2000;

/// What a window of each kind says, and which files it shows.
struct Kind {
    const char* title;
    const char* note;
    const char* accept;
    std::span<const std::string_view> endings;
    bool saves;
};

Kind kindOf(FileBrowser::Wanted wanted) {
    static constexpr std::array<std::string_view, 2> scenes{".gltf", ".glb"};
    static constexpr std::array<std::string_view, 1> lights{".lights.json"};
    static constexpr std::array<std::string_view, 3> grids{".csv", ".svg", ".png"};
    static constexpr std::array<std::string_view, 2> profiles{".ies", ".ldt"};
    static constexpr std::array<std::string_view, 4> pictures{".png", ".jpg", ".jpeg", ".webp"};
    switch (wanted) {
        case FileBrowser::Wanted::scene:
            return {"Open a scene",
                    "A glTF file (.gltf, .glb) or the name of a built-in scene. Files can be dropped, too.",
                    "Open", scenes, false};
        case FileBrowser::Wanted::lightsToSave:
            return {"Save lights as", "A file of lights (.lights.json); one that is there is replaced.",
                    "Save", lights, true};
        case FileBrowser::Wanted::grid:
            return {"Save the measured grid", "A table (.csv) or a plan (.svg, .png), by the name.", "Save",
                    grids, true};
        case FileBrowser::Wanted::profile:
            return {"Open a luminaire", "A luminaire's file, .ies or .ldt. Files can be dropped, too.",
                    "Open", profiles, false};
        case FileBrowser::Wanted::texture:
            break;
    }
    return {"Open a picture", "A picture that the light shows: .png, .jpg or .webp.", "Open", pictures,
            false};
}

bool hasEnding(const std::string& name, std::span<const std::string_view> endings) {
    return std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

}  // namespace

void FileBrowser::open(Wanted wanted, const fs::path& start) {
    wanted_ = wanted;
    path_ = start.string();
    problem_.clear();
    std::error_code error;
    folder_ = start.has_parent_path() ? fs::absolute(start.parent_path(), error) : fs::current_path(error);
    isNew_ = true;
    look();
}

void FileBrowser::look() {
    entries_.clear();
    if (folder_.has_parent_path() && folder_ != folder_.root_path()) entries_.push_back({"..", true});
    std::error_code error;
    const std::span<const std::string_view> endings = kindOf(*wanted_).endings;
    for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
        std::error_code ofEntry;
        const std::string name = at->path().filename().string();
        const bool isFolder = at->is_directory(ofEntry);
        if (name.starts_with(".") || (!isFolder && !hasEnding(name, endings))) continue;
        if (entries_.size() < mostEntries) entries_.push_back({name, isFolder});
    }
    problem_ = error ? error.message() : "";
    std::ranges::sort(entries_, {},
                      [](const Entry& entry) { return std::pair(!entry.isFolder, entry.name); });
}

bool FileBrowser::drawEntries(Ui& ui) {
    bool isChosen = false;
    ImGui::BeginChild("entries", {0, 220 * ui.scale()}, true);
    const std::vector<Entry> entries = entries_;
    for (const Entry& entry : entries) {
        if (!ui.selectable((entry.isFolder ? entry.name + "/" : entry.name).c_str(), false)) continue;
        if (!entry.isFolder) {
            path_ = (folder_ / entry.name).string();
            isChosen = true;
            continue;
        }
        folder_ = (folder_ / entry.name).lexically_normal();
        if (!folder_.has_filename()) folder_ = folder_.parent_path();
        const std::string file = fs::path(path_).filename().string();
        path_ = (folder_ / (kindOf(*wanted_).saves ? file : "")).string();
        look();
    }
    ImGui::EndChild();
    return isChosen;
}

void FileBrowser::take(const std::string& path, Requests& requests) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        folder_ = fs::absolute(path, error);
        if (!folder_.has_filename()) folder_ = folder_.parent_path();
        return look();
    }
    switch (*wanted_) {
        case Wanted::scene:
            requests.open = path;
            break;
        case Wanted::lightsToSave:
            requests.saveLightsAs = path;
            break;
        case Wanted::grid:
            requests.saveGrid = path;
            break;
        case Wanted::profile:
            requests.profile = path;
            break;
        case Wanted::texture:
            requests.texture = path;
            break;
    }
    wanted_.reset();
}

void FileBrowser::draw(Ui& ui, Requests& requests) {
    if (!wanted_) return;
    const Kind kind = kindOf(*wanted_);
    const bool appears = std::exchange(isNew_, false);
    if (appears) ImGui::OpenPopup(kind.title);
    if (!ImGui::BeginPopupModal(kind.title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        if (!appears) wanted_.reset();  // closed by Esc
        return;
    }
    ui.note(kind.note);
    ImGui::SetNextItemWidth(520 * ui.scale());
    if (appears) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##path", &path_, ImGuiInputTextFlags_EnterReturnsTrue);
    ui.note(folder_.string());
    const bool clicked = drawEntries(ui);
    if (!problem_.empty()) ui.note(problem_);
    std::error_code error;
    const bool replaces = kind.saves && fs::is_regular_file(path_, error);
    const bool accepted = ui.button(replaces ? "Replace" : kind.accept);
    ImGui::SameLine();
    const bool cancelled = ui.button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (!path_.empty() && (accepted || entered || (clicked && !kind.saves))) take(path_, requests);
    if (cancelled) wanted_.reset();
    if (!wanted_) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace penumbra::studio::viewer
