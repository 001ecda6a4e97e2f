// SPDX-License-Identifier: Apache-2.0
#include "studio/image/picture_decode.h"

#include <gtest/gtest.h>

#include <random>

#include "studio/errors.h"
#include "studio/image/test_pictures.h"

namespace penumbra::studio {
namespace {

using Rgba = std::vector<std::uint8_t>;

Picture decoded(const std::string& bytes) {
    return decodePicture(std::as_bytes(std::span(bytes)), "leaf.png");
}

std::string refusal(const std::string& bytes) {
    try {
        decoded(bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(PictureDecode, TurnsEveryKindOfPngIntoRgba8) {
    EXPECT_EQ(decoded(encodedPng(2, 1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3, 4, 5, 6})).rgba,
              (Rgba{1, 2, 3, 255, 4, 5, 6, 255}));
    EXPECT_EQ(decoded(encodedPng(1, 2, 8, PNG_COLOR_TYPE_RGB_ALPHA, {1, 2, 3, 4, 5, 6, 7, 8})).rgba,
              (Rgba{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(decoded(encodedPng(1, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {9, 8})).rgba, (Rgba{9, 9, 9, 8}));
    EXPECT_EQ(decoded(encodedPng(4, 1, 1, PNG_COLOR_TYPE_GRAY, {0b10100000})).rgba,
              (Rgba{255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255}));
    EXPECT_EQ(decoded(encodedPng(3, 1, 2, PNG_COLOR_TYPE_PALETTE, {0b00011000})).rgba,
              (Rgba{255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 255}));
    EXPECT_EQ(decoded(encodedPng(1, 1, 16, PNG_COLOR_TYPE_RGB, {0xff, 0xff, 0x80, 0x80, 0, 0})).rgba,
              (Rgba{255, 128, 0, 255}));
}

TEST(PictureDecode, IgnoresGammaAsGltfDemands) {
    EXPECT_EQ(decoded(encodedPng(1, 1, 8, PNG_COLOR_TYPE_GRAY, {100}, 1.0)).rgba, (Rgba{100, 100, 100, 255}));
}

TEST(PictureDecode, ReadsColourAndGreyJpegsButNoCmyk) {
    const Picture picture = decoded(encodedJpeg(20, 10, {200, 100, 50}));
    EXPECT_EQ(picture.width_px, 20);
    EXPECT_EQ(picture.height_px, 10);
    ASSERT_EQ(picture.rgba.size(), 800u);
    EXPECT_NEAR(picture.rgba[0], 200, 3);
    EXPECT_NEAR(picture.rgba[797], 100, 3);
    EXPECT_EQ(picture.rgba[3], 255);
    EXPECT_NEAR(decoded(encodedJpeg(8, 8, {77})).rgba[2], 77, 1);
    EXPECT_NE(refusal(encodedJpeg(8, 8, {1, 2, 3, 4})).find("CMYK"), std::string::npos);
}

TEST(PictureDecode, RefusesHugePicturesByTheirHeader) {
    EXPECT_NE(refusal(pngThatClaims(16385, 1)).find("16385 x 1"), std::string::npos);
    EXPECT_NE(refusal(pngThatClaims(16384, 16384)).find("16384 x 16384"), std::string::npos);
    EXPECT_NE(refusal(pngThatClaims(8192, 8192)).find("would grow"), std::string::npos);
    EXPECT_NE(refusal(pngThatClaims(0x7fffffff, 0x7fffffff)), "");
}

TEST(PictureDecode, NamesWhatItRefuses) {
    EXPECT_NE(refusal("").find("leaf.png"), std::string::npos);
    EXPECT_NE(refusal("GIF89a").find("neither PNG nor JPEG nor WebP"), std::string::npos);
    const std::string png = encodedPng(1, 2, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3, 4, 5, 6});
    EXPECT_NE(refusal(png.substr(0, png.size() - 14)).find("damaged"), std::string::npos);
    const std::string jpeg = encodedJpeg(64, 64, {10, 200, 10});
    EXPECT_NE(refusal(jpeg.substr(0, jpeg.size() - 20)).find("damaged"), std::string::npos);
}

TEST(PictureDecode, SurvivesMutation) {
    std::mt19937 random(1);
    for (const std::string& original :
         {encodedPng(3, 1, 2, PNG_COLOR_TYPE_PALETTE, {0b00011000}), encodedJpeg(32, 16, {200, 100, 50})})
        for (int i = 0; i < 400; ++i) {
            std::string bytes = original;
            for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = char(random());
            refusal(bytes);  // anything but an InputError fails the test
        }
}

}  // namespace
}  // namespace penumbra::studio
