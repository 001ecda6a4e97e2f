// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/test_profiles.h"

namespace penumbra::studio::testing {
namespace {

LightProfile read(const EulumdatText& file) {
    return parseEulumdat(file.text(), "lamp.ldt");
}

std::string errorOf(const std::string& text) {
    try {
        parseEulumdat(text, "lamp.ldt");
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// Different in all four quarters.
double lobed(double gamma, double c) {
    return 100 * cosine(gamma) * (2 + sine(c) + 0.5 * cosine(c));
}

TEST(Eulumdat, SymmetriesHaveTheirPlanes) {
    struct Case {
        int symmetry;
        std::vector<double> planes;
        double (*seen)(double c);  // as which of the planes with values a plane is seen
    };
    for (const Case& c : std::vector<Case>{
             {0, steps(0, 345, 15), [](double c) { return c; }},
             {1, {0}, [](double) { return 0.0; }},
             {2, steps(0, 180, 15), [](double c) { return c > 180 ? 360 - c : c; }},
             {3, steps(270, 450, 15), [](double c) { return c > 90 && c < 270 ? 180 - c : c; }},
             {4, steps(0, 90, 15),
              [](double c) { return c > 270   ? 360 - c
                                    : c > 180 ? c - 180
                                    : c > 90  ? 180 - c
                                              : c; }},
         }) {
        EulumdatText file;
        file.symmetry = c.symmetry;
        file.planesWithValues = c.planes;
        file.candela = lobed;
        const LightProfile profile = read(file);
        for (const double plane : steps(0, 345, 15))
            EXPECT_NEAR(candelaAt(profile, 45, plane), lobed(45, c.seen(plane)), 1e-2)
                << c.symmetry << " " << plane;
    }
}

EulumdatText rotational() {
    EulumdatText file;
    file.symmetry = 1;
    file.planesWithValues = {0};
    file.candela = [](double gamma, double) { return 100 * cosine(gamma); };
    return file;
}

TEST(Eulumdat, CandelaAreForAThousandLumensOfTheSet) {
    EulumdatText file = rotational();
    file.factor = "1,5";
    file.sets = {"2\nT16\n4800\n4000\n80\n70"};
    EXPECT_NEAR(read(file).grid.largest(), 100 * 1.5 * 4.8, 1e-3);
    EXPECT_EQ(read(file).lampLumens, 4800);
    file.sets = {"-2\nLED\n4800\n4000\n80\n70"};  // absolute, and scaled all the same
    EXPECT_NEAR(read(file).grid.largest(), 100 * 1.5 * 4.8, 1e-3);
    EXPECT_FALSE(read(file).lampLumens);
    file.sets = {"1\nT16\n4800\n4000\n80\n70", "1\nT16 eco\n3000\n4000\n80\n50"};
    EXPECT_NEAR(read(file).grid.largest(), 100 * 1.5 * 4.8, 1e-3);
    EXPECT_EQ(read(file).warnings.size(), 1u);
}

TEST(Eulumdat, OpeningsLieAlongC90) {
    EulumdatText file = rotational();
    EXPECT_DOUBLE_EQ(read(file).opening.x_m, 0.3);
    EXPECT_DOUBLE_EQ(read(file).opening.y_m, 0.6);
    file.width = "0";  // round
    EXPECT_EQ(read(file).opening.name(), "circle");
    EXPECT_DOUBLE_EQ(read(file).opening.x_m, 0.6);
    file.heights = "20\n20\n50\n20";
    EXPECT_EQ(read(file).opening.name(), "upright cylinder");
    EXPECT_DOUBLE_EQ(read(file).opening.z_m, 0.05);
}

TEST(Eulumdat, FormIsFree) {
    EulumdatText file = rotational();
    const LightProfile expected = read(file);
    file.lineEnd = "\n";
    EXPECT_EQ(read(file).grid.candela, expected.grid.candela);
    std::string points = file.text();
    for (char& c : points) c = c == ',' ? '.' : c;
    EXPECT_EQ(parseEulumdat(points, "lamp.ldt").grid.candela, expected.grid.candela);
    EXPECT_EQ(parseEulumdat("\xef\xbb\xbf" + points + "\n\n", "lamp.ldt").grid.candela,
              expected.grid.candela);
}

TEST(Eulumdat, WhatHasNoMeaningIsTurnedDown) {
    const auto error = [](auto change) {
        EulumdatText file = rotational();
        change(file);
        return errorOf(file.text());
    };
    using File = EulumdatText;
    EXPECT_EQ(error([](File&) {}), "accepted");
    EXPECT_EQ(error([](File& f) { f.symmetry = 7; }),
              "lamp.ldt:3: the symmetry (Isym) must be a whole number from 0 to 4, not 7");
    EXPECT_NE(error([](File& f) { f.sets = {"1\nLED\n0\n4000\n80\n20"}; }).find("lamp.ldt:29:"),
              std::string::npos);
    EXPECT_NE(error([](File& f) { f.factor = "0"; }).find("lamp.ldt:24:"), std::string::npos);
    EXPECT_NE(error([](File& f) { f.factor = "nan"; }).find("must be a number"), std::string::npos);
    EXPECT_NE(error([](File& f) { f.length = "-5"; }).find("lamp.ldt:16:"), std::string::npos);
    EXPECT_NE(error([](File& f) { f.gammas = {0, 10, 10, 20}; }).find("must increase"), std::string::npos);
    EXPECT_NE(error([](File& f) { f.gammas = {0, 190}; }).find("from 0 to 180"), std::string::npos);
    EXPECT_NE(error([](File& f) { f.candela = [](double, double) { return -1.0; }; }).find("negative"),
              std::string::npos);
    EXPECT_NE(error([](File& f) { f.planes = 6, f.symmetry = 3; }).find("cannot have the symmetry"),
              std::string::npos);
    const std::string whole = rotational().text();
    for (std::size_t length = 0; length + 10 < whole.size(); length += 7)
        EXPECT_NE(errorOf(whole.substr(0, length)), "accepted") << length;
}

}  // namespace
}  // namespace penumbra::studio::testing
