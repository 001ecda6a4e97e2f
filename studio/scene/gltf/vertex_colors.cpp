// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/vertex_colors.h"

#include <algorithm>

namespace penumbra::studio::gltf {

namespace {

constexpr int rampTexels = 256;

}  // namespace

bool VertexColors::apply(const std::vector<glm::vec4>& colors, Mesh& mesh) {
    if (std::ranges::any_of(colors, [](const glm::vec4& c) { return glm::vec3(c) != glm::vec3(1); }))
        mesh.colors.assign(colors.begin(), colors.end());

    const Material& material = scene_.materials[std::size_t(mesh.material)];
    if (material.alpha == Material::Alpha::opaque) return true;
    const auto [least, most] = std::ranges::minmax(colors, {}, &glm::vec4::a);
    if (least.a == most.a) {
        mesh.material = withAlpha(mesh.material, least.a);
        return true;
    }
    if (material.baseColorTexture >= 0) return false;
    mesh.material = withRamp(mesh.material);
    mesh.uvs.clear();
    // From the middle of the first texel to the middle of the last, between which filtering is linear.
    for (const glm::vec4& color : colors)
        mesh.uvs.emplace_back((color.a * (rampTexels - 1) + 0.5f) / rampTexels, 0.5f);
    return true;
}

int VertexColors::withAlpha(int material, float alpha) {
    if (alpha == 1) return material;
    const auto [known, isNew] = withAlpha_.try_emplace({material, alpha}, int(scene_.materials.size()));
    if (isNew) {
        Material made = scene_.materials[std::size_t(material)];
        made.baseColor.a *= alpha;
        scene_.materials.push_back(std::move(made));
    }
    return known->second;
}

int VertexColors::withRamp(int material) {
    const auto [known, isNew] = withRamp_.try_emplace(material, int(scene_.materials.size()));
    if (isNew) {
        Material made = scene_.materials[std::size_t(material)];
        made.baseColorTexture = rampTexture();
        made.emissionTexture = -1;  // whose coordinates are gone
        scene_.materials.push_back(std::move(made));
    }
    return known->second;
}

int VertexColors::rampTexture() {
    if (rampTexture_ >= 0) return rampTexture_;
    Picture ramp{.name = "alpha of vertices", .width_px = rampTexels, .height_px = 1};
    for (int i = 0; i < rampTexels; ++i) ramp.rgba.insert(ramp.rgba.end(), {255, 255, 255, std::uint8_t(i)});
    constexpr int linear = 9729, clampToEdge = 33071;
    scene_.textures.push_back({.picture = int(scene_.pictures.size()),
                               .minFilter = linear,
                               .magFilter = linear,
                               .wrapS = clampToEdge,
                               .wrapT = clampToEdge});
    scene_.pictures.push_back(std::move(ramp));
    return rampTexture_ = int(scene_.textures.size()) - 1;
}

}  // namespace penumbra::studio::gltf
