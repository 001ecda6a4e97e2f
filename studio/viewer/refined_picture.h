// SPDX-License-Identifier: Apache-2.0
// The picture of side A once more, for a view at rest: at the window's full size, each pixel the mean of up
// to four samples of shading and visibility.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "studio/viewer/sides.h"

namespace penumbra::studio::viewer {

class RefinedPicture {
  public:
    static constexpr int mostSamplesPerAxis = 2;

    /// `shaderSourceDirectory` as in DeviceOptions.
    RefinedPicture(Device& device, const std::filesystem::path& shaderSourceDirectory)
        : frame_(device, shaderSourceDirectory), sides_(device, frame_) {}

    /// Draws it with so many samples, with technique `names[i]` for light i, none of them the reference.
    /// Exposure and lights that are seen as FrameRenderer::setExposure and showLuminaires have them.
    void draw(const Document& document, const Camera& camera, int width_px, int height_px,
              const std::vector<std::string>& names, TechniqueBank& techniques, std::size_t last,
              std::optional<float> exposureValue, bool luminairesShown);

    /// A texel a sample; shown with a linear filter they are averaged.
    const gl::Texture& texture() const { return sides_.side(0).display; }
    const Side& side() const { return sides_.side(0); }
    float exposureValue() const { return frame_.readExposureValue(); }

    void reloadShaders() { frame_.reloadShaders(); }

  private:
    FrameRenderer frame_;
    Sides sides_;
};

}  // namespace penumbra::studio::viewer
