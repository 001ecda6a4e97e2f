// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/document.h"

#include <fmt/format.h>

#include <cstring>
#include <span>
#include <string_view>

namespace penumbra::studio::gltf {

namespace {

constexpr std::size_t maxJson_bytes = 64u << 20;
constexpr int maxJsonDepth = 64;

std::uint32_t littleEndian32(std::span<const std::byte> bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) | std::uint32_t(bytes[at + 1]) << 8 | std::uint32_t(bytes[at + 2]) << 16 |
           std::uint32_t(bytes[at + 3]) << 24;
}

// "Binary glTF Layout", glTF 2.0 section 4.4.
struct Chunks {
    std::span<const std::byte> json;
    std::optional<std::span<const std::byte>> binary;
};

Chunks splitGlb(std::span<const std::byte> bytes) {
    constexpr std::uint32_t jsonType = 0x4E4F534A, binaryType = 0x004E4942;
    if (bytes.size() < 20) throw PlaceError("", "the GLB ends within its header");
    if (const std::uint32_t version = littleEndian32(bytes, 4); version != 2)
        throw PlaceError("", fmt::format("GLB version {} is not 2", version));
    const std::uint32_t total = littleEndian32(bytes, 8);
    if (total < 20 || total > bytes.size())
        throw PlaceError("", fmt::format("the GLB claims {} bytes but has {}", total, bytes.size()));

    Chunks chunks;
    std::span<const std::byte> rest = bytes.subspan(12, total - 12);
    for (int i = 0; !rest.empty(); ++i) {
        if (rest.size() < 8)
            throw PlaceError("", fmt::format("the GLB ends within the header of chunk {}", i));
        const std::uint32_t length = littleEndian32(rest, 0), type = littleEndian32(rest, 4);
        rest = rest.subspan(8);
        if (length > rest.size()) throw PlaceError("", fmt::format("chunk {} is longer than the GLB", i));
        if ((i == 0) != (type == jsonType)) throw PlaceError("", "a GLB must have one JSON chunk, the first");
        if (i == 0) chunks.json = rest.first(length);
        if (i == 1 && type == binaryType) chunks.binary = rest.first(length);
        rest = rest.subspan(length);
    }
    return chunks;
}

// Before the parser sees the text: parsers and destructors of nested values recurse. Returns a bound on the
// number of values, for each but the first follows a comma, a colon or an opening bracket.
std::uint64_t scanJson(std::string_view text) {
    std::uint64_t values = 1;
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == ',' || c == ':') {
            ++values;
        } else if (c == '{' || c == '[') {
            ++values;
            if (++depth > maxJsonDepth)
                throw PlaceError("", fmt::format("the JSON nests deeper than {} levels", maxJsonDepth));
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return values;
}

nlohmann::json parseJson(std::span<const std::byte> bytes, Budget& budget) {
    if (bytes.size() > maxJson_bytes) throw PlaceError("", "the JSON is larger than 64 MiB");
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    // A parsed value, its key and a view of it take some 150 bytes; texts are copied once.
    budget.charge(scanJson(text), 150, "");
    budget.charge(text.size(), 1, "");
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        throw PlaceError("", fmt::format("is not valid JSON ({})", error.what()));
    }
}

void checkAsset(const JsonView& root) {
    const JsonView asset = root.at("asset");
    const JsonView version = asset.at("version");
    if (!version.asString().starts_with("2."))
        version.fail(fmt::format("is glTF {}; only 2.x can be read", version.asString()));
    if (const auto minVersion = asset.find("minVersion"); minVersion && minVersion->asString() != "2.0")
        minVersion->fail(
            fmt::format("needs a reader of glTF {}; this one reads 2.0", minVersion->asString()));
}

}  // namespace

Document readDocument(const std::filesystem::path& file, Budget& budget) {
    const Bytes bytes = readFile(file, budget, "");
    const bool isGlb = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    const Chunks chunks = isGlb ? splitGlb(bytes) : Chunks{.json = bytes};

    Document document{.json = parseJson(chunks.json, budget)};
    if (chunks.binary) {
        budget.charge(chunks.binary->size(), 1, "");
        document.binaryChunk.emplace(chunks.binary->begin(), chunks.binary->end());
    }
    checkAsset(document.root());
    return document;
}

}  // namespace penumbra::studio::gltf
