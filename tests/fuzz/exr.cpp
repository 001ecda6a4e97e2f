// SPDX-License-Identifier: Apache-2.0
// An EXR file: its channels, or an InputError.
#include "studio/errors.h"
#include "studio/image/image_io.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    static const fuzz::InputFile file("picture.exr");
    file.write(data, size);
    try {
        readExr(file.path());
    } catch (const InputError&) {
    }
    return 0;
}
