// SPDX-License-Identifier: Apache-2.0
// Small glTF files for tests, built in memory and written to a folder that goes away.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace penumbra::studio {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "penumbra_gltf_XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        const std::filesystem::path file = path_ / name;
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline std::string fileContent(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string base64(const std::string& bytes) {
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

/// A document with one buffer. `json` may be changed at will between the calls.
struct TestGltf {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    std::string buffer;

    template <class T>
    int addView(const std::vector<T>& values) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        const std::size_t bytes = values.size() * sizeof(T);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes}});
        buffer.append(reinterpret_cast<const char*>(values.data()), bytes);
        return int(json["bufferViews"].size()) - 1;
    }
    int addAccessor(nlohmann::json accessor) {
        json["accessors"].push_back(std::move(accessor));
        return int(json["accessors"].size()) - 1;
    }
    template <class T>
    int add(const std::string& type, const std::vector<T>& values, bool normalized = false) {
        const std::size_t components = type == "SCALAR" ? 1
                                       : type == "MAT4" ? 16
                                                        : std::size_t(type[3] - '0');
        return addAccessor({{"bufferView", addView(values)},
                            {"componentType", componentType<T>()},
                            {"normalized", normalized},
                            {"count", values.size() / components},
                            {"type", type}});
    }
    /// One node (0) with one mesh (0) of one primitive.
    nlohmann::json& addTriangle(const std::vector<float>& positions = {0, 0, 0, 1, 0, 0, 0, 1, 0}) {
        json["nodes"] = {{{"mesh", 0}}};
        json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", add("VEC3", positions)}}}}}}}};
        return json["meshes"][0]["primitives"][0];
    }
    std::string text() const {
        nlohmann::json whole = json;
        if (!buffer.empty())
            whole["buffers"] = {{{"byteLength", buffer.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        return whole.dump();
    }

  private:
    template <class T>
    static int componentType() {
        if (std::is_same_v<T, std::int8_t>) return 5120;
        if (std::is_same_v<T, std::uint8_t>) return 5121;
        if (std::is_same_v<T, std::int16_t>) return 5122;
        if (std::is_same_v<T, std::uint16_t>) return 5123;
        if (std::is_same_v<T, std::uint32_t>) return 5125;
        return 5126;
    }
};

inline std::optional<std::filesystem::path> sharedScenes() {
    const char* variable = std::getenv("PENUMBRA_SHARED_SCENES");
    const std::filesystem::path folder =
        variable ? std::filesystem::path(variable)
                 : std::filesystem::path(PENUMBRA_SOURCE_DIR) / ".." / "shared" / "scenes";
    return std::filesystem::is_directory(folder) ? std::optional(folder) : std::nullopt;
}

inline std::vector<std::filesystem::path> gltfFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            files.push_back(entry.path());
    return files;
}

}  // namespace penumbra::studio
