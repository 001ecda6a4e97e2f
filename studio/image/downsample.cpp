// SPDX-License-Identifier: Apache-2.0
#include "studio/image/downsample.h"

#include <cassert>
#include <glm/glm.hpp>
#include <glm/gtc/color_space.hpp>

namespace penumbra::studio {

Image downsampled(const Image& image, int factor) {
    assert(factor >= 1 && image.width_px % factor == 0 && image.height_px % factor == 0);
    if (factor == 1) return image;
    Image result(image.width_px / factor, image.height_px / factor, image.channels);
    const float share = 1.0f / float(factor * factor);
    for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
            for (int c = 0; c < image.channels; ++c)
                result.at(x / factor, y / factor, c) += share * image.at(x, y, c);
        }
    }
    return result;
}

Image downsampledSrgb(Image image, int factor) {
    if (factor == 1) return image;
    for (float& value : image.values) value = glm::convertSRGBToLinear(glm::vec3(value)).x;
    Image result = downsampled(image, factor);
    for (float& value : result.values) value = glm::convertLinearToSRGB(glm::vec3(value)).x;
    return result;
}

}  // namespace penumbra::studio
