// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "studio/scene/profiles/light_profile.h"
#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

const std::vector<std::string> shapeNames = {"rect", "disk", "sphere", "distant", "tube"};

std::string unitOf(const Light& light) {
    switch (light.emission.unit) {
        case Emission::Unit::nits:
            return "nits";
        case Emission::Unit::candela:
            return "candela";
        case Emission::Unit::lux:
            return "lux";
    }
    return "";
}

/// Sizes may be 0: that is a hard shadow. Returns whether any changed.
bool editSizes(Ui& ui, Light& light) {
    const auto edit = [&](const char* label, float AreaLight::*size, float max, float toShown = 1) {
        float value = light.shape.*size * toShown;
        if (!ui.drag(label, value, 0.004f * std::max(value, 0.25f), 0, max)) return false;
        setSize(light, size, value / toShown);
        return true;
    };
    switch (light.shape.shape) {
        case LightShape::rect: {
            const bool width = edit("width (m)", &AreaLight::width_m, 1e4f);
            return edit("height (m)", &AreaLight::height_m, 1e4f) || width;
        }
        case LightShape::disk:
        case LightShape::sphere:
            return edit("radius (m)", &AreaLight::radius_m, 1e4f);
        case LightShape::cylinder: {
            const bool length = edit("length (m)", &AreaLight::length_m, 1e4f);
            return edit("radius (m)", &AreaLight::radius_m, 1e4f) || length;
        }
        case LightShape::distant:
            return edit("angle (deg)", &AreaLight::angle_rad, 180, glm::degrees(1.0f));
    }
    return false;
}

/// Colour with its largest part at 1, and how much of it.
bool editEmission(Ui& ui, Light& light) {
    glm::vec3& value = light.emission.value;
    float intensity = std::max({value.r, value.g, value.b});
    glm::vec3 color = intensity > 0 ? value / intensity : glm::vec3(1);
    bool changed = ui.drag(fmt::format("intensity ({})", unitOf(light)).c_str(), intensity,
                           0.01f * std::max(intensity, 0.01f), 0, 1e12f);
    changed |= ui.color("colour (linear)", color);
    if (!changed) return false;
    const float largest = std::max({color.r, color.g, color.b, 1e-6f});
    value = glm::max(color / largest, 0.0f) * intensity;
    return true;
}

bool editPlace(Ui& ui, Light& light) {
    glm::mat4 matrix = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    bool changed = false;
    if (light.shape.shape != LightShape::distant) {
        for (int i = 0; i < 3; ++i) {
            constexpr std::array names = {"x (m)", "y (m)", "z (m)"};
            changed |= ui.drag(names[std::size_t(i)], matrix[3][i], 0.01f, -1e6f, 1e6f);
        }
    }
    if (changed) light.shape.worldFromLight = std::bit_cast<Mat4>(matrix);
    return changed;
}

bool editLight(Ui& ui, Light& light, Requests& requests) {
    bool changed = ui.text("name", light.name);
    int shape = int(light.shape.shape);
    if (ui.combo("shape", shape, shapeNames)) {
        changeShape(light, LightShape(shape));
        changed = true;
    }
    if (light.shape.shape == LightShape::distant) changed |= editSun(ui, light, requests);
    if (!light.sun) {
        changed |= editSizes(ui, light);
        changed |= editEmission(ui, light);
    }
    changed |= editPlace(ui, light);
    changed |= ui.checkbox("casts shadow", light.castsShadow);
    if (light.shape.shape == LightShape::rect || light.shape.shape == LightShape::disk) {
        changed |= ui.checkbox("shines both ways", light.shape.twoSided);
    }
    return changed;
}

/// What the light is by its maker's file, and a file to make it so.
bool editProfile(Ui& ui, Light& light, WindowState& windowState, Requests& requests) {
    if (light.shape.shape == LightShape::distant) return false;  // no luminaire is
    bool changed = false;
    if (light.profile) {
        ui.note(light.profile->profile->fileName);
        float turn_deg = glm::degrees(light.profile->turn_rad);
        if (ui.drag("turn of C0 (deg)", turn_deg, 1, -360, 360)) {
            light.profile->turn_rad = glm::radians(turn_deg);
            changed = true;
        }
    }
    ui.text("profile", windowState.profilePath);
    ui.tip("A luminaire's file, .ies or .ldt: the light becomes that luminaire. Files can be dropped, too.");
    ImGui::SameLine();
    if (ui.button("Load")) requests.profile = windowState.profilePath;
    return changed;
}

void chooseTechniqueOf(Ui& ui, Session& session, const Light& light) {
    std::vector<std::string> names = techniqueChoices();
    names.insert(names.begin(), "(as set above)");
    auto& own = session.choices().techniqueOfLight;
    const auto found = own.find(light.name);
    int index = found == own.end() ? 0 : int(std::ranges::find(names, found->second) - names.begin());
    if (!ui.combo("its technique", index, names)) return;
    if (index == 0) {
        own.erase(light.name);
    } else {
        own[light.name] = names[std::size_t(index)];
    }
    session.changedLighting();
}

void drawList(Ui& ui, Session& session) {
    const std::vector<Light>& lights = session.document().moment().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string label = fmt::format("{}  ({})##light {}", lights[i].name,
                                              shapeNames[std::size_t(lights[i].shape.shape)], i);
        if (ui.radio(label.c_str(), session.choices().light == i) && session.choices().light != i) {
            session.choices().light = i;
            session.changedLighting();  // the light in question comes last
        }
    }
}

/// Adds, doubles and takes away; returns whether the lights are others now.
bool drawListButtons(Ui& ui, Session& session) {
    std::vector<Light> lights = session.document().moment().lights;
    std::size_t& selected = session.choices().light;
    bool changed = false;
    if (ui.button("Add")) {
        lights.push_back(newLight(session.document().bounds(), lights.size()));
        selected = lights.size() - 1;
        changed = true;
    }
    if (selected < session.document().moment().lights.size()) {
        ImGui::SameLine();
        if (ui.button("Duplicate")) {
            lights.push_back(lights[selected]);
            selected = lights.size() - 1;
            changed = true;
        }
        ImGui::SameLine();
        if (ui.button("Delete")) {
            lights.erase(lights.begin() + std::ptrdiff_t(selected));
            changed = true;
        }
    }
    if (changed) session.editLights(std::move(lights));
    return changed;
}

}  // namespace

void drawLightsPanel(Ui& ui, Session& session, WindowState& windowState, Requests& requests) {
    if (!ui.header("Lights")) return;
    drawList(ui, session);
    if (drawListButtons(ui, session)) return;
    std::vector<Light> lights = session.document().moment().lights;
    const std::size_t selected = session.choices().light;
    if (selected < lights.size()) {
        ImGui::PushItemWidth(150 * ui.scale());
        const std::string nameBefore = lights[selected].name;
        chooseTechniqueOf(ui, session, lights[selected]);
        const bool otherwise = editLight(ui, lights[selected], requests);
        if (editProfile(ui, lights[selected], windowState, requests) || otherwise) {
            auto& own = session.choices().techniqueOfLight;
            session.editLights(lights);
            // A technique of its own follows a light to its new name.
            if (auto node = own.extract(nameBefore)) {
                node.key() = session.document().moment().lights[selected].name;
                own.insert(std::move(node));
            }
        }
        ImGui::PopItemWidth();
    }
    for (const auto& [label, mode] :
         {std::pair{"Move", Gizmo::Mode::move}, std::pair{"Turn", Gizmo::Mode::turn},
          std::pair{"Resize", Gizmo::Mode::resize}}) {
        if (ui.radio(label, windowState.gizmoMode == mode)) windowState.gizmoMode = mode;
        ImGui::SameLine();
    }
    ui.note("by hand (G, T, S)");
    if (session.document().lights().edited()) {
        if (ui.button(session.document().lights().unsaved() ? "Save lights *" : "Save lights")) {
            requests.saveLights = true;
        }
        ImGui::SameLine();
        if (ui.button("Revert")) session.revertLights();
    }
}

}  // namespace penumbra::studio::viewer
