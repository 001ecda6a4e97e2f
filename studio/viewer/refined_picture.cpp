// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/refined_picture.h"

namespace penumbra::studio::viewer {

void RefinedPicture::draw(const Document& document, const Camera& camera, int width_px, int height_px,
                          const std::vector<std::string>& names, TechniqueBank& techniques, std::size_t last,
                          std::optional<float> exposureValue, bool luminairesShown) {
    frame_.setExposure(exposureValue);
    frame_.showLuminaires(luminairesShown);
    sides_.draw(document, camera, width_px, height_px);
    sides_.light(0, document, names, techniques, nullptr, last);
}

}  // namespace penumbra::studio::viewer
