// SPDX-License-Identifier: Apache-2.0
#include "studio/image/image_io.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/test_folder.h"

namespace penumbra::studio {
namespace {

Image noise(int width, int height, int channels) {
    Image image(width, height, channels);
    std::mt19937 random(7);
    for (float& value : image.values) value = float(random()) / 4294967296.0f;
    return image;
}

std::vector<std::uint32_t> bitsOf(const std::vector<float>& values) {
    std::vector<std::uint32_t> bits;
    for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
    return bits;
}

TEST(Exr, RoundTripIsBitIdentical) {
    const TestFolder folder;
    Image v = noise(37, 23, 1);
    v.values[0] = std::numeric_limits<float>::infinity();
    v.values[1] = std::numeric_limits<float>::quiet_NaN();
    v.values[2] = -0.0f;
    v.values[3] = 1e-42f;
    const Image colored = noise(37, 23, 3);

    ExrPicture picture{.width_px = 37, .height_px = 23, .channels = channelsOf(v, "key.V")};
    for (ExrChannel& channel : channelsOf(colored, "window.V"))
        picture.channels.push_back(std::move(channel));
    picture.metadata = {{"Software", "Penumbra"}, {"penumbra:command", "render \xC3\xA9"}};
    writeExr(folder / "v.exr", picture);

    const ExrPicture back = readExr(folder / "v.exr");
    EXPECT_EQ(back.channels.size(), 4u);
    EXPECT_EQ(bitsOf(imageOf(back, "key.V").values), bitsOf(v.values));
    EXPECT_EQ(imageOf(back, "window.V").values, colored.values);
    EXPECT_EQ(back.metadata, picture.metadata);
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(Exr, ChannelNames) {
    EXPECT_EQ(channelsOf(Image(1, 1, 1), "V").at(0).name, "V");
    EXPECT_EQ(channelsOf(Image(1, 1, 4), "").at(3).name, "A");
    EXPECT_EQ(channelsOf(Image(1, 1, 3), "sky.V").at(1).name, "sky.V.G");
    EXPECT_THROW(imageOf(ExrPicture{.width_px = 1, .height_px = 1}, "V"), InputError);
}

TEST(Exr, RefusesWithTheRightError) {
    const TestFolder folder;
    ExrPicture picture{.width_px = 2, .height_px = 2, .channels = channelsOf(Image(2, 2, 1), "V")};
    EXPECT_THROW(writeExr(folder / "missing" / "v.exr", picture), OutputError);
    picture.metadata = {{"channels", "reserved"}};
    EXPECT_THROW(writeExr(folder / "v.exr", picture), OutputError);
    EXPECT_EQ(folder.fileCount(), 0);
    writeFileAtomically(folder / "text.exr", "this is no picture");
    EXPECT_THROW(readExr(folder / "text.exr"), InputError);
}

TEST(Exr, ACutFileIsAnInputError) {
    const TestFolder folder;
    writeExr(folder / "v.exr",
             {.width_px = 64, .height_px = 64, .channels = channelsOf(noise(64, 64, 1), "V")});
    std::vector<std::byte> bytes = readWholeFile(folder / "v.exr");
    for (const std::size_t size : {std::size_t(6), std::size_t(100), bytes.size() / 2, bytes.size() - 1}) {
        writeFileAtomically(folder / "cut.exr", std::span(bytes).first(size));
        EXPECT_THROW(readExr(folder / "cut.exr"), InputError) << size;
    }
}

TEST(Png, RoundTripOfEightBits) {
    const TestFolder folder;
    for (const int channels : {1, 3, 4}) {
        Image image = noise(19, 11, channels);
        for (float& value : image.values) value = std::round(value * 255.0f) / 255.0f;
        const Metadata metadata{{"Software", "Penumbra"}, {"penumbra:command", "render caf\xC3\xA9"}};
        writePng(folder / "a.png", image, metadata);
        const PngPicture back = readPng(folder / "a.png");
        EXPECT_EQ(back.image.channels, channels);
        EXPECT_EQ(back.image.values, image.values);
        EXPECT_EQ(back.metadata, metadata);
    }
}

TEST(Png, ClampsAndRounds) {
    const TestFolder folder;
    Image image(4, 1, 1);
    image.values = {-1.0f, 2.0f, 0.5f / 255.0f, 0.49f / 255.0f};
    writePng(folder / "a.png", image);
    EXPECT_EQ(readPng(folder / "a.png").image.values, (std::vector<float>{0, 1, 1 / 255.0f, 0}));
}

TEST(Png, RefusesWithTheRightError) {
    const TestFolder folder;
    Image image(4, 3, 3);
    EXPECT_THROW(writePng(folder / "missing" / "a.png", image), OutputError);
    EXPECT_THROW(writePng(folder / "a.png", image, {{"", "empty key"}}), OutputError);
    EXPECT_THROW(writePng(folder / "a.png", Image(0, 0, 3)), OutputError);
    image.at(2, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    try {
        writePng(folder / "a.png", image);
        FAIL() << "a NaN was written";
    } catch (const OutputError& error) {
        EXPECT_NE(std::string(error.what()).find("(2, 1)"), std::string::npos) << error.what();
    }
    EXPECT_EQ(folder.fileCount(), 0);
}

TEST(Png, ACutFileIsAnInputError) {
    const TestFolder folder;
    writePng(folder / "a.png", noise(32, 32, 3));
    std::vector<std::byte> bytes = readWholeFile(folder / "a.png");
    for (const std::size_t size : {std::size_t(0), std::size_t(9), std::size_t(60), bytes.size() / 2}) {
        writeFileAtomically(folder / "cut.png", std::span(bytes).first(size));
        EXPECT_THROW(readPng(folder / "cut.png"), InputError) << size;
    }
}

}  // namespace
}  // namespace penumbra::studio
