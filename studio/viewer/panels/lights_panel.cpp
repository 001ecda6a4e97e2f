// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "studio/scene/light_size.h"
#include "studio/scene/profiles/light_profile.h"
#include "studio/viewer/light_editing.h"
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

/// From where it shines, by numbers, and a point to shine at.
bool editDirection(Ui& ui, Light& light, const Session& session, WindowState& windowState) {
    Bearing bearing = bearingOf(light);
    bool changed = ui.drag("azimuth (deg)", bearing.azimuth_deg, 1, -360, 360, "%.2f");
    ui.tip("Where its light comes from: clockwise, seen from above, from -Z");
    changed |= ui.drag("altitude (deg)", bearing.altitude_deg, 1, -90, 90, "%.2f");
    ui.tip("How high its light comes from: 90 shines straight down");
    if (changed) setBearing(light, bearing);
    if (light.shape.shape == LightShape::distant) return changed;
    constexpr std::array names = {"aim x (m)", "aim y (m)", "aim z (m)"};
    for (int i = 0; i < 3; ++i) ui.drag(names[std::size_t(i)], windowState.aim_m[i], 0.01f, -1e6f, 1e6f);
    if (ui.button("Aim there")) {
        aimAt(light, windowState.aim_m);
        changed = true;
    }
    const std::optional<Pick>& pick = session.picker().result();
    ImGui::SameLine();
    if (ui.button("Aim at the pick") && pick && pick->hasSurface) {
        windowState.aim_m = pick->posWorld;
        aimAt(light, pick->posWorld);
        changed = true;
    }
    ui.tip("Click into the picture first");
    return changed;
}

/// Half-angles in which it falls off from full to none.
bool editCone(Ui& ui, Light& light) {
    if (light.shape.shape == LightShape::distant || (light.profile && light.profile->isLuminaire))
        return false;
    bool isCone = light.cone_rad.has_value();
    bool changed = ui.checkbox("cone", isCone);
    if (changed) {
        const std::array<float, 2> first_rad = {glm::radians(30.0f), glm::radians(45.0f)};
        light.cone_rad = isCone ? std::optional(first_rad) : std::nullopt;
    }
    if (!light.cone_rad) return changed;
    auto& [inner_rad, outer_rad] = *light.cone_rad;
    float inner_deg = glm::degrees(inner_rad), outer_deg = glm::degrees(outer_rad);
    if (ui.drag("cone, full (deg)", inner_deg, 0.5f, 0, 90, "%.2f")) {
        inner_rad = glm::radians(inner_deg);
        outer_rad = std::max(inner_rad, outer_rad);
        changed = true;
    }
    if (ui.drag("cone, none (deg)", outer_deg, 0.5f, 0, 90, "%.2f")) {
        outer_rad = glm::radians(outer_deg);
        inner_rad = std::min(inner_rad, outer_rad);
        changed = true;
    }
    return changed;
}

/// A picture that a rectangle shows.
bool editTexture(Ui& ui, Light& light, const Scene& scene, WindowState& windowState) {
    if (light.shape.shape != LightShape::rect || light.profile) return false;
    std::vector<std::string> names = {"(no picture)"};
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Picture& picture = scene.pictures[std::size_t(scene.textures[i].picture)];
        names.push_back(
            fmt::format("{}##{}", picture.name.empty() ? fmt::format("picture {}", i + 1) : picture.name, i));
    }
    int index = light.texture + 1;
    const bool changed = ui.combo("texture", index, names);
    if (changed) light.texture = index - 1;
    if (ui.button("Load a picture ...")) windowState.browser.open(FileBrowser::Wanted::texture, "");
    return changed;
}

/// What a light without a size is, in a word.
void sayHard(Ui& ui, const Light& light) {
    if (!(effectOf(light.shape) > 0))
        ui.note("This light has no size, so its shadows are hard: give it one above.");
}

bool editLight(Ui& ui, Light& light, const Session& session, WindowState& windowState, Requests& requests) {
    bool changed = ui.text("name", light.name);
    int shape = int(light.shape.shape);
    if (ui.combo("shape", shape, shapeNames)) {
        changeShape(light, LightShape(shape));
        changed = true;
    }
    if (light.shape.shape == LightShape::distant) changed |= editSun(ui, light, requests);
    if (!light.sun) {
        changed |= editSizes(ui, light);
        sayHard(ui, light);
        changed |= editEmission(ui, light);
    }
    changed |= editPlace(ui, light);
    if (!light.sun) changed |= editDirection(ui, light, session, windowState);
    changed |= editCone(ui, light);
    changed |= editTexture(ui, light, session.document().scene(), windowState);
    changed |= ui.checkbox("casts shadow", light.castsShadow);
    if (light.shape.shape == LightShape::rect || light.shape.shape == LightShape::disk) {
        changed |= ui.checkbox("shines both ways", light.shape.twoSided);
    }
    return changed;
}

/// What the light is by its maker's file, and a file to make it so.
bool editProfile(Ui& ui, Light& light, WindowState& windowState) {
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
    if (ui.button("Load a luminaire ...")) windowState.browser.open(FileBrowser::Wanted::profile, "");
    ui.tip("A luminaire's file, .ies or .ldt: the light becomes that luminaire. Files can be dropped, too.");
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
    constexpr std::size_t mostShown = 6;  // at a time
    const bool scrolls = lights.size() > mostShown;
    if (scrolls) ImGui::BeginChild("lights", {0, float(mostShown) * ImGui::GetFrameHeightWithSpacing()});
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string label = fmt::format("{}  ({})##light {}", lights[i].name,
                                              shapeNames[std::size_t(lights[i].shape.shape)], i);
        if (ui.radio(label.c_str(), session.choices().light == i) && session.choices().light != i) {
            session.choices().light = i;
            session.changedLighting();  // the light in question comes last
        }
    }
    if (scrolls) ImGui::EndChild();
}

/// Adds, doubles and takes away; returns whether the lights are others now.
bool drawListButtons(Ui& ui, Session& session, Requests& requests) {
    std::vector<Light> lights = session.document().moment().lights;
    std::size_t& selected = session.choices().light;
    bool changed = false;
    if (ui.button("Add")) requests.addLight = true;
    ui.tip("A light that faces the surface in the middle of the picture");
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
    if (drawListButtons(ui, session, requests)) return;
    std::vector<Light> lights = session.document().moment().lights;
    const std::size_t selected = session.choices().light;
    if (selected < lights.size()) {
        ImGui::PushItemWidth(150 * ui.scale());
        const std::string nameBefore = lights[selected].name;
        chooseTechniqueOf(ui, session, lights[selected]);
        const bool otherwise = editLight(ui, lights[selected], session, windowState, requests);
        if (editProfile(ui, lights[selected], windowState) || otherwise) {
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
