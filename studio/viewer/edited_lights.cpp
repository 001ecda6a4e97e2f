// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/edited_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/reference/content_hash.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/gltf/lights.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio::viewer {
namespace {

namespace fs = std::filesystem;

/// How much of its emission's unit (nits, candela, lux) a light gives to a surface far off that faces it: the
/// area or the solid angle that it shows, or 1 for a light of size zero.
float effect(const AreaLight& shape) {
    constexpr float pi = std::numbers::pi_v<float>;
    switch (shape.shape) {
        case LightShape::rect:
            return shape.width_m * shape.height_m;
        case LightShape::disk:
        case LightShape::sphere:
            return pi * shape.radius_m * shape.radius_m;
        case LightShape::cylinder:
            return 2 * shape.radius_m * shape.length_m;
        case LightShape::distant: {
            const float sine = std::sin(0.5f * shape.angle_rad);
            return pi * sine * sine;
        }
    }
    return 0;
}

void setUnit(Light& light) {
    const bool hasSize = effect(light.shape) > 0;
    light.emission.unit = hasSize                                    ? Emission::Unit::nits
                          : light.shape.shape == LightShape::distant ? Emission::Unit::lux
                                                                     : Emission::Unit::candela;
}

std::string extensionOf(const LightProfile& profile) {
    return profile.version == "EULUMDAT" ? ".ldt" : ".ies";
}

/// "lamp", or "lamp 2" where that is taken.
void makeNamesUnique(std::vector<Light>& lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string wanted = lights[i].name.empty() ? "light" : lights[i].name;
        lights[i].name = wanted;
        const auto isTaken = [&] {
            return std::any_of(lights.begin(), lights.begin() + std::ptrdiff_t(i),
                               [&](const Light& other) { return other.name == lights[i].name; });
        };
        for (int number = 2; isTaken(); ++number) lights[i].name = fmt::format("{} {}", wanted, number);
    }
}

/// What a file of these lights says, read back.
std::vector<Light> throughText(const std::vector<SidecarLight>& lights) {
    const Sidecar sidecar{.fileName = "edited lights", .lights = lights};
    const Sidecar read = parseSidecar(formatSidecar(sidecar), sidecar.fileName);
    std::vector<Light> result;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light light = read.lights->at(i).light;
        light.texture = lights[i].light.texture;
        light.profile = lights[i].light.profile;
        if (light.profile && light.profile->isLuminaire) light.shape = lights[i].light.shape;
        place(light, gltf::rigidPart(glm::mat4(read.lights->at(i).parentFromLight)));
        result.push_back(std::move(light));
    }
    return result;
}

/// A light as a file states it, but for the names of the files that it needs.
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

struct LightFiles {
    std::string text;
    std::vector<std::pair<std::string, std::string>> profiles;  ///< by file name
    std::vector<std::pair<std::string, Image>> pictures;        ///< by file name
};

LightFiles filesOf(const Scene& scene, std::vector<SidecarLight> lights, const std::string& stem,
                   SurfaceRules surfaces) {
    LightFiles files;
    const glm::dmat4 fileFromWorld = glm::inverse(scene.worldFromFile);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].profile) {
            const LightProfile& profile = *lights[i].light.profile->profile;
            lights[i].profile->file = fmt::format("{}.light{}{}", stem, i + 1, extensionOf(profile));
            files.profiles.emplace_back(lights[i].profile->file, profile.text);
        }
        if (scene.worldFromFile != glm::dmat4(1))
            lights[i].parentFromLight = fileFromWorld * lights[i].parentFromLight;
        const int texture = lights[i].light.texture;
        if (texture < 0) continue;
        const Picture& picture = scene.pictures[std::size_t(scene.textures[std::size_t(texture)].picture)];
        Image image(picture.width_px, picture.height_px, 4);
        std::ranges::transform(picture.rgba, image.values.begin(),
                               [](std::uint8_t value) { return float(value) / 255.0f; });
        lights[i].textureFile = fmt::format("{}.light{}.png", stem, i + 1);
        files.pictures.emplace_back(lights[i].textureFile, std::move(image));
    }
    files.text =
        formatSidecar({.fileName = stem, .lights = std::move(lights), .surfaces = std::move(surfaces)});
    return files;
}

SurfaceRules surfacesOf(const fs::path& sidecar) {
    std::error_code error;
    return fs::exists(sidecar, error) ? readSidecar(sidecar).surfaces : SurfaceRules();
}

void write(const LightFiles& files, const fs::path& file) {
    for (const auto& [name, picture] : files.pictures) writePng(file.parent_path() / name, picture);
    for (const auto& [name, text] : files.profiles) writeFileAtomically(file.parent_path() / name, text);
    writeFileAtomically(file, files.text);
}

}  // namespace

Light newLight(const Bounds& bounds, std::size_t number) {
    Light light = keyLight("new light", bounds);
    // The golden angle: never where one was before.
    const glm::mat4 turn = glm::translate(glm::mat4(1), bounds.center()) *
                           glm::rotate(glm::mat4(1), 2.4f * float(number), glm::vec3(0, 1, 0)) *
                           glm::translate(glm::mat4(1), -bounds.center());
    light.shape.worldFromLight =
        std::bit_cast<Mat4>(turn * std::bit_cast<glm::mat4>(light.shape.worldFromLight));
    return light;
}

void changeShape(Light& light, LightShape shape) {
    AreaLight& area = light.shape;
    if (area.shape == shape) return;
    const glm::mat4 worldFromLight = std::bit_cast<glm::mat4>(area.worldFromLight);
    const float distance_m = std::max(glm::length(glm::vec3(worldFromLight[3])), 0.1f);
    const glm::vec3 color = light.emission.value * effect(area);
    const bool wasDistant = area.shape == LightShape::distant;
    const float radius_m = area.shape == LightShape::rect ? 0.5f * std::sqrt(area.width_m * area.height_m)
                           : wasDistant                   ? distance_m * std::tan(0.5f * area.angle_rad)
                           : area.shape == LightShape::cylinder ? 0.5f * area.length_m
                                                                : area.radius_m;
    constexpr float slenderness = 20;  // of a tube of T8, 26 mm across, of 0.6 m
    area.shape = shape;
    area.width_m = area.height_m = shape == LightShape::rect ? 2 * radius_m : 0;
    area.length_m = shape == LightShape::cylinder ? 2 * radius_m : 0;
    area.radius_m = shape == LightShape::disk || shape == LightShape::sphere ? radius_m
                    : shape == LightShape::cylinder                          ? radius_m / slenderness
                                                                             : 0;
    area.angle_rad = shape == LightShape::distant ? 2 * std::atan(radius_m / distance_m) : 0;
    if (shape != LightShape::rect) light.texture = -1;
    light.profile.reset();
    light.sun.reset();
    if (shape == LightShape::distant) light.cone_rad.reset();
    if (shape != LightShape::rect && shape != LightShape::disk) area.twoSided = false;
    // Candela at a distance are lux of a distant light.
    const float toLux = (shape == LightShape::distant) == wasDistant ? 1.0f
                        : wasDistant                                 ? distance_m * distance_m
                                                                     : 1 / (distance_m * distance_m);
    const float now = effect(area);
    light.emission.value = color * toLux / (now > 0 ? now : 1);
    setUnit(light);
}

void setSize(Light& light, float AreaLight::*size, float value) {
    if (light.profile && light.profile->isLuminaire) return;  // its size is its file's
    light.sun.reset();
    const float before = effect(light.shape);
    light.shape.*size = value;
    const float now = effect(light.shape);
    if ((before > 0) != (now > 0)) light.emission.value *= now > 0 ? 1 / now : before;
    setUnit(light);
}

void EditedLights::apply(SceneMoment& moment) const {
    if (state_) moment.lights = state_->lights;
}

void EditedLights::edit(std::vector<Light> lights) {
    makeNamesUnique(lights);
    auto state = std::make_shared<State>();
    for (const Light& light : lights) state->written.push_back(stated(light));
    state->lights = throughText(state->written);
    state_ = std::move(state);
}

std::vector<SidecarLight> EditedLights::written() const {
    return state_ ? state_->written : std::vector<SidecarLight>();
}

void EditedLights::save(const Scene& scene, const fs::path& file) {
    write(filesOf(scene, written(), file.stem().stem().string(), surfacesOf(file)), file);
    saved_ = state_;
}

fs::path EditedLights::snapshot(const Scene& scene, const fs::path& folder, const fs::path& sidecar) const {
    std::error_code error;
    fs::create_directories(folder, error);
    const SurfaceRules surfaces = surfacesOf(sidecar);
    LightFiles files = filesOf(scene, written(), "lights", surfaces);
    ContentHasher hasher;
    hasher.addArray(files.text);
    for (const auto& [name, picture] : files.pictures) hasher.addArray(picture.values);
    for (const auto& [name, text] : files.profiles) hasher.addArray(text);
    const std::string stem = hasher.hash().hex();
    files = filesOf(scene, written(), stem, surfaces);
    const fs::path file = folder / (stem + ".lights.json");
    if (!fs::exists(file, error)) write(files, file);
    return file;
}

}  // namespace penumbra::studio::viewer
