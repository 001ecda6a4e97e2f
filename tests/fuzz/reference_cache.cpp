// SPDX-License-Identifier: Apache-2.0
// A cached reference that somebody has changed: the result as it was stored, or none.
#include "studio/reference/reference_cache.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    static const fuzz::InputFile place("unused");
    static const ContentHash key = [] {
        ContentHasher hasher;
        hasher.add(1);
        return hasher.hash();
    }();
    static const ReferenceResult stored = [] {
        ReferenceResult result{.visibility = penumbra::studio::Image(5, 3, 1)};
        for (std::size_t i = 0; i < result.visibility.values.size(); ++i) {
            result.visibility.values[i] = 1.0f / float(i + 1);
        }
        return result;
    }();
    // Every three bytes of input say where a byte of the file becomes which; the first is where the file
    // ends.
    ReferenceCache cache(place.folder());
    cache.store(key, stored);
    std::filesystem::path file;
    for (const auto& entry : std::filesystem::directory_iterator(place.folder())) file = entry.path();
    std::vector<char> bytes(std::filesystem::file_size(file));
    std::ifstream(file, std::ios::binary).read(bytes.data(), std::streamsize(bytes.size()));
    for (std::size_t i = 1; i + 2 < size; i += 3) {
        bytes[(data[i] * 256u + data[i + 1]) % bytes.size()] = char(data[i + 2]);
    }
    if (size > 0 && data[0] > 0) bytes.resize(data[0]);
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), std::streamsize(bytes.size()));
    const std::optional<ReferenceResult> found = cache.find(key);
    if (found && found->visibility.values != stored.visibility.values) std::abort();
    return 0;
}
