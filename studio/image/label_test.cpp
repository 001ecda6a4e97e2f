// SPDX-License-Identifier: Apache-2.0
#include "studio/image/label.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace penumbra::studio {
namespace {

double sum(const Image& image) {
    return std::accumulate(image.values.begin(), image.values.end(), 0.0);
}

TEST(Label, DrawsTheLetterThatWasAskedFor) {
    Image image(6, 9, 1);
    drawLabel(image, 0, 0, "L");
    std::string drawn;
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 5; ++x) drawn += image.at(x, y) > 0 ? '#' : '.';
        drawn += '\n';
    }
    EXPECT_EQ(drawn, "#....\n#....\n#....\n#....\n#....\n#....\n#####\n.....\n");
}

TEST(Label, EveryPrintableCharacterIsDifferent) {
    std::set<std::vector<float>> seen;
    for (char c = ' '; c <= '~'; ++c) {
        Image image(6, 9, 1);
        drawLabel(image, 0, 0, std::string(1, c));
        EXPECT_TRUE(seen.insert(image.values).second) << c;
    }
}

TEST(Label, AScaleOfThreeCoversNineTimesAsMuch) {
    Image small(40, 40, 1), large(40, 40, 1);
    drawLabel(small, 0, 0, "Q7");
    drawLabel(large, 0, 0, "Q7", 3);
    EXPECT_DOUBLE_EQ(sum(large), 9 * sum(small));
}

TEST(Label, IsCutAtTheEdges) {
    Image image(8, 8, 4);
    drawLabel(image, -3, -3, "##\n##", 2, {1, 0, 0});
    drawLabel(image, 1000, 1000, "x");
    EXPECT_GT(sum(image), 0);
}

TEST(Label, ACharacterOutsideAsciiIsOneBox) {
    Image box(12, 9, 1), letter(12, 9, 1);
    drawLabel(box, 0, 0, "\x01");
    drawLabel(letter, 0, 0, "\xC3\xA9");
    EXPECT_EQ(box.values, letter.values);
}

TEST(ContactSheet, PlacesEveryPicture) {
    const std::vector<LabelledImage> cells{
        {"a", Image(10, 6, 1, 1.0f)}, {"b", Image(8, 8, 3, 0.5f)}, {"c", Image(10, 8, 1, 0.25f)}};
    const Image sheet = contactSheet(cells, 2, 1);
    EXPECT_EQ(sheet.width_px, 2 * 10 + 3 * 4);
    EXPECT_EQ(sheet.height_px, 2 * (8 + 13 + 4) + 4);
    EXPECT_EQ(sheet.channels, 3);
    EXPECT_EQ(sheet.at(4, 4 + 13), 1.0f);
    EXPECT_EQ(sheet.at(4 + 14, 4 + 13, 2), 0.5f);
    EXPECT_EQ(sheet.at(4 + 9, 4 + 25 + 13 + 7), 0.25f);
    EXPECT_EQ(contactSheet({}, 3).pixelCount(), 0u);
}

}  // namespace
}  // namespace penumbra::studio
