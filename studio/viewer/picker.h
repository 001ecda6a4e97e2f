// SPDX-License-Identifier: Apache-2.0
// A pixel under the glass: where it is, what each technique and the truth say of it, and what it sees of the
// light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studio/viewer/canvas.h"

namespace penumbra::studio::viewer {

/// A place on what a frame shows.
struct SurfacePoint {
    glm::vec3 posWorld{0}, normalWorld{0, 1, 0};
};
/// At a pixel, from the upper left; nothing where no surface is. Waits for the device.
std::optional<SurfacePoint> surfaceAt(const FrameRenderer& frame, int x, int y);

/// What is known of the picked pixel; grows by a technique a frame, the one that is shown first.
struct Pick {
    int x = 0, y = 0;  ///< from the upper left
    bool hasSurface = false;
    glm::vec3 posWorld{0}, normalWorld{0, 1, 0};
    float illuminance_lux = 0;  ///< as side A has it
    struct Answer {
        std::string technique;
        float visibility = 0;
    };
    std::vector<Answer> answers;  ///< for the light in question
    std::optional<float> truth;   ///< of `truthSamples` rays
    static constexpr int truthSamples = 4096;
};

class Picker {
  public:
    Picker(Device& device, gl::ShaderLibrary& shaders);

    void pick(int x, int y) {
        wanted_ = Pick{.x = x, .y = y};
        located_ = stopped_ = false;
    }
    void clear() { wanted_.reset(); }
    /// What is known by now is all.
    void stop() { stopped_ = true; }
    /// Everything is asked again, at the same pixel.
    void restart();

    const std::optional<Pick>& result() const { return wanted_; }
    bool busy() const;

    /// The next step: the position, the light's view, a technique (`first` before all others), or the truth
    /// once `traced` is ready. `frame` shows the view that the pixel is of.
    void step(const FrameRenderer& frame, const Side& side, const Document& document, std::size_t light,
              const std::string& first, TechniqueBank& techniques, const ReferenceScene* traced);

    /// What the point sees looking at the light, the light in its middle; valid once the position is known.
    const gl::Texture& lightView() const { return lightView_.texture(); }

  private:
    void locate(const FrameRenderer& frame, const Side& side);
    void lookAtLight(const Document& document, const Light& light);
    void ask(const FrameRenderer& frame, const Light& light, const std::string& technique,
             TechniqueBank& techniques);
    void trace(const FrameRenderer& frame, const Light& light, const ReferenceScene& scene);

    Device& device_;
    FrameRenderer pointFrame_;
    Canvas lightView_;
    std::optional<Pick> wanted_;
    bool located_ = false, stopped_ = false;
};

}  // namespace penumbra::studio::viewer
