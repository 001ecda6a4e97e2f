// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/canvas_mouse.h"

#include <algorithm>
#include <cmath>

#include "studio/viewer/candela_web.h"

#include <GLFW/glfw3.h>

namespace penumbra::studio::viewer {
namespace {

constexpr float radiansPerCoordinate = 0.006f;
constexpr float clickReach = 4;  ///< screen coordinates; less movement than this is a click

Projection projectionOf(const Session& session, const CanvasPlace& place) {
    return Projection(session.cameraView(), {place.size.x, place.size.y});
}

ImU32 axisColor(Gizmo::Axis axis) {
    switch (axis) {
        case Gizmo::Axis::x:
            return IM_COL32(235, 87, 80, 255);
        case Gizmo::Axis::y:
            return IM_COL32(110, 205, 90, 255);
        case Gizmo::Axis::z:
            return IM_COL32(85, 145, 245, 255);
        case Gizmo::Axis::free:
            break;
    }
    return IM_COL32(240, 200, 110, 255);
}

int pixelOf(float place, float size, int count_px) {
    return std::clamp(int(place / size * float(count_px)), 0, count_px - 1);
}

/// A surface that is upright or level but for the last bits of its normal is so.
glm::dvec3 uprightOf(const glm::vec3& normal) {
    glm::dvec3 result = glm::normalize(glm::dvec3(normal));
    constexpr double rounding = 1e-4;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(result[axis]) < rounding) result[axis] = 0;
    }
    return glm::normalize(result);
}

bool overWipe(const CanvasPlace& place, const Choices& choices, const ImVec2& p, float scale) {
    return choices.comparing && std::abs(p.x - (place.min.x + choices.wipe * place.size.x)) < 6 * scale;
}

}  // namespace

std::optional<std::size_t> lightAt(const Session& session, const Projection& projection,
                                   const glm::vec2& cursor, float scale) {
    const Document& document = session.document();
    const std::vector<Light>& lights = document.moment().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto pixel = projection.pixelOf(placeOf(lights[i].shape, document.bounds()));
        if (pixel && glm::distance(*pixel, cursor) < 10 * scale) return i;
    }
    return {};
}

void CanvasMouse::update(const CanvasPlace& place, const Window& window, Session& session,
                         WindowState& windowState, float scale) {
    const ImGuiIO& io = ImGui::GetIO();
    if (holds_ == Holds::nothing) {
        if (!io.WantCaptureMouse && place.contains(io.MousePos)) {
            press(place, session, windowState, scale);
            if (io.MouseWheel != 0) {
                session.freeCamera().zoom(io.MouseWheel);
                session.changedView();
            }
            if (overWipe(place, session.choices(), io.MousePos, scale)) {
                ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
            }
        }
        return;
    }
    drag(place, session, io.KeyCtrl);
    if (holds_ == Holds::fly) fly(window, session);
    const int button = holds_ == Holds::pan   ? ImGuiMouseButton_Middle
                       : holds_ == Holds::fly ? ImGuiMouseButton_Right
                                              : ImGuiMouseButton_Left;
    if (!ImGui::IsMouseDown(button)) release(place, session, scale);
}

void CanvasMouse::press(const CanvasPlace& place, Session& session, WindowState& windowState, float scale) {
    const ImVec2 cursor = ImGui::GetIO().MousePos;
    last_ = cursor;
    travelled_ = 0;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
        holds_ = Holds::pan;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        holds_ = Holds::fly;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        holds_ = Holds::orbit;
        if (windowState.placesGrid) {
            const auto surface =
                surfaceAt(session.frame(), pixelOf(cursor.x - place.min.x, place.size.x, session.width_px()),
                          pixelOf(cursor.y - place.min.y, place.size.y, session.height_px()));
            if (!surface) return;
            holds_ = Holds::grid;
            windowState.placesGrid = false;
            gridBefore_ = session.choices().grid;
            session.choices().grid = GridSpec{.fromWorld = surface->posWorld,
                                              .toWorld = surface->posWorld,
                                              .normalWorld = uprightOf(surface->normalWorld)};
            return;
        }
        if (overWipe(place, session.choices(), cursor, scale)) {
            holds_ = Holds::wipe;
            return;
        }
        const std::vector<Light>& lights = session.document().moment().lights;
        const std::size_t selected = session.choices().light;
        if (selected >= lights.size()) return;
        const auto handles = Gizmo::handles(lights[selected], windowState.gizmoMode,
                                            projectionOf(session, place), session.document().bounds(), scale);
        if (const auto axis = Gizmo::pick(handles, toCanvas(place, cursor), scale)) {
            gizmo_.begin(lights[selected], windowState.gizmoMode, *axis, toCanvas(place, cursor));
            holds_ = Holds::gizmo;
        }
    }
}

void CanvasMouse::drag(const CanvasPlace& place, Session& session, bool snap) {
    const ImVec2 cursor = ImGui::GetIO().MousePos;
    const ImVec2 way(cursor.x - last_.x, cursor.y - last_.y);
    if (way.x == 0 && way.y == 0) return;
    last_ = cursor;
    travelled_ += std::hypot(way.x, way.y);
    switch (holds_) {
        case Holds::nothing:
            return;
        case Holds::orbit:
            if (travelled_ < clickReach) return;
            session.freeCamera().orbit(way.x * radiansPerCoordinate, -way.y * radiansPerCoordinate);
            return session.changedView();
        case Holds::pan:
            session.freeCamera().pan(way.x / place.size.y, -way.y / place.size.y);
            return session.changedView();
        case Holds::fly:
            session.freeCamera().look(way.x * 0.5f * radiansPerCoordinate,
                                      -way.y * 0.5f * radiansPerCoordinate);
            return session.changedView();
        case Holds::wipe:
            session.choices().wipe = std::clamp((cursor.x - place.min.x) / place.size.x, 0.0f, 1.0f);
            return session.changedCanvas();
        case Holds::grid:
            return dragGrid(place, session);
        case Holds::gizmo: {
            std::vector<Light> lights = session.document().moment().lights;
            const std::size_t selected = session.choices().light;
            lights[selected] = gizmo_.drag(toCanvas(place, cursor), projectionOf(session, place),
                                           session.document().bounds(), snap);
            return session.editLights(std::move(lights));
        }
    }
}

void CanvasMouse::dragGrid(const CanvasPlace& place, Session& session) {
    GridSpec& spec = *session.choices().grid;
    const Projection::Ray ray = projectionOf(session, place).rayThrough(toCanvas(place, last_));
    const glm::dvec3 direction(ray.direction);
    const double facing = glm::dot(direction, spec.normalWorld);
    const double way = glm::dot(spec.fromWorld - glm::dvec3(ray.origin), spec.normalWorld);
    if (!(way * facing > 0)) return;  // over the horizon
    spec.toWorld = glm::dvec3(ray.origin) + way / facing * direction;
    fitCells(spec);
}

void CanvasMouse::release(const CanvasPlace& place, Session& session, float scale) {
    const bool clicked = travelled_ < clickReach;
    const Holds held = holds_;
    holds_ = Holds::nothing;
    gizmo_.end();
    if (held == Holds::grid && clicked) session.choices().grid = gridBefore_;  // no drag, no grid
    if (held != Holds::orbit || !clicked) return;
    const glm::vec2 cursor = toCanvas(place, last_);
    if (const auto light = lightAt(session, projectionOf(session, place), cursor, scale)) {
        session.choices().light = *light;
        session.changedLighting();
        return;
    }
    session.picker().pick(pixelOf(cursor.x, place.size.x, session.width_px()),
                          pixelOf(cursor.y, place.size.y, session.height_px()));
}

void CanvasMouse::fly(const Window& window, Session& session) {
    glm::vec3 way(0);
    const auto add = [&](int key, const glm::vec3& direction) {
        if (window.isDown(key)) way += direction;
    };
    add(GLFW_KEY_W, {0, 0, 1});
    add(GLFW_KEY_S, {0, 0, -1});
    add(GLFW_KEY_D, {1, 0, 0});
    add(GLFW_KEY_A, {-1, 0, 0});
    add(GLFW_KEY_E, {0, 1, 0});
    add(GLFW_KEY_Q, {0, -1, 0});
    if (way == glm::vec3(0)) return;
    CameraControl& camera = session.freeCamera();
    const bool fast = window.isDown(GLFW_KEY_LEFT_SHIFT) || window.isDown(GLFW_KEY_RIGHT_SHIFT);
    // A slow frame does not throw anyone through a wall.
    const float elapsed_s = std::min(ImGui::GetIO().DeltaTime, 0.1f);
    camera.fly(way * camera.flyingSpeed_mps() * elapsed_s * (fast ? 4.0f : 1.0f));
    session.changedView();
}

void CanvasMouse::draw(const CanvasPlace& place, const Session& session, const WindowState& windowState,
                       float scale) const {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect(place.min, {place.min.x + place.size.x, place.min.y + place.size.y});
    const Choices& choices = session.choices();
    const Document& document = session.document();
    const Projection projection = projectionOf(session, place);
    const auto screen = [&](const glm::vec2& p) { return ImVec2(place.min.x + p.x, place.min.y + p.y); };

    const std::vector<Light>& lights = document.moment().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool selected = i == choices.light;
        const ImU32 color = selected ? IM_COL32(255, 196, 92, 255) : IM_COL32(255, 226, 170, 110);
        for (const auto& line : outlineOf(lights[i].shape, document.bounds())) {
            for (std::size_t k = 1; k < line.size(); ++k) {
                const auto a = projection.pixelOf(line[k - 1]), b = projection.pixelOf(line[k]);
                if (a && b) list.AddLine(screen(*a), screen(*b), color, (selected ? 1.8f : 1.2f) * scale);
            }
        }
        if (const auto middle = projection.pixelOf(placeOf(lights[i].shape, document.bounds()))) {
            list.AddCircleFilled(screen(*middle), 4 * scale, color);
        }
    }
    if (choices.light < lights.size() && lights[choices.light].profile) {
        for (const auto& line : candelaWeb(lights[choices.light], document.bounds())) {
            for (std::size_t k = 1; k < line.size(); ++k) {
                const auto a = projection.pixelOf(line[k - 1]), b = projection.pixelOf(line[k]);
                if (a && b) list.AddLine(screen(*a), screen(*b), IM_COL32(140, 205, 255, 200), scale);
            }
        }
    }
    if (choices.light < lights.size()) {
        for (const Gizmo::Handle& handle : Gizmo::handles(lights[choices.light], windowState.gizmoMode,
                                                          projection, document.bounds(), scale)) {
            const ImU32 color = axisColor(handle.axis);
            for (std::size_t k = 1; k < handle.line_px.size(); ++k) {
                list.AddLine(screen(handle.line_px[k - 1]), screen(handle.line_px[k]), color, 2.2f * scale);
            }
            if (windowState.gizmoMode != Gizmo::Mode::turn) {
                list.AddCircleFilled(screen(handle.line_px.back()), 5 * scale, color);
            }
        }
    }
    if (const auto& pick = session.picker().result()) {
        const glm::vec2 at((float(pick->x) + 0.5f) / float(session.width_px()) * place.size.x,
                           (float(pick->y) + 0.5f) / float(session.height_px()) * place.size.y);
        list.AddCircle(screen(at), 7 * scale, IM_COL32(0, 0, 0, 255), 0, 3 * scale);
        list.AddCircle(screen(at), 7 * scale, IM_COL32(255, 255, 255, 255), 0, 1.5f * scale);
    }
    if (choices.comparing && !choices.flipped) {
        const float x = place.min.x + choices.wipe * place.size.x;
        list.AddLine({x, place.min.y}, {x, place.min.y + place.size.y}, IM_COL32(0, 0, 0, 160), 3 * scale);
        list.AddLine({x, place.min.y}, {x, place.min.y + place.size.y}, IM_COL32(255, 255, 255, 220), scale);
    }
    list.PopClipRect();
}

}  // namespace penumbra::studio::viewer
