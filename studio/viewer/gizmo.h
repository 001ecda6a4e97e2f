// SPDX-License-Identifier: Apache-2.0
// Lights taken by the hand: arrows that move one, rings that turn it, dots that resize it. Arithmetic in
// pixels of the canvas; who draws and who listens to the mouse is somebody else.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "studio/frame/camera_view.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::viewer {

/// From the world to pixels of a picture whose origin is its upper left corner.
class Projection {
  public:
    Projection(const CameraView& camera, glm::vec2 size_px) : camera_(camera), size_px_(size_px) {}

    /// Nothing where the point lies behind the camera.
    std::optional<glm::vec2> pixelOf(const glm::vec3& posWorld) const;
    struct Ray {
        glm::vec3 origin, direction;  ///< unit direction
    };
    Ray rayThrough(const glm::vec2& pixel) const;
    /// How large a metre at `posWorld` looks, in pixels.
    float pixelsPerMetre(const glm::vec3& posWorld) const;

  private:
    CameraView camera_;
    glm::vec2 size_px_;
};

/// The light's outline in the world: polylines, closed where their last point is their first.
std::vector<std::vector<glm::vec3>> outlineOf(const AreaLight& light, const Bounds& scene);
/// Where the light is drawn and held: distant ones float over the scene, against the light's way.
glm::vec3 placeOf(const AreaLight& light, const Bounds& scene);

class Gizmo {
  public:
    enum class Mode { move, turn, resize };
    enum class Axis { x, y, z, free };

    struct Handle {
        Axis axis = Axis::x;
        std::vector<glm::vec2> line_px;  ///< as drawn; the last point of an arrow is its tip
    };

    /// Handles of `light` in a mode, nearest to the eye last. `scale` enlarges them for HiDPI.
    static std::vector<Handle> handles(const Light& light, Mode mode, const Projection& projection,
                                       const Bounds& scene, float scale);
    /// The handle under the cursor.
    static std::optional<Axis> pick(const std::vector<Handle>& handles, const glm::vec2& cursor_px,
                                    float scale);

    /// A drag: `light` as it was when the button went down.
    void begin(const Light& light, Mode mode, Axis axis, const glm::vec2& cursor_px);
    bool active() const { return active_; }
    /// The light as it is with the cursor here; turning snaps to 15 degrees and moving to 0.1 m if asked.
    Light drag(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene,
               bool snap) const;
    void end() { active_ = false; }

  private:
    Light moved(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene,
                bool snap) const;
    Light turned(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene,
                 bool snap) const;
    Light resized(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene) const;

    bool active_ = false;
    Light light_;
    Mode mode_ = Mode::move;
    Axis axis_ = Axis::x;
    glm::vec2 start_px_{0};
};

}  // namespace penumbra::studio::viewer
