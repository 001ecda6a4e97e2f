// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "studio/scene/profiles/test_profiles.h"

namespace penumbra::studio::testing {
namespace {

constexpr double pi = std::numbers::pi;

Lm63Text lambertian() {
    Lm63Text file;
    file.verticals = steps(0, 90, 5);
    file.horizontals = {0};
    file.candela = [](double v, double) { return 100 * cosine(v); };
    return file;
}

TEST(Lm63, FluxIsTheIntegral) {
    Lm63Text file;
    file.verticals = {0, 90, 180};
    file.horizontals = {0};
    file.candela = [](double, double) { return 100; };
    EXPECT_NEAR(readLm63(file).grid.integral(), 400 * pi, 1e-3);  // isotropic: 1256.64

    file = lambertian();
    file.verticals = steps(0, 90, 1);
    EXPECT_NEAR(readLm63(file).grid.integral(), 100 * pi, 0.002 * 100 * pi);  // 314.16

    file.type = 2;
    file.verticals = steps(-90, 90, 2.5);
    file.horizontals = file.verticals;
    file.candela = [](double v, double h) {
        return 100 * std::pow(cosine(v), 2) * std::pow(cosine(h), 4) * (1 + 0.5 * sine(v));
    };
    EXPECT_NEAR(readLm63(file).grid.integral(), 167.55, 0.002 * 167.55);
    file.horizontals = steps(0, 90, 2.5);  // left and right alike
    EXPECT_NEAR(readLm63(file).grid.integral(), 167.55, 0.002 * 167.55);
}

/// By the midpoints of a fine grid, which knows nothing of symmetries.
double fluxOf(const CandelaGrid& grid) {
    constexpr int n = 360;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            const double gamma = 180 * (i + 0.5) / n, c = 360 * (j + 0.5) / (2 * n);
            sum += sine(gamma) * grid.at(directionOf(gamma, c));
        }
    return sum * (pi / n) * (pi / n);
}

TEST(Lm63, EverySymmetryHasTheFluxOfWhatItShows) {
    const auto lobed = [](double v, double h) { return 100 * cosine(v / 2) * (1.5 + cosine(2 * h)); };
    for (const auto& [first, last] :
         std::vector<std::pair<double, double>>{{0, 90}, {0, 180}, {90, 270}, {0, 345}, {0, 360}}) {
        Lm63Text file;
        file.verticals = steps(0, 180, 15);
        file.horizontals = steps(first, last, 15);
        file.candela = lobed;
        const CandelaGrid grid = readLm63(file).grid;
        EXPECT_NEAR(grid.integral(), fluxOf(grid), 1e-3 * grid.integral()) << first << " " << last;
        for (const double c : {0.0, 20.0, 97.0, 181.0, 266.0, 300.0, 359.0})
            EXPECT_NEAR(grid.at(directionOf(60, c)), lobed(60, c), 5) << first << " " << last << " " << c;
    }
    for (const int type : {2, 3}) {
        Lm63Text file;
        file.type = type;
        file.verticals = steps(-90, 30, 10);
        file.horizontals = steps(type == 2 ? -90 : -180, 60, 10);
        file.candela = [](double v, double h) { return 400 + v + h; };
        const CandelaGrid grid = readLm63(file).grid;
        EXPECT_NEAR(grid.integral(), fluxOf(grid), 2e-3 * grid.integral()) << type;
    }
}

TEST(Lm63, HalvesAreMirroredAndNotTurned) {
    Lm63Text file;
    file.verticals = {0, 90};
    file.horizontals = {90, 180, 270};
    file.candela = [](double v, double h) { return v == 0 ? 100 : h; };
    const LightProfile profile = readLm63(file);
    // C as 180 - C: C0 is C180 and C45 is C135. C90 is what the file says, and not C270.
    EXPECT_NEAR(candelaAt(profile, 90, 0), 180, 1e-9);
    EXPECT_NEAR(candelaAt(profile, 90, 45), 135, 1e-9);
    EXPECT_NEAR(candelaAt(profile, 90, 90), 90, 1e-9);
    EXPECT_NEAR(candelaAt(profile, 90, 270), 270, 1e-9);
    EXPECT_NEAR(candelaAt(profile, 90, 315), 225, 1e-9);

    file.horizontals = {0, 90, 180};
    EXPECT_NEAR(candelaAt(readLm63(file), 90, 330), 30, 1e-9);  // C as 360 - C
}

TEST(Lm63, AxesOfTheThreeTypes) {
    // Candela are read where the file's angles point; each value says which of them it is.
    Lm63Text file;
    file.verticals = steps(-90, 90, 10);
    file.horizontals = steps(-90, 90, 10);
    file.candela = [](double v, double h) { return 1000 + 2 * v + h; };
    file.type = 2;
    const CandelaGrid b = readLm63(file).grid;
    EXPECT_NEAR(b.at({0, 0, -1}), 1000, 1e-4);
    EXPECT_NEAR(b.at({sine(40), 0, -cosine(40)}), 1080, 1e-4);   // V towards +X
    EXPECT_NEAR(b.at({0, -sine(30), -cosine(30)}), 1030, 1e-4);  // H towards -Y
    EXPECT_EQ(b.at({0, 0, 1}), 0);
    file.type = 3;
    const CandelaGrid a = readLm63(file).grid;
    EXPECT_NEAR(a.at({1, 0, 0}), 1000, 1e-4);
    EXPECT_NEAR(a.at({cosine(50), 0, -sine(50)}), 900, 1e-4);
    EXPECT_NEAR(a.at({cosine(20), -sine(20), 0}), 1020, 1e-4);
    EXPECT_EQ(a.at({-1, 0, 0}), 0);
}

TEST(Lm63, NothingOutsideTheVerticalRange) {
    Lm63Text file = lambertian();
    file.verticals = {90, 120, 180};  // an uplight
    file.candela = [](double, double) { return 50; };
    const LightProfile up = readLm63(file);
    EXPECT_EQ(candelaAt(up, 89.9, 0), 0);
    EXPECT_EQ(candelaAt(up, 90.1, 0), 50);
    EXPECT_NEAR(up.grid.integral(), 2 * pi * 50, 1e-6);
    file.verticals = {0, 40};
    EXPECT_EQ(candelaAt(readLm63(file), 40.1, 0), 0);
}

TEST(Lm63, LinearBetweenTheAngles) {
    // A cut-off: what is smoother than the file overshoots before it.
    Lm63Text file = lambertian();
    file.verticals = {0, 10, 20, 30, 40, 90};
    file.candela = [](double v, double) { return v <= 30 ? 1000 : 0; };
    const LightProfile profile = readLm63(file);
    for (double gamma = 0; gamma <= 90; gamma += 0.5) EXPECT_LE(candelaAt(profile, gamma, 0), 1000 + 1e-9);
    EXPECT_NEAR(candelaAt(profile, 36, 0), 400, 1e-9);
}

TEST(Lm63, TheSecondFactorIsTheVersionsOwn) {
    Lm63Text file = lambertian();
    file.multiplier = "2";
    file.factors = "0.9 1.1 50";
    const auto largest = [&](const std::string& first) {
        file.first = first;
        return double(readLm63(file).grid.largest());
    };
    EXPECT_NEAR(largest("A lamp of 1986\n"), 198, 1e-4);
    EXPECT_NEAR(largest("IESNA91\n[TEST] own\n"), 198, 1e-4);
    EXPECT_NEAR(largest("IESNA:LM-63-1995\n"), 180, 1e-4);
    EXPECT_NEAR(largest("IESNA:LM-63-2002\n"), 180, 1e-4);
    EXPECT_EQ(readLm63(file).warnings.size(), 1u);  // it should have been 1
    file.factors = "0.9 1.10000 50";                // 2019: a code, and no 10 %
    EXPECT_NEAR(largest("IES:LM-63-2019\n"), 180, 1e-4);
    EXPECT_TRUE(readLm63(file).warnings.empty());
    EXPECT_EQ(readLm63(file).version, "LM-63-2019");
}

TEST(Lm63, LumensAndLampsNeverScale) {
    Lm63Text file = lambertian();
    for (const std::string lamps : {"1 -1", "2 3100", "-2 500", "4 0"}) {
        file.lamps = lamps;
        EXPECT_FLOAT_EQ(readLm63(file).grid.largest(), 100) << lamps;
    }
    file.lamps = "2 3100";
    EXPECT_EQ(readLm63(file).lampLumens, 6200);
    file.lamps = "1 -1";
    EXPECT_FALSE(readLm63(file).lampLumens);
}

TEST(Lm63, FormIsFree) {
    const std::string plain = lambertian().text();
    const LightProfile expected = readLm63(plain);
    const auto same = [&](std::string text) {
        const LightProfile read = readLm63(text);
        return read.grid.candela == expected.grid.candela &&
               read.grid.verticals_deg == expected.grid.verticals_deg;
    };
    const auto replaced = [&](char from, const std::string& to) {
        const std::size_t numbers = plain.find("TILT=NONE") + 10;
        std::string text = plain.substr(0, numbers);
        for (const char c : plain.substr(numbers)) text += c == from ? to : std::string(1, c);
        return text;
    };
    EXPECT_TRUE(same(replaced(' ', ", ")));
    EXPECT_TRUE(same(replaced(' ', "\t")));
    EXPECT_TRUE(same(replaced(' ', "\n")));
    EXPECT_TRUE(same(replaced('\n', " ")));  // all numbers in one line
    std::string windows;
    for (const char c : plain) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_TRUE(same(windows));
    EXPECT_TRUE(same("\xef\xbb\xbf" + plain));
    EXPECT_TRUE(same(plain + "\n\n\x1a"));
    EXPECT_TRUE(same(plain + "end of the report, 2 pages\n"));
    Lm63Text file = lambertian();
    file.first =
        "IESNA:LM-63-2002\n[MANUFAC] Stra\xdf"
        "enlicht\n[MORE] TILT=INCLUDE is not meant\nTilt=1 \xb0\n";
    file.first.resize(file.first.rfind("Tilt="));
    EXPECT_TRUE(same(file.text()));
    file.tilt = "  tilt = none  \n";
    EXPECT_TRUE(same(file.text()));
}

TEST(Lm63, TiltFactorsAreTold) {
    Lm63Text file = lambertian();
    file.tilt = "TILT=INCLUDE\n1\n4\n0 30 60 90\n0.8 0.6 0.4 0.4\n";
    const LightProfile profile = readLm63(file);
    EXPECT_FLOAT_EQ(profile.grid.largest(), 80);  // as it hangs
    EXPECT_NEAR(profile.tiltFactor(0), 1, 1e-12);
    EXPECT_NEAR(profile.tiltFactor(45), 0.5 / 0.8, 1e-12);
    EXPECT_NEAR(profile.tiltFactor(120), 0.5, 1e-12);

    file.tilt = "TILT=lamp.tlt\n";
    const LightProfile other = parseLm63(file.text(), "lamp.ies", [](const std::string& name, int line) {
        EXPECT_EQ(name, "lamp.tlt");
        EXPECT_EQ(line, 3);
        return std::string("1\n2\n0, 90\n1, 0.5\n");
    });
    EXPECT_NEAR(other.tiltFactor(45), 0.75, 1e-12);
    EXPECT_NEAR(readLm63(other.text).tiltFactor(45), 0.75, 1e-12);  // stands on its own
}

TEST(Lm63, OpeningsByTheVersionsOwnTables) {
    using Shape = LuminousOpening::Shape;
    struct Case {
        int year;
        double width, length, height;
        Shape shape;
        double x, y, z;
        bool odd;
    };
    for (const Case& c : std::vector<Case>{
             {2002, 0, 0, 0, Shape::point, 0, 0, 0, false},
             {1995, 0.6, 1.2, 0, Shape::rectangle, 1.2, 0.6, 0, false},
             {2019, 0.6, 1.2, 0.1, Shape::rectangle, 1.2, 0.6, 0.1, false},
             {1986, -0.3, 0, 0, Shape::circle, 0.3, 0.3, 0, false},
             {1991, -0.3, 0, 0.2, Shape::circle, 0.3, 0.3, 0.2, false},
             {1995, -0.3, 0, 0, Shape::circle, 0.3, 0.3, 0, false},
             {2002, -0.3, 0, 0, Shape::circle, 0.3, 0.3, 0,
              true},  // 1995's circle, as 13 of 67 files have it
             {2002, -0.3, -0.3, 0, Shape::circle, 0.3, 0.3, 0, false},
             {1995, -0.3, -0.3, 0, Shape::circle, 0.3, 0.3, 0, true},
             {2002, -0.3, -0.5, 0, Shape::circle, 0.5, 0.3, 0, false},
             {1995, -0.3, 0, -0.3, Shape::sphere, 0.3, 0.3, 0.3, false},
             {2002, -0.3, -0.3, -0.3, Shape::sphere, 0.3, 0.3, 0.3, false},
             {2002, -0.3, 0, -0.3, Shape::standing, 0, 0.3, 0.3, false},  // 1995's sphere means another thing
             {1995, 0, 1.2, -0.03, Shape::tubeAlongX, 1.2, 0.03, 0.03, false},
             {2019, -0.03, 1.2, -0.03, Shape::tubeAlongX, 1.2, 0.03, 0.03, false},
             {2002, 1.2, -0.03, -0.03, Shape::tubeAlongY, 0.03, 1.2, 0.03, false},
             {2002, 0, 0, -0.3, Shape::point, 0, 0, 0, true},  // in no table
         }) {
        const OpeningReading read = readLm63Opening(c.year, c.width, c.length, c.height);
        const std::string what = fmt::format("{}: {} {} {}", c.year, c.width, c.length, c.height);
        EXPECT_EQ(read.opening.shape, c.shape) << what << " " << read.opening.name();
        EXPECT_DOUBLE_EQ(read.opening.x_m, c.x) << what;
        EXPECT_DOUBLE_EQ(read.opening.y_m, c.y) << what;
        EXPECT_DOUBLE_EQ(read.opening.z_m, c.z) << what;
        EXPECT_EQ(!read.warning.empty(), c.odd) << what << " " << read.warning;
    }
    Lm63Text file = lambertian();
    file.unit = 1;
    file.opening = "2 4 0";
    EXPECT_DOUBLE_EQ(readLm63(file).opening.x_m, 1.2192);
    EXPECT_DOUBLE_EQ(readLm63(file).opening.y_m, 0.6096);
}

TEST(Lm63, NearestLights) {
    using Shape = LuminousOpening::Shape;
    const NearestLight panel = nearestLight({Shape::rectangle, 1.2, 0.6, 0}, false, false);
    EXPECT_EQ(panel.shape.shape, LightShape::rect);
    EXPECT_FLOAT_EQ(panel.shape.width_m, 1.2f);
    EXPECT_FLOAT_EQ(panel.shape.height_m, 0.6f);
    EXPECT_FALSE(panel.shape.twoSided);
    EXPECT_TRUE(panel.note.empty());
    const NearestLight box = nearestLight({Shape::rectangle, 1.2, 0.6, 0.1}, true, false);
    EXPECT_TRUE(box.shape.twoSided);
    EXPECT_FALSE(box.note.empty());
    EXPECT_EQ(nearestLight({Shape::circle, 0.3, 0.3, 0}, false, true).shape.shape, LightShape::disk);
    EXPECT_EQ(nearestLight({}, false, false).shape.shape, LightShape::sphere);
    EXPECT_EQ(nearestLight({}, false, false).shape.radius_m, 0);
}

TEST(Lm63, NearestLightsOfWhatStands) {
    using Shape = LuminousOpening::Shape;
    // Tubes' ends are dark: what shines straight down is none.
    EXPECT_EQ(nearestLight({Shape::circle, 0.1, 0.1, 0.5}, true, false).shape.shape, LightShape::sphere);
    const NearestLight pillar = nearestLight({Shape::circle, 0.1, 0.1, 0.5}, true, true);
    EXPECT_EQ(pillar.shape.shape, LightShape::cylinder);
    EXPECT_FLOAT_EQ(pillar.shape.length_m, 0.5f);
    EXPECT_FLOAT_EQ(pillar.shape.radius_m, 0.05f);
    EXPECT_TRUE(pillar.note.empty()) << pillar.note;
    EXPECT_EQ(pillar.luminaireFromShape[0], glm::vec3(0, 0, 1));  // its length stands
    EXPECT_FALSE(nearestLight({Shape::circle, 0.1, 0.2, 0.5}, true, true).note.empty());
    EXPECT_EQ(nearestLight({Shape::circle, 0.5, 0.5, 0.1}, true, true).shape.shape, LightShape::disk);

    const NearestLight wheel = nearestLight({Shape::standing, 0, 0.3, 0.3}, false, false);
    EXPECT_EQ(wheel.shape.shape, LightShape::disk);
    EXPECT_FLOAT_EQ(wheel.shape.radius_m, 0.15f);
    EXPECT_TRUE(wheel.shape.twoSided);
    EXPECT_TRUE(wheel.note.empty()) << wheel.note;
    EXPECT_EQ(wheel.luminaireFromShape[2], glm::vec3(1, 0, 0));  // it faces C0

    const LuminousOpening edges[] = {{Shape::rectangle, 0, 0.6, 0.2}, {Shape::rectangle, 0.6, 0, 0.2}};
    for (const LuminousOpening& edge : edges) {
        EXPECT_EQ(edge.name(), "standing rectangle");
        const NearestLight nearest = nearestLight(edge, false, false);
        EXPECT_EQ(nearest.shape.shape, LightShape::rect);
        EXPECT_FLOAT_EQ(nearest.shape.width_m, 0.6f);
        EXPECT_FLOAT_EQ(nearest.shape.height_m, 0.2f);
        EXPECT_TRUE(nearest.shape.twoSided);
        EXPECT_EQ(nearest.luminaireFromShape * glm::vec3(0, 1, 0), glm::vec3(0, 0, 1));
        EXPECT_FLOAT_EQ(glm::determinant(nearest.luminaireFromShape), 1);
    }
}

}  // namespace
}  // namespace penumbra::studio::testing
