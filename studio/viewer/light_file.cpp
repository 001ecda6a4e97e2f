// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/light_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/viewer/json_pieces.h"

namespace penumbra::studio::viewer {
namespace {

namespace fs = std::filesystem;
using Keys = std::span<const std::string_view>;

constexpr std::size_t maxFile_bytes = std::size_t(4) << 20;

// Keys that say one thing together: where that has changed, all of them are written anew.
constexpr std::array<std::string_view, 5> sizeKeys{"width", "height", "radius", "length", "angle"};
constexpr std::array<std::string_view, 9> emissionKeys{
    "intensity", "exposure", "color",     "enableColorTemperature", "colorTemperature", "normalize",
    "watts",     "program",  "multiplier"};
constexpr std::array<std::string_view, 7> placeKeys{"node", "below",   "translation", "rotation",
                                                    "aim",  "azimuth", "altitude"};
constexpr std::array<std::string_view, 2> coneKeys{"shaping:cone:angle", "shaping:cone:softness"};
constexpr std::array<std::string_view, 6> profileKeys{"shaping:ies:file",
                                                      "shaping:ies:angleScale",
                                                      "shaping:ies:normalize",
                                                      "shaping:ies:turn",
                                                      "file",
                                                      "turn"};
constexpr std::array<Keys, 5> groups{sizeKeys, emissionKeys, placeKeys, coneKeys, profileKeys};
constexpr std::array<std::string_view, 3> fileKeys{"texture:file", "shaping:ies:file", "file"};

bool isIn(Keys keys, std::string_view key) {
    return std::ranges::find(keys, key) != keys.end();
}

/// What of a light goes with `key`.
std::vector<JsonMember> groupOf(const std::vector<JsonMember>& members, std::string_view key) {
    const auto group = std::ranges::find_if(groups, [&](Keys keys) { return isIn(keys, key); });
    std::vector<JsonMember> result;
    for (const JsonMember& member : members) {
        if (group == groups.end() ? member.key == key : isIn(*group, member.key)) result.push_back(member);
    }
    return result;
}

bool same(const std::vector<JsonMember>& a, const std::vector<JsonMember>& b) {
    return std::ranges::equal(
        a, b, [](const JsonMember& x, const JsonMember& y) { return x.key == y.key && x.value == y.value; });
}

bool has(const std::vector<JsonMember>& members, std::string_view key) {
    return std::ranges::find(members, key, &JsonMember::key) != members.end();
}

/// What `text` says, but for what differs between `was` and `now`, both written by us.
std::string merged(std::string_view text, const std::string& was, const std::string& now) {
    const std::vector<JsonMember> kept = jsonMembers(text), before = jsonMembers(was),
                                  after = jsonMembers(now);
    if (!same(groupOf(before, "type"), groupOf(after, "type"))) return now;
    // Where what shines is told for all of the light, it hangs on the light's size.
    const bool isOfAll = has(kept, "normalize") || has(kept, "watts");
    const auto changed = [&](std::string_view key) {
        const auto differs = [&](std::string_view of) {
            return !same(groupOf(before, of), groupOf(after, of));
        };
        return differs(key) || (isOfAll && isIn(emissionKeys, key) &&
                                (differs("width") || differs("shaping:cone:angle") || differs("file") ||
                                 differs("texture:file") || differs("twoSided")));
    };
    std::set<std::string> done;
    std::string result;
    const auto add = [&](const JsonMember& member) {
        if (!done.insert(member.key).second) return;
        result += fmt::format("{}{}: {}", result.empty() ? "{" : ", ", nlohmann::json(member.key).dump(),
                              member.value);
    };
    for (const JsonMember& member : kept) {
        if (!changed(member.key)) {
            add(member);
        } else {
            for (const JsonMember& other : groupOf(after, member.key)) add(other);
        }
    }
    for (const JsonMember& member : after) {
        if (changed(member.key)) add(member);
    }
    return result + "}";
}

std::string extensionOf(const LightProfile& profile) {
    return profile.version == "EULUMDAT" ? ".ldt" : ".ies";
}

Image imageOf(const Scene& scene, int texture) {
    const Picture& picture = scene.pictures[std::size_t(scene.textures[std::size_t(texture)].picture)];
    Image image(picture.width_px, picture.height_px, 4);
    std::ranges::transform(picture.rgba, image.values.begin(),
                           [](std::uint8_t value) { return float(value) / 255.0f; });
    return image;
}

std::string textOf(const fs::path& file) {
    const std::vector<std::byte> bytes = readWholeFile(file, maxFile_bytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

SidecarLight stated(const Light& light) {
    SidecarLight result{.light = light, .parentFromLight = worldFromLightOf(light)};
    if (light.profile) {
        const ProfiledEmission& profile = *light.profile;
        result.profile = {.file = "profile" + extensionOf(*profile.profile),
                          .isLuminaire = profile.isLuminaire,
                          .angleScale = profile.angleScale,
                          .normalize = profile.factor != 1,
                          .turn_deg = glm::degrees(profile.turn_rad)};
    }
    return result;
}

LightFile::LightFile(const fs::path& file) {
    std::error_code error;
    if (file.empty() || !fs::exists(file, error)) return;
    folder_ = fs::absolute(file).parent_path();
    text_ = textOf(file);
    lights_ = parseSidecar(text_, file.string()).lights.value_or(std::vector<SidecarLight>());
    for (const JsonMember& member : jsonMembers(text_)) {
        if (member.key != "lights") continue;
        for (const std::string_view element : jsonElements(member.value)) elements_.emplace_back(element);
    }
}

bool LightFile::liesIn(const fs::path& folder) const {
    std::error_code error;
    return !folder_.empty() && fs::equivalent(folder_, folder.empty() ? "." : folder, error);
}

std::string LightFile::elementOf(const WrittenLight& light) const {
    const bool isOwn = light.own && *light.own < elements_.size();
    if (!light.now) return elements_.at(*light.own);
    if (!isOwn || !light.was) return formatLight(*light.now);
    return merged(elements_[*light.own], formatLight(*light.was), formatLight(*light.now));
}

LightFile::Written LightFile::with(const Scene& scene, std::vector<WrittenLight> lights,
                                   const std::string& stem, bool beside) const {
    Written written;
    std::set<std::string> taken;  // names that the file's own text uses
    const auto filesIn = [](const std::string& element) {
        std::vector<std::string> names;
        for (const JsonMember& member : jsonMembers(element)) {
            if (isIn(fileKeys, member.key))
                names.push_back(nlohmann::json::parse(member.value).get<std::string>());
        }
        return names;
    };
    for (const std::string& element : elements_) {
        for (const std::string& name : filesIn(element)) taken.insert(name);
    }
    int number = 0;
    const auto freshName = [&](const std::string& extension) {
        std::string name;
        do {
            name = fmt::format("{}.light{}{}", stem, ++number, extension);
        } while (!taken.insert(name).second);
        return name;
    };

    const glm::dmat4 fileFromWorld = glm::inverse(scene.worldFromFile);
    std::map<std::string, std::string> contents;
    std::map<std::string, Image> pictures;
    std::vector<std::string> elements;
    for (WrittenLight& light : lights) {
        if (light.now) {
            SidecarLight& now = *light.now;
            if (now.profile) {
                const LightProfile& profile = *now.light.profile->profile;
                now.profile->file = freshName(extensionOf(profile));
                contents[now.profile->file] = profile.text;
                if (light.was && light.was->profile &&
                    light.was->light.profile->profile == now.light.profile->profile)
                    light.was->profile->file = now.profile->file;
            }
            if (now.light.texture >= 0) {
                now.textureFile = freshName(".png");
                pictures[now.textureFile] = imageOf(scene, now.light.texture);
                if (light.was && light.was->light.texture == now.light.texture)
                    light.was->textureFile = now.textureFile;
            }
            for (std::optional<SidecarLight>* const one : {&light.was, &light.now}) {
                if (*one && (*one)->node.empty() && scene.worldFromFile != glm::dmat4(1))
                    (*one)->parentFromLight = fileFromWorld * (*one)->parentFromLight;
            }
        }
        elements.push_back(elementOf(light));
    }

    // What the lights name: files of ours, and the old file's neighbours, which go with it.
    std::set<std::string> done;
    for (const std::string& element : elements) {
        for (const std::string& name : filesIn(element)) {
            if (!done.insert(name).second) continue;
            if (const auto content = contents.find(name); content != contents.end()) {
                written.files.emplace_back(name, content->second);
            } else if (const auto picture = pictures.find(name); picture != pictures.end()) {
                written.pictures.emplace_back(name, std::move(picture->second));
            } else if (!beside) {
                const std::vector<std::byte> bytes = readWholeFile(folder_ / name);
                written.files.emplace_back(
                    name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
            }
        }
    }

    const std::string text = text_.empty() ? formatSidecar({.lights = std::vector<SidecarLight>()}) : text_;
    for (const JsonMember& member : jsonMembers(text)) {
        if (member.key != "lights") continue;
        const std::size_t begin = std::size_t(member.value.data() - text.data());
        written.text = text.substr(0, begin) + withElements(member.value, elements) +
                       text.substr(begin + member.value.size());
        return written;
    }
    // A file about surfaces alone: its lights come last.
    const std::size_t last = text.find_last_not_of(" \t\r\n", text.rfind('}') - 1);
    written.text =
        fmt::format("{}{}\n  \"lights\": {}{}", text.substr(0, last + 1), text[last] == '{' ? "" : ",",
                    withElements("[]", elements), text.substr(last + 1));
    return written;
}

void write(const LightFile::Written& written, const fs::path& file) {
    const auto beside = [&](const std::string& name) {
        const fs::path path = file.parent_path() / name;
        std::error_code error;
        fs::create_directories(path.parent_path(), error);
        return path;
    };
    for (const auto& [name, picture] : written.pictures) writePng(beside(name), picture);
    for (const auto& [name, content] : written.files) writeFileAtomically(beside(name), content);
    writeFileAtomically(file, written.text);
}

}  // namespace penumbra::studio::viewer
