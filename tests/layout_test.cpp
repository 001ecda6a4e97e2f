// SPDX-License-Identifier: Apache-2.0
// The rules of docs/architecture.md that keep the house easy to change, read off the sources' includes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path root = PENUMBRA_SOURCE_DIRECTORY;

/// Paths that `file` includes with quotes.
std::vector<std::string> includesOf(const fs::path& file) {
    static const std::regex include("^\\s*#include \"([^\"]+)\"");
    std::vector<std::string> found;
    std::ifstream text(file);
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
        if (std::regex_search(line, match, include)) found.push_back(match[1]);
    }
    return found;
}

bool isTest(const fs::path& file) {
    return file.filename().string().find("_test") != std::string::npos;
}

/// Sources, headers and shaders under `folder`, without tests.
std::vector<fs::path> sourcesIn(const std::string& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if ((extension == ".h" || extension == ".cpp" || extension == ".glsl") && !isTest(entry.path())) {
            files.push_back(entry.path());
        }
    }
    return files;
}

TEST(Layout, IncludesStartAtTheRoot) {
    for (const char* folder : {"include", "src", "studio", "apps", "tests"}) {
        for (const fs::path& file : sourcesIn(folder)) {
            for (const std::string& included : includesOf(file)) {
                EXPECT_TRUE(fs::exists(root / included) || fs::exists(root / "include" / included))
                    << file << " includes " << included;
            }
        }
    }
}

TEST(Layout, NoRoomIncludesAnother) {
    const std::string techniques = "src/techniques/";
    for (const fs::path& file : sourcesIn(techniques)) {
        const std::string room = fs::relative(file, root / techniques).begin()->string();
        if (!fs::is_directory(root / techniques / room)) continue;  // the catalog knows all rooms
        for (const std::string& included : includesOf(file)) {
            if (!included.starts_with(techniques)) continue;
            const std::string target =
                included.substr(techniques.size(), included.find('/', techniques.size()) - techniques.size());
            EXPECT_TRUE(target == room || target == "common") << file << " includes " << included;
            EXPECT_TRUE(room != "common" || target == "common") << file << " includes " << included;
        }
    }
}

TEST(Layout, TheLibraryKnowsNothingOfTheStudio) {
    for (const char* folder : {"src", "include"}) {
        for (const fs::path& file : sourcesIn(folder)) {
            for (const std::string& included : includesOf(file)) {
                EXPECT_FALSE(included.starts_with("studio/") || included.starts_with("apps/"))
                    << file << " includes " << included;
            }
        }
    }
}

TEST(Layout, TheStudioUsesTheLibraryThroughItsPublicHeaders) {
    for (const char* folder : {"studio", "apps"}) {
        for (const fs::path& file : sourcesIn(folder)) {
            for (const std::string& included : includesOf(file)) {
                EXPECT_TRUE(!included.starts_with("src/") || included.starts_with("src/gl/"))
                    << file << " includes " << included;
            }
        }
    }
}

TEST(Layout, PublicHeadersKnowNoOpenGLAndNoOtherLibrary) {
    static const std::regex other("^\\s*#include <(GL|epoxy|EGL|glm|fmt|spdlog)");
    for (const fs::path& file : sourcesIn("include")) {
        std::ifstream text(file);
        for (std::string line; std::getline(text, line);) {
            EXPECT_FALSE(std::regex_search(line, other)) << file << ": " << line;
        }
        for (const std::string& included : includesOf(file)) {
            EXPECT_TRUE(included.starts_with("penumbra/")) << file << " includes " << included;
        }
    }
}

TEST(Layout, OnlyOneHeaderIncludesOpenGLInTheLibrary) {
    static const std::regex loader("^\\s*#include <(epoxy|GL)/");
    std::set<std::string> users;
    for (const fs::path& file : sourcesIn("src")) {
        std::ifstream text(file);
        for (std::string line; std::getline(text, line);) {
            if (std::regex_search(line, loader)) users.insert(fs::relative(file, root).string());
        }
    }
    EXPECT_EQ(users, std::set<std::string>{"src/gl/gl.h"});
}

TEST(Layout, EveryRoomHasAReadmeAndEverySourceALicence) {
    for (const auto& room : fs::directory_iterator(root / "src/techniques")) {
        if (!room.is_directory() || room.path().filename() == "common") continue;
        EXPECT_TRUE(fs::exists(room.path() / "README.md")) << room.path();
    }
    for (const char* folder : {"include", "src", "studio", "apps", "tests"}) {
        for (const fs::path& file : sourcesIn(folder)) {
            std::string first;
            std::getline(std::ifstream(file) >> std::ws, first);
            EXPECT_NE(first.find("SPDX-License-Identifier: Apache-2.0"), std::string::npos) << file;
        }
    }
}

TEST(Layout, DocumentsNameTestsThatExist) {
    const auto textOf = [](const fs::path& file) {
        std::ifstream stream(file);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    // TEST(Suite, Name) with whatever ending; a parametrised suite is called by its fixture.
    static const std::regex definition("\\bTEST(?:_F|_P)?\\((\\w+),\\s*(\\w+)\\)");
    static const std::regex mention("`([A-Z]\\w+\\.[A-Z]\\w+)`");
    std::set<std::string> tests;
    for (const char* folder : {"src", "studio", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.path().extension() != ".cpp" || !isTest(entry.path())) continue;
            const std::string text = textOf(entry.path());
            for (std::sregex_iterator at(text.begin(), text.end(), definition), end; at != end; ++at) {
                tests.insert((*at)[1].str() + "." + (*at)[2].str());
            }
        }
    }
    const std::string document = textOf(root / "docs/reliability.md");
    int mentioned = 0;
    for (std::sregex_iterator at(document.begin(), document.end(), mention), end; at != end;
         ++at, ++mentioned) {
        EXPECT_TRUE(tests.contains((*at)[1])) << "docs/reliability.md: there is no test " << (*at)[1];
    }
    EXPECT_GT(mentioned, 100);
}

}  // namespace
