// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "studio/image/picture_decode.h"
#include "studio/scene/gltf/extensions.h"

namespace penumbra::studio::gltf {

namespace {

int enumMember(const JsonView& json, const char* key, int fallback, std::initializer_list<int> allowed) {
    const auto member = json.find(key);
    if (!member) return fallback;
    const int value = int(member->asInteger(0, 0xffff));
    if (std::ranges::find(allowed, value) == allowed.end())
        member->fail(fmt::format("{} is not allowed", value));
    return value;
}

Texture loadSampler(const JsonView& json) {
    return {
        .minFilter = enumMember(json, "minFilter", Texture().minFilter, {9728, 9729, 9984, 9985, 9986, 9987}),
        .magFilter = enumMember(json, "magFilter", Texture().magFilter, {9728, 9729}),
        .wrapS = enumMember(json, "wrapS", Texture().wrapS, {33071, 33648, 10497}),
        .wrapT = enumMember(json, "wrapT", Texture().wrapT, {33071, 33648, 10497})};
}

// u' = offset + rotation * (scale * u). The rotation is counter-clockwise as seen with v pointing down; the
// extension's example, which keeps to the lower left quadrant of the picture, fixes its sign.
glm::mat3 uvTransform(const JsonView& json) {
    const glm::vec2 offset = json.vec2("offset", glm::vec2(0)), scale = json.vec2("scale", glm::vec2(1));
    const float angle = json.number("rotation", 0), c = std::cos(angle), s = std::sin(angle);
    return {c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y, 0, offset.x, offset.y, 1};
}

UvSource loadUvSource(const JsonView& textureInfo) {
    constexpr int maxSets = 1000;
    UvSource source{.texCoord = int(textureInfo.integer("texCoord", 0, 0, maxSets))};
    if (const auto transform = extensionOf(textureInfo, "KHR_texture_transform")) {
        source.texCoord = int(transform->integer("texCoord", source.texCoord, 0, maxSets));
        source.transform = uvTransform(*transform);
    }
    return source;
}

class TextureLoader {
  public:
    TextureLoader(const JsonView& root, const Accessors& accessors, const std::filesystem::path& folder,
                  Budget& budget, Scene& scene)
        : accessors_(accessors),
          folder_(folder),
          budget_(budget),
          scene_(scene),
          textures_(root.list("textures")),
          images_(root.list("images")) {
        for (const JsonView& json : root.list("samplers")) samplers_.push_back(loadSampler(json));
        for (const JsonView& json : textures_) {
            json.index("sampler", samplers_.size());
            json.index("source", images_.size());
            if (const auto webp = extensionOf(json, "EXT_texture_webp"))
                webp->index("source", images_.size());
        }
        for (const JsonView& json : images_)
            if (json.has("uri") == (json.index("bufferView", accessors_.viewCount()).has_value()))
                json.fail("must have either a uri or a bufferView");
    }

    std::size_t size() const { return textures_.size(); }

    /// Index into Scene::textures, or -1 where the texture has no picture that can be read.
    int load(int index) {
        const JsonView& json = textures_[std::size_t(index)];
        const auto [known, isNew] = sceneTextures_.try_emplace(index, -1);
        if (!isNew) return known->second;
        const auto webp = extensionOf(json, "EXT_texture_webp");
        auto source = webp ? webp->index("source", images_.size()) : std::nullopt;
        if (!source) source = json.index("source", images_.size());
        if (!source) return leaveOut(json, "it has no picture in a format that is read here");
        const auto sampler = json.index("sampler", samplers_.size());
        Texture texture = sampler ? samplers_[std::size_t(*sampler)] : Texture();
        texture.picture = loadPicture(*source);
        if (texture.picture < 0) return -1;
        scene_.textures.push_back(texture);
        return known->second = int(scene_.textures.size()) - 1;
    }

  private:
    int leaveOut(const JsonView& json, const std::string& why) {
        scene_.warnings.push_back(fmt::format(
            "{}: left out, surfaces that show it are plain and have no holes: {}", json.pointer(), why));
        return -1;
    }

    int loadPicture(int index) {
        const auto [known, isNew] = scenePictures_.try_emplace(index, -1);
        if (!isNew) return known->second;
        const JsonView& json = images_[std::size_t(index)];
        const auto uri = json.find("uri");
        const bool isFile = uri && !uri->asString().starts_with("data:");
        const std::string name =
            json.string("name", isFile ? uri->asString() : fmt::format("image {}", index));
        try {
            const Bytes fetched = uri ? readUri(*uri, folder_, budget_) : Bytes();
            const std::span<const std::byte> bytes =
                uri ? fetched : accessors_.view(json.at("bufferView").asIndex(accessors_.viewCount())).bytes;
            const PictureSize size = readPictureSize(bytes, name);
            budget_.charge(std::uint64_t(size.width_px) * std::uint64_t(size.height_px), 4, json.pointer());
            scene_.pictures.push_back(decodePicture(bytes, name));
        } catch (const UnreadablePicture& error) {
            return leaveOut(json, error.what());
        } catch (const MissingFile& error) {
            return leaveOut(json, error.what());
        } catch (const InputError& error) {
            json.fail(error.what());
        }
        return known->second = int(scene_.pictures.size()) - 1;
    }

    const Accessors& accessors_;
    const std::filesystem::path& folder_;
    Budget& budget_;
    Scene& scene_;
    std::vector<JsonView> textures_, images_;
    std::vector<Texture> samplers_;
    std::map<int, int> sceneTextures_, scenePictures_;  // index in the file -> index in the scene
};

enum class AlphaMode { opaque, mask, blend };

AlphaMode loadAlphaMode(const JsonView& json) {
    const std::string mode = json.string("alphaMode", "OPAQUE");
    if (mode == "OPAQUE") return AlphaMode::opaque;
    if (mode == "MASK") return AlphaMode::mask;
    if (mode == "BLEND") return AlphaMode::blend;
    json.at("alphaMode").fail(fmt::format("'{}' is not OPAQUE, MASK or BLEND", mode));
}

// What half covers a surface blocks light, what covers less lets it through; a texture decides place by
// place.
constexpr float leastOfASolid = 0.5f;

bool hasHoles(const Picture& picture, float factor) {
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
        if (factor * float(picture.rgba[i]) / 255 < leastOfASolid) return true;
    return false;
}

// What passes a surface, a channel each. glTF's alpha is how much of it is there at all
// (specification, 3.9.4), and what is not there takes nothing; of what is there KHR_materials_transmission
// lets a share through, times the base colour. Without what is reflected at a pane's faces.
glm::vec3 passingShare(float transmission, AlphaMode mode, const glm::vec4& baseColor) {
    const float there = mode == AlphaMode::blend ? baseColor.a : 1;
    return (1 - there) + there * transmission * glm::vec3(baseColor);
}

// A material of which one can see through all or parts becomes glass, or a mask.
void makeGlass(const JsonView& json, AlphaMode mode, Glass glass, const Scene& scene, Material& material) {
    const auto extension = extensionOf(json, "KHR_materials_transmission");
    const float transmission = extension ? extension->number("transmissionFactor", 0, {0, 1}) : 0;
    // What a texture says of a surface that is there for the most part is where it has holes.
    const bool isCutOut =
        mode == AlphaMode::blend && material.baseColorTexture >= 0 && material.baseColor.a >= leastOfASolid;
    const glm::vec3 passes = passingShare(transmission, mode, material.baseColor);
    const bool letsThrough = transmission > 0 || (mode == AlphaMode::blend && material.baseColor.a < 1);
    if (glass == Glass::tinted && letsThrough && !isCutOut && passes != glm::vec3(1))
        material.transmittance = passes;
    if (transmission > leastOfASolid) {
        material.glass = glm::vec3(material.baseColor);
    } else if (mode == AlphaMode::blend && material.baseColor.a < leastOfASolid) {
        material.glass = glm::mix(glm::vec3(1), glm::vec3(material.baseColor), material.baseColor.a);
    } else if (mode == AlphaMode::blend && material.baseColorTexture >= 0) {
        const Texture& texture = scene.textures[std::size_t(material.baseColorTexture)];
        if (!hasHoles(scene.pictures[std::size_t(texture.picture)], material.baseColor.a)) return;
        material.alpha = Material::Alpha::mask;
        material.alphaCutoff = leastOfASolid;
    }
}

// Emission is in nits (KHR_materials_emissive_strength). Its texture shares the coordinates of the base
// colour's.
void loadEmission(const JsonView& json, TextureLoader& textures, Material& material,
                  std::optional<UvSource>& uvSource, std::vector<std::string>& warnings) {
    constexpr float maxStrength = 1e9f;
    const auto strength = extensionOf(json, "KHR_materials_emissive_strength");
    material.emission_nits = glm::clamp(json.vec3("emissiveFactor", glm::vec3(0)), 0.0f, 1.0f) *
                             (strength ? strength->number("emissiveStrength", 1, {0, maxStrength}) : 1);
    const auto info = json.find("emissiveTexture");
    if (!info) return;
    const int index = info->at("index").asIndex(textures.size());
    if (material.emission_nits == glm::vec3(0)) return;
    const UvSource own = loadUvSource(*info);
    if (uvSource.value_or(own) != own) {
        warnings.push_back(
            info->pointer() +
            ": has other texture coordinates than the base colour's; left out, all of it glows");
        return;
    }
    material.emissionTexture = textures.load(index);
    if (material.emissionTexture >= 0) uvSource = own;
}

void nameGlowing(const Scene& scene, std::vector<std::string>& warnings) {
    const auto count = std::ranges::count_if(
        scene.materials, [](const Material& material) { return material.emission_nits != glm::vec3(0); });
    if (count > 0)
        warnings.push_back(
            fmt::format("/materials: {} of them glow; they are seen so, but light nothing: "
                        "lights are made in SCENE.lights.json",
                        count));
}

}  // namespace

std::vector<std::optional<UvSource>> loadMaterials(const JsonView& root, const Accessors& accessors,
                                                   const std::filesystem::path& folder, Glass glass,
                                                   Budget& budget, Scene& scene) {
    TextureLoader textures(root, accessors, folder, budget, scene);
    std::vector<std::optional<UvSource>> uvSources;
    for (const JsonView& json : root.list("materials")) {
        const AlphaMode mode = loadAlphaMode(json);
        Material material{.name = json.string("name"),
                          .alpha = mode == AlphaMode::mask ? Material::Alpha::mask : Material::Alpha::opaque,
                          .alphaCutoff = json.number("alphaCutoff", 0.5f, {0, 1e6f}),
                          .doubleSided = json.boolean("doubleSided", false),
                          .unlit = extensionOf(json, "KHR_materials_unlit").has_value()};
        std::optional<UvSource>& uvSource = uvSources.emplace_back();
        if (const auto pbr = json.find("pbrMetallicRoughness")) {
            if (const auto factor = pbr->find("baseColorFactor")) {
                const std::vector<float> v = factor->asNumbers(4);
                material.baseColor = glm::clamp(glm::vec4(v[0], v[1], v[2], v[3]), 0.0f, 1.0f);
            }
            if (const auto info = pbr->find("baseColorTexture")) {
                material.baseColorTexture = textures.load(info->at("index").asIndex(textures.size()));
                if (material.baseColorTexture >= 0) uvSource = loadUvSource(*info);
            }
            if (const auto info = pbr->find("metallicRoughnessTexture"))
                info->at("index").asIndex(textures.size());
        }
        if (glass != Glass::blocks) makeGlass(json, mode, glass, scene, material);
        loadEmission(json, textures, material, uvSource, scene.warnings);
        for (const char* key : {"normalTexture", "occlusionTexture"})
            if (const auto info = json.find(key)) info->at("index").asIndex(textures.size());
        scene.materials.push_back(std::move(material));
    }
    nameGlowing(scene, scene.warnings);
    scene.materials.push_back({.name = "default"});
    uvSources.emplace_back();
    return uvSources;
}

}  // namespace penumbra::studio::gltf
