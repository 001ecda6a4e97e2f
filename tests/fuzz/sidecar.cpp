// SPDX-License-Identifier: Apache-2.0
// A lights file: lights on an empty scene, or an InputError; what was read can be written and read again.
#include "studio/scene/lights/sidecar.h"

#include <cstdint>
#include <cstdlib>

#include "studio/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    Sidecar sidecar;
    try {
        sidecar = parseSidecar({reinterpret_cast<const char*>(data), size}, "lights.json");
    } catch (const InputError&) {
        return 0;
    }
    const std::string written = formatSidecar(sidecar);
    try {
        if (formatSidecar(parseSidecar(written, "lights.json")) != written) std::abort();
    } catch (const InputError&) {
        std::abort();  // what we write we must read
    }
    return 0;
}
