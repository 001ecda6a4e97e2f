// SPDX-License-Identifier: Apache-2.0
// The viewer's settings: always settings, within their ranges.
#include "studio/viewer/settings.h"

#include <spdlog/spdlog.h>

#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    static const fuzz::InputFile file("viewer.json"), written("written.json");
    spdlog::set_level(spdlog::level::off);
    file.write(data, size);
    const viewer::Settings settings = viewer::loadSettings(file.path());
    if (settings.width < 320 || settings.height < 240 || settings.referenceSamples < 4) std::abort();
    viewer::saveSettings(settings, written.path());
    return 0;
}
