// SPDX-License-Identifier: Apache-2.0
// The window compared with the truth, and what it tells of each pixel.

#include <algorithm>

#include "studio/image/image_io.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

TEST_F(ViewerTest, TheTruthConvergesAndJudges) {
    start("two-boxes");
    session().choices().referenceRuns = true;
    session().choices().referenceSamples = 64;
    session().changedView();
    framesUntil([&] { return session().truth() && session().truth()->samples == 64; });
    const auto& metrics = session().metrics(0);
    ASSERT_TRUE(metrics);
    EXPECT_GT(metrics->penumbra_rmse, 0.1) << "hard edges in a penumbra";
    // What is shown is what `compare` would say.
    const Side& side = session().side(0);
    const Image reach = readTexture(side.reach.name(), session().width_px(), session().height_px(), 1);
    std::vector<std::uint8_t> mask;
    for (const float value : reach.values) mask.push_back(value > 0);
    const VisibilityMetrics expected =
        compareVisibility(session().truth()->lights[0].visibility,
                          session().frame().readVisibility(side.visibilities[0]), mask);
    EXPECT_EQ(metrics->rmse, expected.rmse);
    EXPECT_LT(session().truth()->lights[0].noise_rms, 0.05);
    EXPECT_TRUE(session().isCertain(11 * session().truth()->lights[0].noise_rms));
    EXPECT_FALSE(session().isCertain(9 * session().truth()->lights[0].noise_rms)) << "is told in grey";
    const auto level = session().truth();
    drag(0.3, 0.6, 0.4, 0.6);  // another view: what was true is not any more
    EXPECT_NE(session().truth(), level);
}

TEST_F(ViewerTest, WipeFlipAndDifference) {
    start("two-boxes");
    const Image hard = picture();
    key("shift+2");
    key("2");
    const Image pcf = picture();
    key("1");
    key("c");
    ASSERT_TRUE(session().choices().comparing);
    const int middle = session().canvasOptions().firstColumnOfB;
    EXPECT_NEAR(middle, session().width_px() / 2, 1);
    const auto isLeft = [&](const Image& shown, const Image& side, bool left) {
        for (int y = 0; y < shown.height_px; ++y) {
            for (int x = left ? 0 : middle; x < (left ? middle : shown.width_px); ++x) {
                if (shown.at(x, y) != side.at(x, y)) return false;
            }
        }
        return true;
    };
    EXPECT_TRUE(isLeft(canvas(), hard, true));
    EXPECT_TRUE(isLeft(canvas(), pcf, false));
    drag(0.5, 0.5, 0.25, 0.5);  // the line itself
    EXPECT_NEAR(session().choices().wipe, 0.25, 0.01);

    Display::input("keydown Tab");
    frames();
    EXPECT_EQ(largestDifference(canvas(), pcf), 0);
    Display::input("keyup Tab");
    key("c");
    EXPECT_EQ(largestDifference(canvas(), hard), 0);

    key("x");
    const Image difference = canvas();
    const Image a = session().frame().readVisibility(session().side(0).visibilities[0]);
    const Image b = session().frame().readVisibility(session().side(1).visibilities[0]);
    int lighter = 0, darker = 0;
    for (int y = 0; y < a.height_px; ++y) {
        for (int x = 0; x < a.width_px; ++x) {
            const float d = a.at(x, y) - b.at(x, y), red = difference.at(x, y, 0),
                        blue = difference.at(x, y, 2);
            if (d > 0.2f) lighter += red > blue + 0.2f;
            if (d < -0.2f) darker += blue > red + 0.2f;
            if (d == 0) {
                ASSERT_NEAR(red, blue, 0.12f) << x << " " << y;
            }
        }
    }
    EXPECT_GT(lighter, 20);
    EXPECT_GT(darker, 20);
    EXPECT_GT(shareOfDifferent(difference, hard), 0.1);
}

TEST_F(ViewerTest, FalseColoursAreTheNumbers) {
    start("half-plane", "exact");
    key("v");
    const Image shown = canvas();
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities[0]);
    const Image reach = readTexture(session().side(0).reach.name(), shown.width_px, shown.height_px, 1);
    int checked = 0;
    for (int y = 0; y < shown.height_px; y += 5) {
        for (int x = 0; x < shown.width_px; x += 5) {
            if (reach.at(x, y) <= 0) continue;
            const auto color = orderedColor(std::round(visibility.at(x, y) * 255) / 255);
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown.at(x, y, c), color[std::size_t(c)], 1.1f / 255);
            ++checked;
        }
    }
    EXPECT_GT(checked, 100);
}

TEST_F(ViewerTest, IlluminanceIsInLux) {
    start("half-plane");
    // Nothing between the floor and a disk of 1,000 nits, radius 0.5 m, 4 m above: E = pi L r^2 / (r^2 +
    // h^2).
    Light disk = diskLight("disk", 0.5f, {0, 4, 0}, {0, 0, 0}, 1);
    disk.emission = {Emission::Unit::nits, glm::vec3(1000)};
    disk.castsShadow = false;
    session().editLights({disk});
    key("i");
    const Image lux =
        readTexture(session().side(0).illuminance.name(), session().width_px(), session().height_px(), 1);
    EXPECT_NEAR(std::ranges::max(lux.values), std::acos(-1.0) * 1000 * 0.25 / 16.25, 0.3);
    EXPECT_EQ(session().canvasOptions().range.max, 50);
    EXPECT_TRUE(session().canvasOptions().logarithmic);
    const Image withLines = canvas();
    clickWidget("isolines", 0.1);
    EXPECT_GT(shareOfDifferent(withLines, canvas()), 0.002);
    EXPECT_LT(shareOfDifferent(withLines, canvas()), 0.2);
}

TEST_F(ViewerTest, IlluminanceStartsOnAScaleThatShowsSomething) {
    start("half-plane");
    // A lamp just over the floor: its spot is a thousand times as bright as most of the floor.
    Light lamp = diskLight("lamp", 0.02f, {2, 0.05f, 2}, {2, 0, 2}, 1);
    lamp.emission = {Emission::Unit::nits, glm::vec3(1e6f)};
    session().editLights({lamp});
    key("i");
    const CanvasOptions options = session().canvasOptions();
    EXPECT_TRUE(options.logarithmic);
    EXPECT_GT(options.range.min, 0);
    EXPECT_GE(options.range.max, 4.99f * options.range.min);
    const Image shown = canvas();
    std::vector<int> lightness(8, 0);
    for (std::size_t i = 0; i < shown.pixelCount(); ++i)
        ++lightness[std::size_t(std::min(7.99f, 8 * shown.values[3 * i + 1]))];
    const auto used = std::ranges::count_if(lightness, [](int pixels) { return pixels > 50; });
    EXPECT_GE(used, 4) << "colours are spread over the picture";
}

TEST_F(ViewerTest, IsolinesCarryNumbersAndTraceNoOutlines) {
    start("two-boxes");
    // From above nothing differs along a surface but a little: what lines there were, were outlines.
    Light sky = distantLight("sky", 0.5f, {0, -1, 0.001f}, 1500);
    sky.castsShadow = false;
    session().editLights({sky});
    key("i");
    const auto linePixels = [&] {
        const gl::Texture& lines = session().canvas().isolines();
        const Image levels = readTexture(lines.name(), lines.width_px(), lines.height_px(), 1);
        return std::ranges::count_if(levels.values, [](float level) { return level > 0; });
    };
    EXPECT_EQ(linePixels(), 0);
    EXPECT_TRUE(session().isolineNumbers().empty());

    Light lamp = diskLight("lamp", 0.2f, {0, 2.5f, 0}, {0, 0, 0}, 900);
    lamp.castsShadow = false;
    session().editLights({lamp});
    frames();
    EXPECT_GT(linePixels(), 50);
    ASSERT_FALSE(session().isolineNumbers().empty());
    const Image lux =
        readTexture(session().side(0).illuminance.name(), session().width_px(), session().height_px(), 1);
    for (const IsolineNumber& number : session().isolineNumbers()) {
        // Of the pixel's and those to the right and above, between which the line runs.
        const int right = std::min(number.x + 1, lux.width_px - 1), above = std::max(number.y - 1, 0);
        const auto [least, most] =
            std::minmax({lux.at(number.x, number.y), lux.at(right, number.y), lux.at(number.x, above)});
        EXPECT_LE(least, number.lux * 1.001f);
        EXPECT_GE(most, number.lux * 0.999f);
    }
}

TEST_F(ViewerTest, APickAnswersFirstForWhatIsShownAndCanBeStopped) {
    start("two-boxes", "pcf");
    click(to(0.5, 0.6));
    framesUntil([&] { return session().picker().result() && !session().picker().result()->answers.empty(); });
    EXPECT_EQ(session().picker().result()->answers.front().technique, "pcf");
    clickWidget("Stop asking");
    const std::size_t answers = session().picker().result()->answers.size();
    EXPECT_LT(answers, techniqueCatalog().size());
    frames();
    EXPECT_FALSE(session().picker().busy());
    EXPECT_EQ(session().picker().result()->answers.size(), answers);
    key("Escape");
    EXPECT_FALSE(session().picker().result());
}

TEST_F(ViewerTest, BuffersAreShown) {
    start("two-boxes");
    const std::vector<InspectedTexture> buffers = session().inspected();
    const auto depthMap = std::ranges::find(buffers, "depth map", &InspectedTexture::name);
    ASSERT_NE(depthMap, buffers.end());
    for (const InspectedTexture& buffer : buffers) {
        session().inspect(buffer, 0);
        const gl::Texture& shown = session().inspection().texture();
        const Image image = readTexture(shown.name(), shown.width_px(), shown.height_px(), 3);
        EXPECT_NE(std::ranges::min(image.values), std::ranges::max(image.values)) << buffer.name;
    }
}

TEST_F(ViewerTest, APickAsksEveryoneAndEveryBufferIsShown) {
    start("two-boxes");
    cheapen();
    // A pixel in the penumbra, found by the exact technique.
    chooseTechnique(session(), "exact");
    frames();
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities[0]);
    const auto half = std::ranges::find_if(visibility.values, [](float v) { return v > 0.4f && v < 0.6f; });
    ASSERT_NE(half, visibility.values.end());
    const auto index = int(half - visibility.values.begin());
    const int x = index % visibility.width_px, y = index / visibility.width_px;
    click(to((x + 0.5) / visibility.width_px, (y + 0.5) / visibility.height_px));
    framesUntil([&] { return !session().picker().busy(); });
    const std::optional<Pick>& pick = session().picker().result();
    ASSERT_TRUE(pick);
    EXPECT_EQ(pick->x, x);
    EXPECT_EQ(pick->y, y);
    EXPECT_NEAR(*pick->truth, *half, 0.03);
    ASSERT_EQ(pick->answers.size(), techniqueCatalog().size());
    for (const Pick::Answer& answer : pick->answers) {
        if (answer.technique == "exact") {
            EXPECT_EQ(answer.visibility, *half);
        } else if (answer.technique == "hard") {
            EXPECT_TRUE(answer.visibility == 0 || answer.visibility == 1);
        }
    }
    EXPECT_GT(pick->illuminance_lux, 0);
    // The light, half of it behind something: bright and red pixels, about as many.
    const gl::Texture& view = session().picker().lightView();
    const Image seen = readTexture(view.name(), view.width_px(), view.height_px(), 3);
    int bright = 0, blocked = 0;
    for (std::size_t i = 0; i < seen.pixelCount(); ++i) {
        bright += seen.values[3 * i] > 0.95f;
        blocked += seen.values[3 * i] > 2 * seen.values[3 * i + 1] && seen.values[3 * i] > 0.15f;
    }
    ASSERT_GT(bright + blocked, 1000);
    // Solid angle against area, and pixels of a perspective: near for a light that is small from here.
    EXPECT_NEAR(double(bright) / (bright + blocked), *half, 0.1);
    key("Escape");
    EXPECT_FALSE(session().picker().result());

    // All techniques are there now: whatever they left behind can be looked at.
    for (const TechniqueInfo& info : techniqueCatalog()) {
        chooseTechnique(session(), std::string(info.name));
        frames(1);
        for (const InspectedTexture& buffer : session().inspected()) {
            session().inspect(buffer, buffer.layers - 1);
        }
        EXPECT_EQ(session().problem(), "") << info.name;
    }
}

}  // namespace
}  // namespace penumbra::studio::viewer
