// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/edited_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "studio/reference/content_hash.h"
#include "studio/scene/gltf/lights.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio::viewer {

/// A light as it is, by now.
struct EditedLight {
    WrittenLight written;
    Light light;  ///< what reading that gives, at the moment of the edit; unused for the scene's own
    glm::dmat4 parentFromLight{1};
    bool isScenes() const { return !written.now; }
};

struct EditedLights::State {
    std::vector<EditedLight> lights;
};

namespace {

namespace fs = std::filesystem;

bool same(const std::optional<ProfiledEmission>& a, const std::optional<ProfiledEmission>& b) {
    if (!a || !b) return !a && !b;
    return a->profile == b->profile && a->isLuminaire == b->isLuminaire && a->turn_rad == b->turn_rad &&
           a->angleScale == b->angleScale && a->factor == b->factor;
}

bool same(const std::optional<SunOrigin>& a, const std::optional<SunOrigin>& b) {
    if (!a || !b) return !a && !b;
    return a->latitude_deg == b->latitude_deg && a->longitude_deg == b->longitude_deg && a->time == b->time &&
           a->setting == b->setting && a->multiplier == b->multiplier;
}

/// Whether nobody has changed anything.
bool same(const Light& a, const Light& b) {
    return a.name == b.name && a.shape.shape == b.shape.shape &&
           a.shape.worldFromLight == b.shape.worldFromLight && a.shape.width_m == b.shape.width_m &&
           a.shape.height_m == b.shape.height_m && a.shape.length_m == b.shape.length_m &&
           a.shape.radius_m == b.shape.radius_m && a.shape.angle_rad == b.shape.angle_rad &&
           a.shape.twoSided == b.shape.twoSided && a.emission.unit == b.emission.unit &&
           a.emission.value == b.emission.value && a.texture == b.texture && a.castsShadow == b.castsShadow &&
           a.cone_rad == b.cone_rad && same(a.profile, b.profile) && same(a.sun, b.sun);
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

/// The node that a light of the scene rides on, where all of its motion is that node's. Names that several
/// nodes have are no answer.
std::string nodeOf(const Scene& scene, std::size_t own) {
    if (scene.duration_s() <= 0) return "";
    std::vector<SceneMoment> moments;
    for (const double share : {0.0, 0.23, 0.51, 0.87})
        moments.push_back(scene.at(share * scene.duration_s()));
    const auto worldFromLight = [&](const SceneMoment& moment) {
        return glm::dmat4(glm::mat4(worldFromLightOf(moment.lights.at(own))));
    };
    const auto isNear = [](const glm::dmat4& a, const glm::dmat4& b) {
        constexpr double tolerance = 1e-4;
        for (int column = 0; column < 4; ++column) {
            if (glm::distance(a[column], b[column]) > tolerance * (1 + glm::length(a[column]))) return false;
        }
        return true;
    };
    const glm::dmat4 first = worldFromLight(moments.front());
    if (std::ranges::all_of(moments, [&](const SceneMoment& m) { return isNear(worldFromLight(m), first); }))
        return "";
    for (std::size_t node = 0; node < scene.nodeNames.size(); ++node) {
        const std::string& name = scene.nodeNames[node];
        if (name.empty() || std::ranges::count(scene.nodeNames, name) != 1) continue;
        const auto nodeFromLight = [&](const SceneMoment& moment) {
            return glm::inverse(glm::dmat4(moment.worldFromNode[node])) * worldFromLight(moment);
        };
        const glm::dmat4 held = nodeFromLight(moments.front());
        if (std::ranges::all_of(moments,
                                [&](const SceneMoment& m) { return isNear(nodeFromLight(m), held); }))
            return name;
    }
    return "";
}

glm::mat4 placed(const glm::dmat4& worldFromParent, const glm::dmat4& parentFromLight) {
    return gltf::rigidPart(glm::mat4(worldFromParent * parentFromLight));
}

/// As the scene hangs it, at that moment; in the world where no rotation and translation say so (a node that
/// is sheared).
SidecarLight hung(const Light& light, const SidecarLight& parent, const Scene& scene,
                  const SceneMoment& moment) {
    SidecarLight result = stated(light);
    if (parent.node.empty() || light.sun) return result;
    SidecarLight hanging = result;
    hanging.node = parent.node;
    hanging.isBelow = parent.isBelow;
    const glm::dmat4 worldFromParent = studio::worldFromParent(hanging, scene, moment);
    const glm::dmat4 worldFromLight = result.parentFromLight;
    hanging.parentFromLight = glm::inverse(worldFromParent) * worldFromLight;
    const glm::mat4 rigid = gltf::rigidPart(glm::mat4(hanging.parentFromLight));
    for (int axis = 0; axis < 3; ++axis) hanging.parentFromLight[axis] = rigid[axis];
    const glm::mat4 back = placed(worldFromParent, hanging.parentFromLight);
    constexpr float tolerance = 1e-4f;
    for (int column = 0; column < 4; ++column) {
        const glm::vec4 wanted(worldFromLight[column]);
        if (glm::distance(back[column], wanted) > tolerance * (1 + glm::length(wanted))) return result;
    }
    return hanging;
}

glm::dmat4 worldFromParentOf(const SidecarLight& light, const Scene& scene, const SceneMoment& moment) {
    return light.node.empty() ? glm::dmat4(1) : worldFromParent(light, scene, moment);
}

/// Angles and rotations change in the last bit on their way through a file: where hands have not, they stay
/// as they were given to be written. `light` was `shown` before.
void keepUntouched(SidecarLight& now, const SidecarLight& before, const Light& light, const Light& shown) {
    if (light.shape.worldFromLight == shown.shape.worldFromLight) {
        now.parentFromLight = before.parentFromLight;
        now.node = before.node;
        now.isBelow = before.isBelow;
    }
    if (light.cone_rad == shown.cone_rad) now.light.cone_rad = before.light.cone_rad;
    if (light.shape.angle_rad == shown.shape.angle_rad)
        now.light.shape.angle_rad = before.light.shape.angle_rad;
    if (now.profile && before.profile && light.profile->turn_rad == shown.profile->turn_rad)
        now.profile->turn_deg = before.profile->turn_deg;
}

/// What a file of this light says, read back.
void readBack(EditedLight& light, const Scene& scene, const SceneMoment& moment) {
    const SidecarLight& now = *light.written.now;
    const Sidecar sidecar{.fileName = "edited lights", .lights = std::vector{now}};
    const SidecarLight read = parseSidecar(formatSidecar(sidecar), sidecar.fileName).lights->at(0);
    light.light = read.light;
    light.light.texture = now.light.texture;
    light.light.profile = now.light.profile;
    if (now.profile && now.profile->isLuminaire) light.light.shape = now.light.shape;
    light.parentFromLight = read.parentFromLight;
    place(light.light, placed(worldFromParentOf(now, scene, moment), light.parentFromLight));
}

}  // namespace

EditedLights::EditedLights(const Scene& scene, const fs::path& sidecar) : scene_(scene), file_(sidecar) {}

std::vector<Light> EditedLights::at(const SceneMoment& moment, const std::vector<Light>& own) const {
    if (!state_) return own;
    std::vector<Light> lights;
    for (const EditedLight& edited : state_->lights) {
        if (edited.isScenes()) {
            lights.push_back(own.at(*edited.written.own));
            continue;
        }
        Light& light = lights.emplace_back(edited.light);
        const SidecarLight& now = *edited.written.now;
        if (!now.node.empty())
            place(light, placed(worldFromParent(now, scene_, moment), edited.parentFromLight));
    }
    return lights;
}

void EditedLights::edit(std::vector<Light> lights, const SceneMoment& moment, const std::vector<Light>& own) {
    std::vector<EditedLight> before;
    if (state_) before = state_->lights;
    for (std::size_t i = 0; !state_ && i < own.size(); ++i)
        before.push_back({.written = {.own = i, .was = {}, .now = {}}, .light = {}});
    const std::vector<Light>& shown = moment.lights;
    std::vector<std::optional<std::size_t>> from(lights.size());
    const auto find = [&](std::size_t i, const auto& matches) {
        if (i < shown.size() && matches(shown[i])) return std::optional(i);
        const auto found = std::ranges::find_if(shown, matches);
        return found == shown.end() ? std::nullopt : std::optional(std::size_t(found - shown.begin()));
    };
    for (std::size_t i = 0; i < lights.size(); ++i) {
        from[i] = find(i, [&](const Light& light) { return same(light, lights[i]); });
        if (!from[i] && lights.size() == shown.size()) from[i] = i;
        if (!from[i]) from[i] = find(i, [&](const Light& light) { return light.name == lights[i].name; });
    }
    makeNamesUnique(lights);

    auto state = std::make_shared<State>();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const EditedLight* const ancestor = from[i] ? &before.at(*from[i]) : nullptr;
        // The scene's own stay so where the file has them, or where nothing has them but the scene.
        const std::optional<std::size_t> ofScene = ancestor != nullptr ? ancestor->written.own : std::nullopt;
        const bool isInFile = ofScene && *ofScene < file_.lights().size();
        const bool isSame = ancestor != nullptr && same(shown[*from[i]], lights[i]);
        if (isSame && (isInFile || !ancestor->isScenes())) {
            state->lights.push_back(*ancestor);
            continue;
        }
        EditedLight& edited = state->lights.emplace_back();
        edited.written.own = ofScene;
        SidecarLight parent;
        if (isInFile) {
            parent = file_.lights()[*ofScene];
        } else if (ofScene) {
            parent.node = ancestor->isScenes() ? nodeOf(scene_, *ofScene) : ancestor->written.now->node;
        }
        edited.written.now = hung(lights[i], parent, scene_, moment);
        if (ancestor != nullptr && !ancestor->isScenes()) {
            edited.written.was = ancestor->written.was;
            keepUntouched(*edited.written.now, *ancestor->written.now, lights[i], shown[*from[i]]);
        } else if (isInFile) {
            parent.node = edited.written.now->node;
            edited.written.was = hung(own.at(*ofScene), parent, scene_, moment);
        }
        readBack(edited, scene_, moment);
    }
    state_ = std::move(state);
}

std::vector<WrittenLight> EditedLights::written() const {
    std::vector<WrittenLight> lights;
    if (state_) {
        for (const EditedLight& light : state_->lights) lights.push_back(light.written);
    }
    return lights;
}

void EditedLights::save(const fs::path& file) {
    write(file_.with(scene_, written(), file.stem().stem().string(), file_.liesIn(file.parent_path())), file);
    saved_ = state_;
}

fs::path EditedLights::snapshot(const fs::path& folder) const {
    const LightFile::Written files = file_.with(scene_, written(), "lights", false);
    ContentHasher hasher;
    hasher.addArray(files.text);
    for (const auto& [name, picture] : files.pictures) hasher.addArray(picture.values);
    for (const auto& [name, content] : files.files) hasher.addArray(content);
    const fs::path file = folder / hasher.hash().hex() / "scene.lights.json";
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (!fs::exists(file, error)) write(files, file);
    return file;
}

}  // namespace penumbra::studio::viewer
