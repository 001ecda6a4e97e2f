// SPDX-License-Identifier: Apache-2.0
// What each key does; panels/help.cpp tells the user.
#include <imgui.h>

#include <algorithm>

#include "studio/viewer/viewer.h"

#include <GLFW/glfw3.h>

namespace penumbra::studio::viewer {

void Viewer::takeKeys() {
    Choices& choices = session_.choices();
    const std::vector<KeyPress> keys = window_.takeKeys();
    const bool flips = window_.isDown(GLFW_KEY_TAB) && !ImGui::GetIO().WantTextInput;
    if (flips != choices.flipped) {
        choices.flipped = flips;
        session_.changedCanvas();
    }
    if (!keys.empty() || ImGui::GetIO().MouseClicked[0]) windowState_.showsWelcome = false;
    for (const KeyPress& press : keys) {
        if (ImGui::GetIO().WantTextInput) continue;
        // While the right button flies, letters steer.
        const bool steers =
            ImGui::IsMouseDown(ImGuiMouseButton_Right) && press.key >= GLFW_KEY_A && press.key <= GLFW_KEY_Z;
        if (!steers) chooseByKey(press.key, press.mods);
    }
}

void Viewer::chooseByKey(int key, int mods) {
    Choices& choices = session_.choices();
    const auto show = [&](Shown shown) {
        choices.shown = shown;
        session_.changedCanvas();
        if (shown == Shown::illuminance) session_.fitIlluminance();
    };
    if ((mods & GLFW_MOD_CONTROL) != 0) {
        if (key == GLFW_KEY_O) windowState_.browser.open(FileBrowser::Wanted::scene, "");
        keyRequests_.copyCommand |= key == GLFW_KEY_C;
        keyRequests_.quit |= key == GLFW_KEY_Q;
        const bool shift = (mods & GLFW_MOD_SHIFT) != 0;
        keyRequests_.saveLights |= key == GLFW_KEY_S && !shift;
        if (key == GLFW_KEY_S && shift)
            windowState_.browser.open(FileBrowser::Wanted::lightsToSave, lightsPathOf(session_.document()));
        keyRequests_.undo |= key == GLFW_KEY_Z && !shift;
        keyRequests_.redo |= (key == GLFW_KEY_Z && shift) || key == GLFW_KEY_Y;
        if (key == GLFW_KEY_D) changeSelectedLight(key);
        return;
    }
    const auto choose = [&](const std::string& name) {
        return (mods & GLFW_MOD_SHIFT) != 0 ? chooseOther(session_, name) : chooseTechnique(session_, name);
    };
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) {
        // Over a panel digits are meant for a number there, and mean nothing where none is edited.
        if (ImGui::GetIO().WantCaptureMouse || !place_.contains(ImGui::GetIO().MousePos)) return;
        const std::vector<std::string> names = techniqueChoices();
        const auto index = std::size_t(key - GLFW_KEY_1);
        const std::string name = key == GLFW_KEY_0      ? std::string(referenceName)
                                 : index < names.size() ? names[index]
                                                        : choices.technique;
        return choose(name);
    }
    switch (key) {
        case GLFW_KEY_E:
            return choose(std::string(exactName));
        case GLFW_KEY_A:
            return choose(std::string(automaticName));
        case GLFW_KEY_M:
            windowState_.placesGrid = !windowState_.placesGrid;
            return;
        case GLFW_KEY_B:
            keyRequests_.keepView = true;
            return;
        case GLFW_KEY_C:
            choices.comparing = !choices.comparing;
            return session_.changedCanvas();
        case GLFW_KEY_P:
            return show(Shown::picture);
        case GLFW_KEY_X:
            return show(Shown::difference);
        case GLFW_KEY_Y:
            return show(Shown::error);
        case GLFW_KEY_V:
            return show(Shown::visibility);
        case GLFW_KEY_I:
            return show(Shown::illuminance);
        case GLFW_KEY_F:
            keyRequests_.frameAll = true;
            return;
        case GLFW_KEY_R:
        case GLFW_KEY_HOME:
            keyRequests_.resetCamera = true;
            return;
        case GLFW_KEY_G:
            windowState_.gizmoMode = Gizmo::Mode::move;
            return;
        case GLFW_KEY_T:
            windowState_.gizmoMode = Gizmo::Mode::turn;
            return;
        case GLFW_KEY_S:
            windowState_.gizmoMode = Gizmo::Mode::resize;
            return;
        case GLFW_KEY_L:
            return nextLight();
        case GLFW_KEY_DELETE:
            return changeSelectedLight(key);
        case GLFW_KEY_SPACE:
            windowState_.playing = !windowState_.playing && session_.document().duration_s() > 0;
            return;
        case GLFW_KEY_COMMA:
            return stepTime(-1);
        case GLFW_KEY_PERIOD:
            return stepTime(1);
        case GLFW_KEY_H:
        case GLFW_KEY_SLASH:
            windowState_.showsHelp = !windowState_.showsHelp;
            return;
        case GLFW_KEY_ESCAPE:
            windowState_.showsHelp = false;
            windowState_.message.clear();
            return session_.picker().clear();
        case GLFW_KEY_F1:
            windowState_.showsPanel = !windowState_.showsPanel;
            return;
        case GLFW_KEY_F2:
            keyRequests_.savePicture = true;
            return;
        case GLFW_KEY_F3:
            keyRequests_.saveCanvas = true;
            return;
        case GLFW_KEY_F5:
            keyRequests_.reloadShaders = true;
            return;
        default:
            return;
    }
}

void Viewer::nextLight() {
    const std::size_t count = session_.document().moment().lights.size();
    if (count < 2) return;
    session_.choices().light = (session_.choices().light + 1) % count;
    session_.changedLighting();
}

void Viewer::changeSelectedLight(int key) {
    std::vector<Light> lights = session_.document().moment().lights;
    std::size_t& selected = session_.choices().light;
    if (selected >= lights.size()) return;
    if (key == GLFW_KEY_DELETE) {
        lights.erase(lights.begin() + std::ptrdiff_t(selected));
    } else {
        lights.push_back(lights[selected]);
        selected = lights.size() - 1;
    }
    session_.editLights(std::move(lights));
}

void Viewer::stepTime(int frames) {
    const double duration_s = session_.document().duration_s();
    if (duration_s <= 0) return;
    windowState_.playing = false;
    const double time_s = session_.document().time_s() + frames / windowState_.recording.framesPerSecond;
    session_.setTime(std::clamp(time_s, 0.0, duration_s));
}

}  // namespace penumbra::studio::viewer
