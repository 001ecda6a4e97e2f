// SPDX-License-Identifier: Apache-2.0
// One view, lit twice: side A and side B of a comparison, each with visibility of its own.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "studio/frame/frame_renderer.h"
#include "studio/viewer/document.h"
#include "studio/viewer/progressive_reference.h"
#include "studio/viewer/technique_bank.h"

namespace penumbra::studio::viewer {

inline constexpr std::string_view referenceName = "reference";

/// What a technique did for one light.
struct LightStatistics {
    std::string light, technique;
    Statistics statistics;
};

/// All textures have the frame's size and are replaced when it changes.
struct Side {
    gl::Texture display;                         ///< as shown, RGBA8
    gl::Texture radiance;                        ///< nits, RGBA32F
    gl::Texture illuminance;                     ///< lux, R32F
    gl::Texture reach;                           ///< of the light in question: FrameRenderer::reach()
    std::vector<VisibilityBuffer> visibilities;  ///< one a light
    std::vector<LightStatistics> statistics;     ///< one a light
};

class Sides {
  public:
    Sides(Device& device, FrameRenderer& frame) : device_(device), frame_(frame) {}

    /// What the camera sees. Every side must be lit anew after it.
    void draw(const Document& document, const Camera& camera, int width_px, int height_px);

    /// Lights side `index` with technique `names[i]` for light i; "reference" takes its visibility from
    /// `truth`, or counts as unshadowed while there is none. Light `last`, the one in question, is rendered
    /// last, so that its technique can be inspected.
    void light(std::size_t index, const Document& document, const std::vector<std::string>& names,
               TechniqueBank& techniques, const ProgressiveReference::Level* truth, std::size_t last);

    const Side& side(std::size_t index) const { return sides_[index]; }

  private:
    void fit(Side& side, const std::vector<Light>& lights);
    void shadow(Side& side, Technique& technique, const std::vector<Light>& lights,
                std::span<const std::size_t> asked);

    Device& device_;
    FrameRenderer& frame_;
    std::array<Side, 2> sides_;
};

}  // namespace penumbra::studio::viewer
