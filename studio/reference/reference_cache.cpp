// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/reference_cache.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

/// Raised whenever the same inputs would give other pixels, or the files look different.
constexpr std::uint32_t formatVersion = 3;   // also of how traces are made
constexpr std::uint32_t magic = 0x52464E50;  // "PNFR" in a little-endian file
constexpr std::string_view extension = ".visibility";

/// How a file begins; the pixels follow.
struct FileHeader {
    std::uint32_t magic = 0, version = 0;
    std::int32_t width_px = 0, height_px = 0, channels = 0, reserved = 0;
    double noise_rms = 0, seconds = 0;
    std::uint64_t rays = 0;
    ContentHash key;
    ContentHash checksum;  // of the pixels and of the fields above
};
static_assert(sizeof(FileHeader) == 80 && std::is_trivially_copyable_v<FileHeader>);

ContentHash checksumOf(const FileHeader& header, std::span<const std::byte> pixels) {
    ContentHasher hasher;
    hasher.addBytes(std::as_bytes(std::span(&header, 1)).first(offsetof(FileHeader, checksum)));
    hasher.addBytes(pixels);
    return hasher.hash();
}

std::vector<std::byte> encode(const ContentHash& key, const ReferenceResult& result) {
    const Image& image = result.visibility;
    FileHeader header{magic, formatVersion,    image.width_px, image.height_px, image.channels,
                      0,     result.noise_rms, result.seconds, result.rays,     key,
                      {}};
    const auto pixels = std::as_bytes(std::span(image.values));
    header.checksum = checksumOf(header, pixels);
    const auto head = std::as_bytes(std::span(&header, 1));
    std::vector<std::byte> bytes(head.begin(), head.end());
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

/// Nothing if the bytes are not, in full, what encode() made for that key.
std::optional<ReferenceResult> decode(const ContentHash& key, std::span<const std::byte> bytes) {
    FileHeader header;
    if (bytes.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    const auto pixels = bytes.subspan(sizeof header);
    if (header.magic != magic || header.version != formatVersion || header.key != key) return std::nullopt;
    if (header.checksum != checksumOf(header, pixels)) return std::nullopt;
    ReferenceResult result{.visibility = Image(header.width_px, header.height_px, header.channels),
                           .noise_rms = header.noise_rms,
                           .rays = header.rays,
                           .seconds = header.seconds};
    if (pixels.size() != result.visibility.values.size() * sizeof(float)) return std::nullopt;
    std::memcpy(result.visibility.values.data(), pixels.data(), pixels.size());
    return result;
}

}  // namespace

ContentHash traceKey(const ReferenceScene& scene, const ReceiverImage& receivers, const AreaLight& light,
                     const RadianceTexture* texture, const ReferenceOptions& options) {
    ContentHasher hasher;
    hasher.add(formatVersion);
    hasher.add(scene.contentHash().high);
    hasher.add(scene.contentHash().low);
    hasher.add(receivers.width_px);
    hasher.add(receivers.height_px);
    hasher.addArray(receivers.posWorld);
    hasher.addArray(receivers.normalWorld);
    hasher.addArray(receivers.valid);
    hasher.addArray(std::span(&receivers.eyeWorld, 1));
    if (!receivers.areFromDepth) hasher.add(int(receivers.areFromDepth));
    hasher.add(int(light.shape));
    hasher.addArray(light.worldFromLight.columns);
    for (const float size : {light.width_m, light.height_m, light.length_m, light.radius_m, light.angle_rad})
        hasher.add(size);
    hasher.add(int(light.twoSided));
    hasher.add(int(texture != nullptr));
    if (texture) {
        for (const int size : {texture->rgb.width_px, texture->rgb.height_px, texture->rgb.channels})
            hasher.add(size);
        hasher.addArray(texture->rgb.values);
    }
    hasher.add(options.samples);
    hasher.add(options.seed);
    hasher.add(int(options.weight));
    return hasher.hash();
}

fs::path ReferenceCache::defaultFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    // The XDG specification has relative paths ignored.
    if (const fs::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "penumbra";
    if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "penumbra";
    return {};
}

ReferenceCache::ReferenceCache(fs::path folder, std::uint64_t limit_bytes)
    : folder_(std::move(folder)), limit_bytes_(limit_bytes) {
    if (folder_.empty()) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (!fs::is_directory(folder_, error)) {
        spdlog::warn("'{}' cannot be made; reference images are not kept", folder_.string());
        folder_.clear();
    }
}

fs::path ReferenceCache::fileOf(const ContentHash& key) const {
    return folder_ / (key.hex() + std::string(extension));
}

std::optional<ReferenceResult> ReferenceCache::find(const ContentHash& key) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path path = fileOf(key);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return std::nullopt;
    try {
        std::optional<ReferenceResult> result = decode(key, readWholeFile(path));
        if (result) {
            fs::last_write_time(path, fs::file_time_type::clock::now(),
                                ignored);  // removeOldest() goes by last use
        } else {
            spdlog::warn("'{}' is damaged and is removed; tracing again", path.string());
            fs::remove(path, ignored);
        }
        return result;
    } catch (const InputError& error) {
        spdlog::warn("{}; tracing again", error.what());
        return std::nullopt;
    }
}

void ReferenceCache::store(const ContentHash& key, const ReferenceResult& result) {
    if (folder_.empty()) return;
    try {
        writeFileAtomically(fileOf(key), encode(key, result));
        removeOldest();
    } catch (const OutputError& error) {
        spdlog::warn("{}; reference images are not kept", error.what());
        folder_.clear();
    }
}

void ReferenceCache::removeOldest() const {
    struct File {
        fs::file_time_type time;
        fs::path path;
        std::uint64_t size = 0;
    };
    std::vector<File> files;
    std::uint64_t total = 0;
    std::error_code error;  // files may vanish meanwhile: another process tidies up, too
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code gone;
        if (entry->path().extension() == ".tmp") {  // left by a process that was killed while it wrote
            const auto age = fs::file_time_type::clock::now() - entry->last_write_time(gone);
            if (!gone && age > std::chrono::hours(1)) fs::remove(entry->path(), gone);
        }
        if (entry->path().extension() != extension) continue;
        const File file{entry->last_write_time(gone), entry->path(), entry->file_size(gone)};
        if (gone) continue;
        files.push_back(file);
        total += file.size;
    }
    std::ranges::sort(files, {}, &File::time);
    for (const File& file : files) {
        if (total <= limit_bytes_) break;
        fs::remove(file.path, error);
        total -= file.size;
    }
}

ReferenceResult ReferenceCache::trace(const ReferenceScene& scene, const ReceiverImage& receivers,
                                      const AreaLight& light, const RadianceTexture* texture,
                                      const ReferenceOptions& options) {
    if (folder_.empty()) return scene.trace(receivers, light, texture, options);
    const ContentHash key = traceKey(scene, receivers, light, texture, options);
    if (std::optional<ReferenceResult> kept = find(key)) return std::move(*kept);
    ReferenceResult result = scene.trace(receivers, light, texture, options);
    store(key, result);
    return result;
}

}  // namespace penumbra::studio
