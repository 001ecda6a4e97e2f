// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "studio/errors.h"
#include "studio/image/picture_decode.h"
#include "studio/scene/file_beside.h"
#include "studio/scene/gltf/lights.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/lights/sidecar.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/scene/profiles/profile_file.h"
#include "studio/scene/wildcard.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t maxSidecar_bytes = 4u << 20, maxPicture_bytes = 256u << 20;
constexpr std::uint64_t maxPixels = 1ull << 27;  // of all pictures of a sidecar together

/// Adds the pictures of a sidecar's lights to a scene, each once.
class TextureLoader {
  public:
    TextureLoader(Scene& scene, const fs::path& folder) : scene_(scene), folder_(folder) {}

    int load(const std::string& text, const std::string& where) {
        const auto [found, isNew] = textures_.try_emplace(text, int(scene_.textures.size()));
        if (!isNew) return found->second;
        const std::vector<std::byte> bytes = readWholeFile(
            fileBeneath(folder_, text, fmt::format("{}: 'texture:file'", where)), maxPicture_bytes, where);
        constexpr int clampToEdge = 33071;
        Texture texture;
        texture.picture = int(scene_.pictures.size());
        texture.wrapS = texture.wrapT = clampToEdge;
        scene_.pictures.push_back(decode(bytes, text, where));
        scene_.textures.push_back(texture);
        return found->second;
    }

  private:
    Picture decode(std::span<const std::byte> bytes, const std::string& text, const std::string& where) {
        try {
            const PictureSize size = readPictureSize(bytes, text);
            pixels_ += std::uint64_t(size.width_px) * size.height_px;
            if (pixels_ > maxPixels)
                throw InputError(fmt::format("the pictures have more than {} pixels together", maxPixels));
            return decodePicture(bytes, text);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", where, error.what()));
        }
    }

    Scene& scene_;
    const fs::path& folder_;
    std::map<std::string, int> textures_;
    std::uint64_t pixels_ = 0;
};

/// Reads the profiles of a sidecar's lights, each once.
class ProfileLoader {
  public:
    ProfileLoader(Scene& scene, const fs::path& folder) : scene_(scene), folder_(folder) {}

    /// Gives the light its profile, and a luminaire its shape.
    void load(const SidecarProfile& stated, const std::string& where, Light& light) {
        const auto profile = read(stated, where);
        const float turn_rad = glm::radians(stated.turn_deg);
        if (stated.isLuminaire) {
            const std::string note = makeLuminaire(profile, turn_rad, light.emission.value, light);
            if (!note.empty())
                scene_.warnings.push_back(fmt::format("{}: '{}': {}", where, stated.file, note));
            return;
        }
        const double mean_cd = profile->grid.integral() / (4 * std::numbers::pi);
        if (stated.normalize && !(mean_cd > 0))
            throw InputError(
                fmt::format("{}: '{}' is dark: there is no mean to divide by", where, stated.file));
        light.profile = {.profile = profile,
                         .turn_rad = turn_rad,
                         .angleScale = stated.angleScale,
                         .factor = stated.normalize ? float(1 / mean_cd) : 1};
    }

  private:
    std::shared_ptr<const LightProfile> read(const SidecarProfile& stated, const std::string& where) {
        auto& profile = profiles_[stated.file];
        if (profile) return profile;
        const char* const key = stated.isLuminaire ? "file" : "shaping:ies:file";
        profile = std::make_shared<LightProfile>(
            readProfile(fileBeneath(folder_, stated.file, fmt::format("{}: '{}'", where, key)), where));
        scene_.warnings.insert(scene_.warnings.end(), profile->warnings.begin(), profile->warnings.end());
        return profile;
    }

    Scene& scene_;
    fs::path folder_;
    std::map<std::string, std::shared_ptr<const LightProfile>> profiles_;
};

struct SurfaceFlags {
    std::optional<bool> casts, receives;
};

/// Which of a scene's nodes, or materials, have a name. `kind` is what one of them is called in messages.
class NameIndex {
  public:
    NameIndex(std::vector<std::string> names, std::string_view kind, std::string fileName)
        : names_(std::move(names)), kind_(kind), fileName_(std::move(fileName)) {
        for (std::size_t i = 0; i < names_.size(); ++i) byName_[names_[i]].push_back(int(i));
    }

    const std::vector<int>& all(const std::string& name, int line) const {
        const auto found = byName_.find(name);
        if (found != byName_.end()) return found->second;
        const std::vector<std::string_view> names(names_.begin(), names_.end());
        throw InputError(fmt::format("{}:{}: the scene has no {} '{}'{}", fileName_, line, kind_, name,
                                     didYouMean(name, names)));
    }

    /// Those of the name or, where none has just that, of the pattern (`*`, `?`); none may match one.
    std::vector<int> matching(const std::string& pattern, int line) const {
        if (byName_.contains(pattern) || pattern.find_first_of("*?") == std::string::npos)
            return all(pattern, line);
        std::vector<int> all;
        for (const auto& [name, ofName] : byName_)
            if (matchesWildcard(name, pattern)) all.insert(all.end(), ofName.begin(), ofName.end());
        return all;
    }

    /// The only one of the name or pattern.
    int one(const std::string& name, int line) const {
        const std::vector<int> named = matching(name, line);
        if (named.empty())
            throw InputError(fmt::format("{}:{}: no {} is named '{}'", fileName_, line, kind_, name));
        if (named.size() > 1)
            throw InputError(
                fmt::format("{}:{}: the scene has {} {}s named '{}'; a light can hang on one only", fileName_,
                            line, named.size(), kind_, name));
        return named[0];
    }

    /// What the rules say, by index; a pattern that matches nothing becomes a warning.
    std::map<int, SurfaceFlags> flagsOf(const std::vector<SurfaceRule>& rules,
                                        std::vector<std::string>& warnings) const {
        std::map<int, SurfaceFlags> flags;
        for (const SurfaceRule& rule : rules) {
            const std::vector<int> named = matching(rule.name, rule.line);
            if (named.empty())
                warnings.push_back(
                    fmt::format("{}:{}: no {} is named '{}'", fileName_, rule.line, kind_, rule.name));
            for (const int index : named) {
                if (rule.casts) flags[index].casts = rule.casts;
                if (rule.receives) flags[index].receives = rule.receives;
            }
        }
        return flags;
    }

  private:
    std::vector<std::string> names_;
    std::string_view kind_;
    std::string fileName_;
    std::map<std::string, std::vector<int>, std::less<>> byName_;
};

struct AttachedLight {
    Light light;
    glm::dmat4 parentFromLight{1};
    std::optional<int> node;
    bool isInWorld = false, isBelow = false;
};

/// From the middle of a node's underside, with the world's axes; nothing where it has no mesh.
std::optional<glm::dmat4> worldFromUnderside(const Scene& scene, const SceneMoment& moment, int node) {
    Bounds bounds;
    for (const Instance& instance : moment.instances) {
        if (instance.node != node) continue;
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        for (const glm::vec3& position : instance.positions.empty() ? mesh.positions : instance.positions) {
            const glm::vec3 posWorld(instance.worldFromMesh * glm::vec4(position, 1));
            bounds.include(posWorld);
        }
    }
    if (bounds.empty()) return {};
    const glm::dvec3 middle = bounds.center();
    return glm::translate(glm::dmat4(1), glm::dvec3(middle.x, bounds.min.y, middle.z));
}

class SidecarMotion : public Scene::Motion {
  public:
    SidecarMotion(std::shared_ptr<const Scene::Motion> inner,
                  std::optional<std::vector<AttachedLight>> lights, std::map<int, SurfaceFlags> ofMaterials,
                  std::map<int, SurfaceFlags> ofNodes)
        : inner_(std::move(inner)),
          lights_(std::move(lights)),
          ofMaterials_(std::move(ofMaterials)),
          ofNodes_(std::move(ofNodes)) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, time_s);
        for (Instance& instance : moment.instances) {
            setFlags(ofMaterials_, scene.meshes[std::size_t(instance.mesh)].material, instance);
            setFlags(ofNodes_, instance.node, instance);
        }
        if (lights_) {
            moment.lights.clear();
            for (const AttachedLight& attached : *lights_) {
                const glm::dmat4 worldFromParent = worldFromParentOf(attached, scene, moment);
                Light light = attached.light;
                glm::mat4 worldFromLight =
                    gltf::rigidPart(glm::mat4(worldFromParent * attached.parentFromLight));
                // A distant light is nowhere, least of all where the file's origin lies.
                if (light.shape.shape == LightShape::distant) worldFromLight[3] = {0, 0, 0, 1};
                place(light, worldFromLight);
                moment.lights.push_back(std::move(light));
            }
        }
        return moment;
    }

  private:
    static void setFlags(const std::map<int, SurfaceFlags>& flags, int index, Instance& instance) {
        const auto found = flags.find(index);
        if (found == flags.end()) return;
        if (found->second.casts) {  // all or nothing, of panes too
            instance.casts = *found->second.casts;
            instance.transmittance = glm::vec3(0);
        }
        instance.receives = found->second.receives.value_or(instance.receives);
    }

    static glm::dmat4 worldFromParentOf(const AttachedLight& attached, const Scene& scene,
                                        const SceneMoment& moment) {
        if (attached.isBelow) return worldFromUnderside(scene, moment, *attached.node).value();
        if (attached.node) return moment.worldFromNode[std::size_t(*attached.node)];
        return attached.isInWorld ? glm::dmat4(1) : scene.worldFromFile;
    }

    std::shared_ptr<const Scene::Motion> inner_;
    std::optional<std::vector<AttachedLight>> lights_;
    std::map<int, SurfaceFlags> ofMaterials_, ofNodes_;  ///< by index
};

}  // namespace

glm::dmat4 worldFromParent(const SidecarLight& light, const Scene& scene, const SceneMoment& moment) {
    if (light.node.empty()) return light.isInWorld ? glm::dmat4(1) : scene.worldFromFile;
    const int node = NameIndex(scene.nodeNames, "node", "the lights").one(light.node, light.nodeLine);
    if (light.isBelow) return worldFromUnderside(scene, moment, node).value();
    return moment.worldFromNode.at(std::size_t(node));
}

Sidecar readSidecar(const fs::path& file) {
    const std::vector<std::byte> bytes = readWholeFile(file, maxSidecar_bytes, "lights");
    return parseSidecar({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

void applySidecar(Scene& scene, const Sidecar& sidecar, const fs::path& folder) {
    std::vector<std::string> materialNames;
    for (const Material& material : scene.materials) materialNames.push_back(material.name);
    const NameIndex materials(std::move(materialNames), "material", sidecar.fileName);
    const NameIndex nodes(scene.nodeNames, "node", sidecar.fileName);
    std::map<int, SurfaceFlags> ofMaterials = materials.flagsOf(sidecar.surfaces.materials, scene.warnings);
    std::map<int, SurfaceFlags> ofNodes = nodes.flagsOf(sidecar.surfaces.nodes, scene.warnings);

    std::optional<std::vector<AttachedLight>> lights;
    if (sidecar.lights) {
        lights.emplace();
        TextureLoader textures(scene, folder);
        ProfileLoader profiles(scene, folder);
        for (const SidecarLight& read : *sidecar.lights) {
            AttachedLight attached{read.light, read.parentFromLight, {}, read.isInWorld, read.isBelow};
            if (read.profile)
                profiles.load(*read.profile, fmt::format("{}:{}", sidecar.fileName, read.profile->line),
                              attached.light);
            if (!read.node.empty()) attached.node = nodes.one(read.node, read.nodeLine);
            if (read.isBelow && !worldFromUnderside(scene, scene.at(0), *attached.node))
                throw InputError(
                    fmt::format("{}:{}: the node '{}' has no mesh of its own to hang below; 'penumbra info "
                                "--nodes' lists those that have",
                                sidecar.fileName, read.nodeLine, read.node));
            if (!read.textureFile.empty())
                attached.light.texture =
                    textures.load(read.textureFile, fmt::format("{}:{}", sidecar.fileName, read.textureLine));
            lights->push_back(std::move(attached));
        }
    }
    scene.motion = std::make_shared<SidecarMotion>(scene.motion, std::move(lights), std::move(ofMaterials),
                                                   std::move(ofNodes));
}

}  // namespace penumbra::studio
