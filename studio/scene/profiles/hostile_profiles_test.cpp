// SPDX-License-Identifier: Apache-2.0
// Files that are broken, wrong or made to do harm: each is turned down with its line, in bounded memory.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "studio/scene/profiles/test_profiles.h"

namespace penumbra::studio::testing {
namespace {

namespace fs = std::filesystem;

Lm63Text good() {
    Lm63Text file;
    file.verticals = {0, 30, 60, 90};
    file.horizontals = {0, 45, 90};
    file.candela = [](double v, double h) { return 10 + v + h; };
    return file;
}

TEST(HostileProfiles, WhatHasNoMeaningIsTurnedDownWithItsLine) {
    struct Case {
        std::string text, message;
    };
    const auto with = [](auto change) {
        Lm63Text file = good();
        change(file);
        return file.text();
    };
    using File = Lm63Text;
    const std::string head = "IESNA:LM-63-2002\nTILT=NONE\n";
    for (const Case& c : std::vector<Case>{
             {"", "lamp.ies:1: no line begins with TILT="},
             {"a picture, say", "lamp.ies:1: no line begins with TILT="},
             {"[MORE] TILT=NONE\n", "lamp.ies:1: no line begins with TILT="},
             {head, "lamp.ies:2: the file ends before the number of lamps"},
             {with([](File& f) { f.tilt = "TILT=\n"; }), "lamp.ies:3: TILT= must say"},
             {with([](File& f) { f.tilt = "TILT=lost.tlt\n"; }), "lamp.ies:3: no file 'lost.tlt'"},
             {with([](File& f) { f.tilt = "TILT=INCLUDE\n7\n"; }), "lamp.ies:4: how the lamp lies"},
             {with([](File& f) { f.tilt = "TILT=INCLUDE\n1\n1000000\n"; }), "lamp.ies:5: the number of tilt"},
             {with([](File& f) { f.tilt = "TILT=INCLUDE\n1\n2\n0 90\n0 1\n"; }),
              "lamp.ies:7: the tilt factor"},
             {with([](File& f) { f.multiplier = "-2"; }),
              "lamp.ies:4: the candela multiplier must be positive"},
             {with([](File& f) { f.multiplier = "NaN"; }),
              "lamp.ies:4: the candela multiplier must be a number, not 'NaN'"},
             {with([](File& f) { f.multiplier = "1e999"; }),
              "lamp.ies:4: the candela multiplier must be a number"},
             {with([](File& f) { f.multiplier = "1e38"; }), "lamp.ies:8: 10 times"},
             {with([](File& f) { f.type = 4; }), "lamp.ies:4: the type"},
             {with([](File& f) { f.unit = 0; }), "lamp.ies:4: the unit"},
             {with([](File& f) { f.opening = "1e9 1 0"; }), "lamp.ies:4: a luminous opening"},
             {with([](File& f) { f.factors = "0 1 50"; }), "lamp.ies:5: the ballast factor must be positive"},
             {with([](File& f) {
                  f.verticals = {0, 60, 30, 90};
              }),
              "lamp.ies:6: a vertical angle of 30 follows one of 60: angles must increase"},
             {with([](File& f) {
                  f.verticals = {0, 60, 60, 90};
              }),
              "lamp.ies:6:"},
             {with([](File& f) {
                  f.verticals = {-10, 60};
              }),
              "lamp.ies:6: a vertical angle must lie"},
             {with([](File& f) {
                  f.verticals = {0, 200};
              }),
              "lamp.ies:6: a vertical angle must lie"},
             {with([](File& f) {
                  f.horizontals = {0, 20, 40};
              }),
              "no symmetry"},
             {with([](File& f) {
                  f.horizontals = {10, 55, 100};
              }),
              "cannot be mirrored"},
             {with([](File& f) {
                  f.horizontals = {0, 120, 350, 360, 380};
              }),
              "lamp.ies:12: C planes"},
             {with([](File& f) { f.type = 2, f.horizontals = {0}; }), "need more than one"},
             {with([](File& f) {
                  f.type = 2, f.horizontals = {-100, 100};
              }),
              "must lie from -90 to 90"},
             {with([](File& f) { f.candela = [](double v, double) { return v - 20; }; }),
              "lamp.ies:8: candela must not be negative"},
             {with([](File& f) { f.candela = [](double, double) { return std::nan(""); }; }),
              "lamp.ies:8: a candela value must be a number, not 'nan'"},
             {with([](File& f) { f.candela = [](double, double) { return INFINITY; }; }),
              "lamp.ies:8: a candela value must be a number, not 'inf'"},
             {with([](File& f) { f.last = "12.5\n"; }), "lamp.ies:11: '12.5' follows the last value"},
             // 10^6 angles, stated and not there: nothing is set aside for them.
             {head + "1 -1 1 1000000 1 1 2 0 0 0 1 1 1\n", "lamp.ies:3: the number of vertical angles"},
             {head + "1 -1 1 2147483648 4294967296 1 2 0 0 0 1 1 1\n", "lamp.ies:3: the number of vertical"},
             {head + "1 -1 1 4096 4096 1 2 0 0 0 1 1 1\n", "lamp.ies:3: 4096 x 4096 candela values"},
             {head + "1 -1 1 1.5 1 1 2 0 0 0 1 1 1\n", "lamp.ies:3: the number of vertical angles"},
             {head + "1 -1 1 \x1b[31mred\x07 1 1 2 0 0 0 1 1 1\n", "must be a number, not '?[31mred?'"},
         }) {
        const std::string message = lm63Error(c.text);
        EXPECT_NE(message.find(c.message), std::string::npos) << message << "\n  for " << c.message;
        EXPECT_TRUE(message.starts_with("lamp.ies:")) << message;
    }
}

TEST(HostileProfiles, CutAnywhere) {
    Lm63Text file = good();
    const std::string whole = file.text();
    EXPECT_EQ(lm63Error(whole), "accepted");
    // Up to the last value, of which digits may be missing.
    for (std::size_t length = 0; length + 12 < whole.size(); ++length)
        EXPECT_NE(lm63Error(whole.substr(0, length)), "accepted") << length;
}

TEST(HostileProfiles, WrongCounts) {
    // One angle more or less shifts all that follows: it must not be taken for another lamp.
    for (const auto& [verticals, horizontals] : {std::pair{3, 3}, {5, 3}, {4, 2}, {4, 4}, {3, 4}}) {
        std::string text = good().text();
        const std::string counts = " 4 3 1 2 ";
        text.replace(text.find(counts), counts.size(), fmt::format(" {} {} 1 2 ", verticals, horizontals));
        EXPECT_NE(lm63Error(text), "accepted") << verticals << " " << horizontals;
    }
}

TEST(HostileProfiles, BytesAtRandomAreReadOrTurnedDown) {
    std::mt19937 random(11);
    const std::string ies = good().text();
    EulumdatText eulumdat;
    eulumdat.symmetry = 4;
    eulumdat.planes = 8;
    eulumdat.gammas = {0, 45, 90};
    eulumdat.planesWithValues = {0, 45, 90};
    eulumdat.candela = [](double gamma, double c) { return 100 + gamma + c; };
    const std::string ldt = eulumdat.text();
    const std::string alphabet = "0123456789.,-+eE \n\r\tTILT=\xff\x00[]naif";
    for (int i = 0; i < 4000; ++i) {
        std::string text = i % 2 ? ies : ldt;
        for (unsigned change = 0; change <= random() % 4; ++change) {
            const std::size_t at = random() % text.size();
            switch (random() % 3) {
                case 0:
                    text[at] = alphabet[random() % alphabet.size()];
                    break;
                case 1:
                    text.erase(at, random() % 8);
                    break;
                default:
                    text.insert(at, 1, alphabet[random() % alphabet.size()]);
            }
            if (text.empty()) text = "1";
        }
        try {
            const LightProfile profile = i % 2 ? readLm63(text) : parseEulumdat(text, "lamp.ldt");
            EXPECT_TRUE(std::isfinite(profile.grid.integral())) << text;
            EXPECT_GE(profile.grid.at(directionOf(33, 44)), 0) << text;
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("lamp.")) << error.what();
        }
    }
}

class ProfileFiles : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder / "inner"); }
    void TearDown() override { fs::remove_all(folder); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    std::string errorOf(const std::string& name) const {
        try {
            readProfile(folder / name);
            return "accepted";
        } catch (const InputError& error) {
            return error.what();
        }
    }
    const fs::path folder = fs::temp_directory_path() / fmt::format("penumbra-profiles-{}", getpid());
};

TEST_F(ProfileFiles, TiltFilesLieBeneathTheFolder) {
    Lm63Text file = good();
    write("outside.tlt", "1 2 0 90 1 0.5");
    write("inner/inside.tlt", "1 2 0 90 1 0.5");
    file.tilt = "TILT=inside.tlt\n";
    write("inner/a.ies", file.text());
    EXPECT_NEAR(readProfile(folder / "inner/a.ies").tiltFactor(90), 0.5, 1e-12);
    for (const std::string name : {"../outside.tlt", "/etc/passwd", "C:\\lamp.tlt", "link.tlt"}) {
        file.tilt = "TILT=" + name + "\n";
        write("inner/b.ies", file.text());
        fs::remove(folder / "inner/link.tlt");
        fs::create_symlink(folder / "outside.tlt", folder / "inner/link.tlt");
        EXPECT_NE(errorOf("inner/b.ies").find("beneath the file's own folder"), std::string::npos)
            << name << ": " << errorOf("inner/b.ies");
    }
    file.tilt = "TILT=lost.tlt\n";
    write("inner/c.ies", file.text());
    EXPECT_NE(errorOf("inner/c.ies").find("c.ies:3: TILT: "), std::string::npos) << errorOf("inner/c.ies");
    EXPECT_NE(errorOf("inner/c.ies").find("does not exist"), std::string::npos);
}

TEST_F(ProfileFiles, OnlyRegularFilesOfTheirKind) {
    EXPECT_NE(errorOf("lost.ies").find("does not exist"), std::string::npos);
    fs::create_directory(folder / "folder.ies");
    EXPECT_NE(errorOf("folder.ies").find("is not a file"), std::string::npos);
    write("lamp.txt", good().text());
    EXPECT_NE(errorOf("lamp.txt").find("only LM-63"), std::string::npos);
    write("LAMP.IES", good().text());
    EXPECT_EQ(errorOf("LAMP.IES"), "accepted");
    write("lamp.ldt", good().text());  // the one format under the other's name
    EXPECT_NE(errorOf("lamp.ldt").find("lamp.ldt:3:"), std::string::npos) << errorOf("lamp.ldt");
    // Large only by name: it has no content.
    std::ofstream(folder / "large.ies").close();
    fs::resize_file(folder / "large.ies", maxProfile_bytes + 1);
    EXPECT_NE(errorOf("large.ies").find("is larger than"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::studio::testing
