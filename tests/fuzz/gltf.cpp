// SPDX-License-Identifier: Apache-2.0
// A glTF or GLB file of a stranger's: a scene, at two moments, or an InputError. It may allocate 64 MiB.
#include "studio/scene/gltf/gltf.h"
#include "studio/errors.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    static const fuzz::InputFile text("scene.gltf"), binary("scene.glb");
    const fuzz::InputFile& file = size > 0 && data[0] == 'g' ? binary : text;  // "glTF"
    file.write(data, size);
    try {
        const Scene scene = loadGltf(file.path(), {.memoryBudget_bytes = std::uint64_t(64) << 20});
        for (const double time_s : {0.0, 0.7}) scene.at(time_s);
    } catch (const InputError&) {
    }
    return 0;
}
