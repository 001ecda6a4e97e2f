// SPDX-License-Identifier: Apache-2.0
// The rules of docs/architecture.md that keep the house easy to change, read off the sources' includes.
#include <gtest/gtest.h>

#include <algorithm>
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

/// A row of the table of rooms in docs/architecture.md.
struct Room {
    std::string folder;             ///< "src/gl"
    std::set<std::string> allowed;  ///< folders' last names, as the table has them
    std::set<std::string> found;    ///< what the code includes of them
};

/// Pieces of `text` in backquotes.
std::vector<std::string> quoted(const std::string& text) {
    static const std::regex quotes("`([^`]+)`");
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), quotes), end; i != end; ++i)
        found.push_back((*i)[1]);
    return found;
}

std::vector<Room> readTableOfRooms() {
    static const std::regex row("^\\| `([^`]+)/` \\|.*\\|([^|]*)\\|$");
    std::vector<Room> rooms;
    std::ifstream text(root / "docs/architecture.md");
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
        if (!std::regex_match(line, match, row)) continue;
        Room room{match[1], {}, {}};
        for (const std::string& name : quoted(match[2])) room.allowed.insert(name);
        if (line.find("every room") != std::string::npos) room.allowed.insert("<room>");
        rooms.push_back(room);
    }
    return rooms;
}

const std::vector<Room>& tableOfRooms() {
    static const std::vector<Room> rooms = readTableOfRooms();
    return rooms;
}

/// The folder of the table in which `path` lies, "src/techniques/<room>" for all rooms of techniques; empty
/// where the table has none.
std::string folderOf(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    const std::string techniques = "src/techniques/";
    if (path.starts_with(techniques) && !path.starts_with(techniques + "common/"))
        return techniques + "<room>";
    std::string found;
    for (const Room& room : tableOfRooms()) {
        const bool isFloor = room.folder == "src";  // its own files alone; below it lie rooms
        const bool holds =
            folder == room.folder || (!isFloor && folder.string().starts_with(room.folder + "/"));
        if (holds && room.folder.size() > found.size()) found = room.folder;
    }
    return found;
}

TEST(Layout, RoomsIncludeWhatTheTableSaysAndNothingElse) {
    std::vector<Room> rooms = tableOfRooms();
    ASSERT_GT(rooms.size(), 15u) << "the table of docs/architecture.md cannot be read any more";
    for (const char* top : {"include", "src", "studio", "apps"}) {
        for (const fs::path& file : sourcesIn(top)) {
            const std::string path = fs::relative(file, root).string(), from = folderOf(path);
            const bool isLoose = fs::path(path).parent_path() == top;
            const auto room = std::ranges::find(rooms, from, &Room::folder);
            EXPECT_TRUE(room != rooms.end() || isLoose) << path << " lies in no room of docs/architecture.md";
            if (room == rooms.end()) continue;
            for (const std::string& included : includesOf(file)) {
                const std::string target =
                    included.starts_with("penumbra/") ? "include/" + included : included;
                if (fs::path(target).parent_path() == top) continue;  // files of the whole floor
                const std::string to = folderOf(target);
                if (to == from) {
                    // Two rooms of techniques are one row of the table, and yet two.
                    EXPECT_TRUE(to.find('<') == std::string::npos ||
                                fs::path(target).parent_path() == fs::path(path).parent_path())
                        << path << " includes " << included;
                    continue;
                }
                // What lies in studio/ itself is allowed to whoever may include all of it.
                const std::string name = to.empty() ? "studio/" : fs::path(to).filename().string();
                const bool isAllowed = room->allowed.contains(name) ||
                                       (room->allowed.contains("studio/") && to.starts_with("studio/"));
                EXPECT_TRUE(isAllowed) << path << " includes " << included << ", which docs/architecture.md "
                                       << "does not allow to " << room->folder;
                room->found.insert(name);
            }
        }
    }
    for (const Room& room : rooms) {
        for (const std::string& name : room.allowed) {
            EXPECT_TRUE(room.found.contains(name)) << "docs/architecture.md says that " << room.folder
                                                   << " includes " << name << ": nothing does";
        }
    }
}

TEST(Layout, EveryFolderOfTheTableIsThere) {
    for (const Room& room : tableOfRooms()) {
        if (room.folder.find('<') == std::string::npos) {
            EXPECT_TRUE(fs::is_directory(root / room.folder)) << room.folder;
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

// Mesa leaves the filters of such a sampler as the program before had them, and compiles for seconds anew for
// each kind it meets.
TEST(Layout, NoShaderReadsABufferThroughASampler) {
    for (const char* folder : {"src", "studio"}) {
        for (const fs::path& file : sourcesIn(folder)) {
            if (file.extension() != ".glsl") continue;
            std::ifstream text(file);
            for (std::string line; std::getline(text, line);) {
                EXPECT_EQ(line.find("samplerBuffer"), std::string::npos)
                    << file << ": " << line << "; take a readonly uimageBuffer (gl::TexelBuffer)";
            }
        }
    }
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

/// The lines between the marks `//! [name]` (of Python `#! [name]`) of a file, without the indentation that
/// all of them have.
std::string markedCode(const fs::path& file, const std::string& name) {
    std::ifstream text(file);
    std::vector<std::string> lines;
    std::size_t indentation = std::string::npos;
    bool within = false;
    for (std::string line; std::getline(text, line);) {
        if (line.ends_with("//! [" + name + "]") || line.ends_with("#! [" + name + "]")) {
            within = !within;
        } else if (within) {
            if (!line.empty()) indentation = std::min(indentation, line.find_first_not_of(' '));
            lines.push_back(line);
        }
    }
    std::string code;
    for (const std::string& line : lines) code += (line.empty() ? line : line.substr(indentation)) + "\n";
    return code;
}

TEST(Manual, CodeIsThatOfTheExamples) {
    // "<!-- examples/FILE: NAME -->", and the fenced code after it.
    static const std::regex block("<!-- (examples/[^:]+): (\\w+) -->\n```(?:cpp|python)\n([^`]*)```");
    int blocks = 0;
    for (const auto& entry : fs::directory_iterator(root / "docs/manual")) {
        std::ifstream file(entry.path());
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        EXPECT_EQ(text.find("@snippet"), std::string::npos)
            << entry.path() << ": code that only Doxygen shows";
        for (std::sregex_iterator match(text.begin(), text.end(), block), end; match != end; ++match) {
            ++blocks;
            EXPECT_EQ((*match)[3], markedCode(root / (*match)[1].str(), (*match)[2]))
                << entry.path() << ": copy the lines between the marks [" << (*match)[2] << "] of "
                << (*match)[1];
        }
    }
    EXPECT_EQ(blocks, 12);
}

/// Lines of code between an example's marks, `//! [name]` at both ends, comments apart.
int linesThatKnowPenumbra(const fs::path& example) {
    int count = 0;
    bool isMarked = false;
    std::ifstream text(example);
    for (std::string line; std::getline(text, line);) {
        line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
        if (line.starts_with("//! [")) isMarked = !isMarked;
        const bool isCode = !line.empty() && !line.starts_with("//");
        if (isMarked && isCode) ++count;
        const bool mayKnow = line.starts_with("} catch") || line.find("penumbra::Vec3") != std::string::npos;
        EXPECT_TRUE(isMarked || !isCode || mayKnow || line.find("penumbra::") == std::string::npos)
            << example << " has outside of its marks: " << line;
    }
    return count;
}

TEST(Layout, ExamplesOfHostsAreAsShortAsTheManualSays) {
    static const std::regex row("^\\|.*\\| (\\d+) \\| `(\\w+_(?:host|client))` \\|$");
    int examples = 0;
    std::ifstream text(root / "docs/manual/hosts.md");
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
        if (!std::regex_match(line, match, row)) continue;
        const std::string name = match[2];
        const int lines = linesThatKnowPenumbra(root / "examples" / name / (name + ".cpp"));
        EXPECT_EQ(std::to_string(lines), match[1]) << name;
        EXPECT_LE(lines, 80) << name;
        ++examples;
    }
    EXPECT_EQ(examples, 7) << "the table of docs/manual/hosts.md cannot be read any more";
}

}  // namespace
