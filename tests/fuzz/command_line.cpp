// SPDX-License-Identifier: Apache-2.0
// A scene's flags, techniques and settings as words, one a line: arguments, or a UsageError or CLI::Error.
#include <cstdint>
#include <sstream>

#include "apps/penumbra/arguments.h"
#include "studio/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    std::vector<std::string> words;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    for (std::string line; std::getline(lines, line);) words.insert(words.begin(), line);
    CLI::App app;
    SceneArguments arguments;
    std::string techniques = "all";
    std::vector<std::string> settings;
    arguments.addTo(app);
    app.add_option("-t", techniques);
    app.add_option("--set", settings)->take_all();
    try {
        app.parse(words);
        arguments.pictureSize();
        arguments.openOptions();
        SceneMoment moment;
        moment.cameras.emplace_back();
        arguments.cameraIn(Scene(), moment);
        parseContenders(techniques, settings);
    } catch (const UsageError&) {
    } catch (const CLI::Error&) {
    }
    return 0;
}
