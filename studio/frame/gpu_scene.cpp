// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/gpu_scene.h"

#include <algorithm>
#include <bit>

#include "studio/frame/conversions.h"
#include "studio/scene/profiles/light_profile.h"
#include "studio/scene/solid.h"

namespace penumbra::studio {
namespace {

/// Colour is decoded from sRGB by the sampler, so that filtering happens in linear light.
gl::Texture uploadPicture(const Picture& picture, std::span<const std::uint8_t> rgba) {
    const int largest = std::max(picture.width_px, picture.height_px);
    gl::Texture result({.width_px = picture.width_px,
                        .height_px = picture.height_px,
                        .levels = int(std::bit_width(unsigned(largest))),
                        .format = gl::Format::rgba8srgb,
                        .label = picture.name});
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(result.name(), 0, 0, 0, picture.width_px, picture.height_px, GL_RGBA,
                        GL_UNSIGNED_BYTE, rgba.data());
    glGenerateTextureMipmap(result.name());
    return result;
}

gl::Texture uploadTexture(const Texture& texture, const Picture& picture) {
    gl::Texture result = uploadPicture(picture, picture.rgba);
    const GLuint name = result.name();
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, texture.minFilter);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, texture.magFilter);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, texture.wrapS);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, texture.wrapT);
    return result;
}

gl::Texture uploadRadianceTexture(const Picture& picture) {
    std::vector<std::uint8_t> bottomUp;
    const std::size_t row = std::size_t(picture.width_px) * 4;
    for (std::size_t y = std::size_t(picture.height_px); y-- > 0;) {
        bottomUp.insert(bottomUp.end(), &picture.rgba[y * row], &picture.rgba[y * row] + row);
    }
    gl::Texture result = uploadPicture(picture, bottomUp);
    glTextureParameteri(result.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(result.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return result;
}

gl::Buffer uploadProfile(const LightProfile& profile) {
    const CandelaGrid& grid = profile.grid;
    std::vector<float> values;
    for (const auto* angles : {&grid.verticals_deg, &grid.horizontals_deg})
        for (const double angle : *angles) values.push_back(float(glm::radians(angle)));
    values.insert(values.end(), grid.candela.begin(), grid.candela.end());
    return gl::Buffer(std::as_bytes(std::span(values)), "profile");
}

}  // namespace

GpuScene::GpuScene(Device& device, const Scene& scene)
    : device_(device), scene_(scene), noProfile_(sizeof(float), "no profile") {
    for (const Texture& texture : scene.textures) {
        textures_.push_back(uploadTexture(texture, scene.pictures[std::size_t(texture.picture)]));
    }
    for (const Mesh& mesh : scene.meshes) shared_.push_back(upload(mesh));
}

GpuScene::MeshOnDevice GpuScene::upload(const Mesh& mesh) {
    std::optional<gl::Buffer> colors;
    if (!mesh.colors.empty()) colors.emplace(std::as_bytes(std::span(mesh.colors)), "mesh colours");
    return {penumbra::Mesh(device_, {.positions = asPenumbra(std::span(mesh.positions)),
                                     .indices = mesh.indices,
                                     .uvs = asPenumbra(std::span(mesh.uvs))}),
            gl::Buffer(std::as_bytes(std::span(mesh.normals)), "mesh normals"), std::move(colors)};
}

const gl::Buffer& GpuScene::profile(const Light& light) const {
    return light.profile ? profiles_.at(light.profile->profile.get()).values : noProfile_;
}

void GpuScene::update(const SceneMoment& moment) {
    const auto isDeformed = [](const Instance& instance) { return !instance.positions.empty(); };
    // Meshes are referred to by address below, so all of them are made first.
    std::size_t made = 0;
    for (const Instance& instance : moment.instances) {
        if (isDeformed(instance) && ++made > deforming_.size()) {
            deforming_.push_back(upload(scene_.meshes[std::size_t(instance.mesh)]));
        }
    }

    for (const Light& light : moment.lights) {
        if (!light.profile || profiles_.contains(light.profile->profile.get())) continue;
        const auto& profile = light.profile->profile;
        profiles_.emplace(profile.get(), ProfileOnDevice{profile, uploadProfile(*profile)});
    }
    for (const Light& light : moment.lights) {
        if (light.texture < 0 || radianceTextures_.contains(light.texture)) continue;
        const Texture& texture = scene_.textures[std::size_t(light.texture)];
        radianceTextures_.emplace(light.texture,
                                  uploadRadianceTexture(scene_.pictures[std::size_t(texture.picture)]));
    }

    drawables_.clear();
    casters_.clear();
    std::size_t nextDeforming = 0;
    std::vector<int> surfaces;  // of the caster that was added last
    const Instance* first = nullptr;
    for (const Instance& instance : moment.instances) {
        const Mesh& mesh = scene_.meshes[std::size_t(instance.mesh)];
        const Material& material = scene_.materials[std::size_t(mesh.material)];
        MeshOnDevice* onDevice = &shared_[std::size_t(instance.mesh)];
        if (isDeformed(instance)) {
            onDevice = &deforming_[nextDeforming++];
            onDevice->mesh.deform(asPenumbra(std::span(instance.positions)));
            onDevice->normals.write(std::as_bytes(std::span(instance.normals)));
        }
        drawables_.push_back({.mesh = &onDevice->mesh,
                              .normals = &onDevice->normals,
                              .colorBuffer = onDevice->colors ? onDevice->colors->name() : 0,
                              .material = &material,
                              .worldFromMesh = instance.worldFromMesh,
                              .receives = instance.receives});

        const bool isSolid =
            mesh.solid >= 0 && !isDeformed(instance) && material.alpha == Material::Alpha::opaque;
        const bool goesOn = isSolid && first && first->node == instance.node &&
                            scene_.meshes[std::size_t(first->mesh)].solid == mesh.solid &&
                            first->worldFromMesh == instance.worldFromMesh &&
                            first->casts == instance.casts && first->receives == instance.receives &&
                            first->transmittance == instance.transmittance &&
                            std::ranges::find(surfaces, instance.mesh) == surfaces.end();
        if (goesOn) {
            surfaces.push_back(instance.mesh);
            casters_.back().mesh = nullptr;  // below, once all of its surfaces are known
        } else {
            if (!casters_.empty() && !casters_.back().mesh)
                casters_.back().mesh = &solidOf(std::move(surfaces));
            surfaces = {instance.mesh};
            first = isSolid ? &instance : nullptr;
            casters_.push_back(casterOf(instance, *onDevice));
        }
    }
    if (!casters_.empty() && !casters_.back().mesh) casters_.back().mesh = &solidOf(std::move(surfaces));
}

Caster GpuScene::casterOf(const Instance& instance, const MeshOnDevice& onDevice) const {
    const Mesh& mesh = scene_.meshes[std::size_t(instance.mesh)];
    const Material& material = scene_.materials[std::size_t(mesh.material)];
    Caster caster{
        .mesh = &onDevice.mesh,
        .worldFromMesh = toPenumbra(instance.worldFromMesh),
        .transmittance = {instance.transmittance.r, instance.transmittance.g, instance.transmittance.b},
        .casts = instance.casts,
        .receives = instance.receives};
    if (material.alpha == Material::Alpha::mask && material.baseColorTexture >= 0) {
        // Textures live as long as the scene's meshes, whose ids are never used again.
        caster.alphaMask = {.texture = texture(material.baseColorTexture),
                            .factor = material.baseColor.a,
                            .cutoff = material.alphaCutoff,
                            .revision = 1 + shared_.front().mesh.id()};
    } else if (material.alpha == Material::Alpha::mask && material.baseColor.a < material.alphaCutoff) {
        caster.casts = false;  // all of it is a hole
    }
    return caster;
}

const penumbra::Mesh& GpuScene::solidOf(std::vector<int> meshes) {
    const auto known = solids_.find(meshes);
    if (known != solids_.end()) return known->second;
    const Solid solid = joinMeshes(scene_, meshes);
    penumbra::Mesh mesh(device_,
                        {.positions = asPenumbra(std::span(solid.positions)), .indices = solid.indices});
    return solids_.emplace(std::move(meshes), std::move(mesh)).first->second;
}

}  // namespace penumbra::studio
