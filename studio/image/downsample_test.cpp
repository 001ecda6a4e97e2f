// SPDX-License-Identifier: Apache-2.0
#include "studio/image/downsample.h"

#include <gtest/gtest.h>

namespace penumbra::studio {
namespace {

TEST(Downsampled, PixelsAreMeansOfTheirOwn) {
    Image image(4, 2, 1);
    image.values = {0, 1, 2, 3,  //
                    4, 5, 6, 7};
    const Image half = downsampled(image, 2);
    ASSERT_EQ(half.width_px, 2);
    ASSERT_EQ(half.height_px, 1);
    EXPECT_FLOAT_EQ(half.at(0, 0), 2.5f);
    EXPECT_FLOAT_EQ(half.at(1, 0), 4.5f);
}

TEST(Downsampled, LightIsAveragedNotItsEncoding) {
    Image image(2, 2, 3);
    for (int c = 0; c < 3; ++c) image.at(0, 0, c) = image.at(1, 1, c) = 1;
    // Half the light of white is 0.7354 in sRGB (IEC 61966-2-1).
    EXPECT_NEAR(downsampledSrgb(image, 2).at(0, 0, 1), 0.7354f, 1e-3f);
}

TEST(Downsampled, ByOneIsTheSame) {
    Image image(3, 1, 1);
    image.values = {0.1f, 0.2f, 0.3f};
    EXPECT_EQ(downsampled(image, 1).values, image.values);
    EXPECT_EQ(downsampledSrgb(image, 1).values, image.values);
}

}  // namespace
}  // namespace penumbra::studio
