// SPDX-License-Identifier: Apache-2.0
// The mouse over the canvas: what it takes hold of when a button goes down, it keeps until the button goes
// up.
#pragma once

#include "studio/viewer/gizmo.h"
#include "studio/viewer/panels/panels.h"
#include "studio/viewer/session.h"
#include "studio/viewer/window.h"

namespace penumbra::studio::viewer {

/// Where the canvas lies, in screen coordinates.
struct CanvasPlace {
    ImVec2 min{0, 0}, size{1, 1};
    bool contains(const ImVec2& p) const {
        return p.x >= min.x && p.y >= min.y && p.x < min.x + size.x && p.y < min.y + size.y;
    }
};

class CanvasMouse {
  public:
    /// Once a frame, within Dear ImGui's. `scale` as Ui::scale().
    void update(const CanvasPlace& place, const Window& window, Session& session, WindowState& windowState,
                float scale);
    /// Draws lights, gizmo and wipe line over the canvas.
    void draw(const CanvasPlace& place, const Session& session, const WindowState& windowState,
              float scale) const;

    /// A button is held over the canvas: the frame must keep up.
    bool busy() const { return holds_ != Holds::nothing; }

  private:
    enum class Holds { nothing, orbit, pan, fly, gizmo, wipe, grid };
    void press(const CanvasPlace& place, Session& session, WindowState& windowState, float scale);
    void dragGrid(const CanvasPlace& place, Session& session);
    void drag(const CanvasPlace& place, Session& session, bool snap);
    void release(const CanvasPlace& place, Session& session, float scale);
    void fly(const Window& window, Session& session);
    glm::vec2 toCanvas(const CanvasPlace& place, const ImVec2& p) const {
        return {p.x - place.min.x, p.y - place.min.y};
    }

    Holds holds_ = Holds::nothing;
    ImVec2 last_{0, 0};
    float travelled_ = 0;
    Gizmo gizmo_;
    std::optional<GridSpec> gridBefore_;  ///< the drag
};

/// The light whose middle is drawn near `cursor`, if any.
std::optional<std::size_t> lightAt(const Session& session, const Projection& projection,
                                   const glm::vec2& cursor, float scale);

}  // namespace penumbra::studio::viewer
