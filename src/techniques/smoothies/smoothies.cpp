// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "src/techniques/common/overlapping_casters.h"

namespace penumbra::smoothies {
namespace {

constexpr std::array<std::string_view, 2> buffers = {"edges", "alpha"};
constexpr std::array<std::string_view, 3> falloffs = {"light", "linear", "sinusoidal"};

/// Receivers that cast nothing are mapped at a quarter of the map's size: only widths depend on them.
constexpr int receiverTexel_px = 4;

/// What the map of casters with holes has more along each axis: edges of holes are known by its texels alone.
constexpr int maskedMapScale = 2;
constexpr int largestMap_px = 16384;

/// Blocks light with holes in it.
bool isMasked(const Caster& caster) {
    return caster.casts && caster.alphaMask.texture != 0;
}

}  // namespace

Smoothies::PicturePrograms::PicturePrograms(Device& device, const std::string& file,
                                            std::vector<std::string> defines)
    : withoutNormals(internalsOf(device).shaders, {"src/techniques/smoothies/" + file}, defines) {
    defines.emplace_back("WITH_NORMALS");
    withNormals = gl::Program(internalsOf(device).shaders, {"src/techniques/smoothies/" + file}, defines);
}

Smoothies::Smoothies(Device& device)
    : device_(internalsOf(device)),
      depthMap_(device),
      farthestMap_(device),
      maskedMap_(device),
      receiverMap_(device),
      silhouettes_(device),
      construction_(device),
      buffer_(device),
      lightProfileProgram_(device_.shaders, {"src/techniques/smoothies/light_profile.comp.glsl"}),
      classify_(device, "classify.comp.glsl", {}),
      resolve_(device, "resolve.comp.glsl", {}),
      resolveColored_(device, "resolve.comp.glsl", {"COLORED"}),
      stored_(device, "resolve_stored.comp.glsl", {}),
      storedColored_(device, "resolve_stored.comp.glsl", {"COLORED"}),
      masked_(device, "masked.comp.glsl", {}),
      maskedColored_(device, "masked.comp.glsl", {"COLORED"}),
      constants_(std::size_t(2) * maxSmoothieCameras * sizeof(SmoothieConstants), "smoothie constants") {}

void Smoothies::describe(ParameterVisitor& visitor) {
    visitor.integer({.name = "map_size",
                     .unit = "texels",
                     .help = "width and height of the shadow map; smoothies are drawn at half of it"},
                    settings_.mapSize_px, {16, largestMap_px});
    visitor.boolean({.name = "inner",
                     .help = "smoothies reach into the blocker too, so that the umbra shrinks as the light "
                             "grows; off as in the paper"},
                    settings_.inner);
    visitor.choice(
        {.name = "buffer",
         .help = "what a texel of the smoothie buffer keeps: the edge that it lies deepest under, so "
                 "that pixels work out alpha for themselves; or, as in the paper and without inner "
                 "halves, alpha and depth, which are filtered"},
        settings_.buffer, buffers);
    visitor.real(
        {.name = "t",
         .help = "the paper's t (0.02 to 0.2): width of every smoothie in half windows of a light "
                 "frustum of 90 degrees, or as wide as all that casts for a distant light; 0 derives "
                 "it from the light's size"},
        settings_.t, {0, 1});
    visitor.boolean({.name = "remap",
                     .help = "alpha follows the distances of blocker and receiver (equation 1); off: the "
                             "same width everywhere"},
                    settings_.remap);
    visitor.choice({.name = "falloff",
                    .help = "how visibility grows across a smoothie: as the light's shape asks for, "
                            "linearly, or sinusoidally"},
                   settings_.falloff, falloffs);
}

void Smoothies::drawMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                         const LightCameras& cameras) {
    const auto casting = [&](auto&& which) {
        std::pmr::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end(),
                                         gl::ObjectRegistryScope::frameMemory());
        for (Caster& caster : casters) caster.casts = which(caster);
        return casters;
    };
    hasMaskedMap_ = hasSmoothies_ && std::ranges::any_of(inputs.casters, isMasked);
    {
        const auto pass = timers_.pass("smoothies/depth map");
        depthMap_.render(casting([&](const Caster& caster) {
                             return caster.casts && !(hasMaskedMap_ && isMasked(caster));
                         }),
                         scene, cameras, settings_.mapSize_px);
    }
    // What lies hidden beneath another caster blocks light that comes in past that one.
    std::pmr::vector<Caster> overlapping = overlappingCasters(inputs, scene, cameras);
    for (Caster& caster : overlapping) caster.casts = caster.casts && !isMasked(caster);
    hasFarthestMap_ = hasSmoothies_ && std::ranges::any_of(overlapping, &Caster::casts);
    if (hasFarthestMap_) {
        const auto pass = timers_.pass("smoothies/farthest map");
        farthestMap_.render(overlapping, scene, cameras, settings_.mapSize_px,
                            DepthMap::Surface::farthestFront);
    }
    if (hasMaskedMap_) {
        const auto pass = timers_.pass("smoothies/masked map");
        maskedMap_.render(casting(isMasked), scene, cameras,
                          std::min(maskedMapScale * settings_.mapSize_px, largestMap_px));
        if (!saidMasked_) {
            device_.log.write(LogLevel::info,
                              "smoothies: casters with an alpha mask have no silhouette edges; their shadows "
                              "are filtered from a map of their own");
            saidMasked_ = true;
        }
    }
    // What receives but is not in the depth map is drawn by itself: smoothies need to know how far away it
    // is.
    const std::pmr::vector<Caster> receivers =
        casting([](const Caster& caster) { return caster.receives && (!caster.casts || isMasked(caster)); });
    hasReceiverMap_ = hasSmoothies_ && std::ranges::any_of(receivers, &Caster::casts);
    if (hasReceiverMap_) {
        const auto pass = timers_.pass("smoothies/receiver map");
        receiverMap_.render(receivers, scene, cameras, std::max(1, settings_.mapSize_px / receiverTexel_px));
    }
}

void Smoothies::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const AreaLight& light = inputs.light;
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightCameras cameras =
        fitLightCameras(light, scene, {.mapSize_px = settings_.mapSize_px, .splits = true});
    hasSmoothies_ = (hasSize(light) || settings_.t > 0) && !cameras.empty();
    drawMaps(inputs, scene, cameras);

    std::array<SmoothieConstants, maxSmoothieCameras> constants{};
    for (std::size_t i = 0; i < cameras.size(); ++i)
        constants[i] = smoothieConstants(settings_, inputs, cameras[i], scene);
    constants_.write(std::as_bytes(std::span(constants)));
    if (hasSmoothies_) drawSmoothies(inputs, scene);
    view_.fill(inputs.view, lightFromWorldMatrix);
    if (hasSmoothies_ && keeps() == SmoothieBuffer::Keeps::alpha) {
        resolveStored(inputs, out);
    } else {
        resolve(inputs, out);
    }
    if (hasMaskedMap_) resolveMasked(inputs, scene, cameras, out);
}

void Smoothies::drawSmoothies(const ShadowInputs& inputs, const LightSpaceScene& scene) {
    const bool isDistant = inputs.light.shape == LightShape::distant;
    const SurfaceMaps surfaces{
        .casters = depthMap_, .receivers = receiverMap_, .hasReceivers = hasReceiverMap_};
    {
        const auto pass = timers_.pass("smoothies/silhouettes");
        std::pmr::vector<SilhouetteSource> sources{gl::ObjectRegistryScope::frameMemory()};
        for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
            const Caster& caster = inputs.casters[i];
            if (caster.casts && !isMasked(caster)) sources.push_back({caster.mesh, scene.lightFromMesh[i]});
        }
        silhouettes_.extract(sources, isDistant ? LightPoint(0, 0, 1, 0) : LightPoint(0, 0, 0, 1), {});
    }
    {
        const auto pass = timers_.pass("smoothies/construction");
        construction_.build(silhouettes_, surfaces, constants_, isDistant);
    }
    {
        const auto pass = timers_.pass("smoothies/smoothies");
        buffer_.draw(keeps(), silhouettes_, construction_.edges(), surfaces, constants_);
    }
    if (inputs.light.radianceTexture != 0) profileLight(inputs.light.radianceTexture);
}

PictureConstants Smoothies::pictureConstants(const ShadowInputs& inputs) const {
    return {.light = lightConstants(inputs.light),
            .mapCount = depthMap_.count(),
            .hasSmoothies = hasSmoothies_,
            .capacity = glm::uint(silhouettes_.edgeCount()),
            .hasFarthestMaps = hasFarthestMap_};
}

void Smoothies::resolve(const ShadowInputs& inputs, const VisibilityBuffer& out) {
    const auto tilesOf = [](int size_px) { return std::size_t((size_px + tileSize_px - 1) / tileSize_px); };
    // The list's head is an indirect dispatch's, and the number of tiles.
    constexpr std::array<std::uint32_t, 4> noTiles = {0, 0, 1, 0};
    tiles_.reserve(
        sizeof(std::uint32_t) * (noTiles.size() + 2 * tilesOf(out.width_px()) * tilesOf(out.height_px())),
        "smoothies/tiles");
    tiles_.clear();
    tiles_.write(std::as_bytes(std::span(noTiles)));
    {
        const auto pass = timers_.pass("smoothies/classify");
        gl::Pass(classify_.of(inputs.view))
            .constants(pictureConstants(inputs))
            .bind(view_)
            .bind(depthMap_)
            .bind("SmoothieBlock", constants_, 0, maxSmoothieCameras * sizeof(SmoothieConstants))
            .bind("deepestEdges", buffer_.deepestEdges())
            .bind("Tiles", tiles_)
            .bind("visibility", imageOf(out))
            .dispatchPixels(out.width_px(), out.height_px());
    }
    if (!hasSmoothies_) return;
    const auto pass = timers_.pass("smoothies/resolve");
    gl::Pass resolving((out.colored() ? resolveColored_ : resolve_).of(inputs.view));
    resolving.constants(pictureConstants(inputs))
        .bind(view_)
        .bind(depthMap_)
        .bind("SmoothieBlock", constants_, 0, maxSmoothieCameras * sizeof(SmoothieConstants))
        .bind("deepestEdges", buffer_.deepestEdges())
        .bind("SmoothieEdges", construction_.edges())
        .bind("farthestMaps", hasFarthestMap_ ? farthestMap_.texture().ref() : gl::TextureRef{})
        .bind("Tiles", tiles_)
        .bind("visibility", imageOf(out));
    if (out.colored()) resolving.bind("lightProfile", lightProfile_);
    resolving.dispatchIndirect(tiles_);
}

void Smoothies::resolveStored(const ShadowInputs& inputs, const VisibilityBuffer& out) {
    const auto pass = timers_.pass("smoothies/resolve");
    gl::Pass resolving((out.colored() ? storedColored_ : stored_).of(inputs.view));
    resolving.constants(pictureConstants(inputs))
        .bind(view_)
        .bind(depthMap_)
        .bind("SmoothieBlock", constants_, 0, maxSmoothieCameras * sizeof(SmoothieConstants))
        .bind("deepestEdges", buffer_.deepestEdges())
        .bind("storedAlpha", buffer_.storedAlpha())
        .bind("visibility", imageOf(out));
    if (out.colored()) resolving.bind("lightProfile", lightProfile_);
    resolving.dispatchPixels(out.width_px(), out.height_px());
}

void Smoothies::resolveMasked(const ShadowInputs& inputs, const LightSpaceScene& scene,
                              const LightCameras& cameras, const VisibilityBuffer& out) {
    // The search for blockers is as wide as the nearest of them could make a penumbra.
    PictureConstants picture = pictureConstants(inputs);
    picture.nearestNearness = -std::numeric_limits<float>::infinity();
    for (const LightCamera& camera : cameras) {
        const float nearest = smoothieConstants(settings_, inputs, camera, scene).nearestDrawn;
        for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
            if (!isMasked(inputs.casters[i]) || std::isnan(scene.boxes[i][0].x)) continue;
            for (const glm::dvec3& corner : scene.boxes[i]) {
                const double z = (camera.faceFromLight * glm::dvec4(corner, 1)).z;
                const double nearness = camera.orthographic ? -z : z > 0 ? 1 / z : nearest;
                picture.nearestNearness =
                    std::max(picture.nearestNearness, std::min(float(nearness), nearest));
            }
        }
    }
    const auto pass = timers_.pass("smoothies/masked");
    gl::Pass((out.colored() ? maskedColored_ : masked_).of(inputs.view))
        .constants(picture)
        .bind(view_)
        .bind(maskedMap_)
        .bind("SmoothieBlock", constants_, 0, maxSmoothieCameras * sizeof(SmoothieConstants))
        .bind("deepestEdges", buffer_.deepestEdges())
        .bind("visibility", imageOf(out))
        .dispatchPixels(out.width_px(), out.height_px());
}

void Smoothies::profileLight(std::uint32_t radianceTexture) {
    const auto pass = timers_.pass("smoothies/light profile");
    lightProfile_.fit({.width_px = profileDirections + 1,
                       .height_px = profileOffsets,
                       .format = gl::Format::rgba32f,
                       .filter = gl::Filter::linear,
                       .label = "smoothies/light profile"});
    gl::Pass(lightProfileProgram_)
        .bind("radiance", gl::TextureRef{.name = radianceTexture})
        .bind("profile", lightProfile_)
        .dispatch(profileDirections + 1);
}

void Smoothies::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth map", .texture = depthMap_.texture().name(), .layers = depthMap_.count()});
    if (!hasSmoothies_) return;
    buffer_.inspect(visitor);
}

Statistics Smoothies::statistics() const {
    Statistics statistics;
    statistics.counts.push_back({"maps", double(depthMap_.count())});
    if (hasSmoothies_) {
        statistics.counts.push_back({"edges", double(silhouettes_.edgeCount())});
        statistics.counts.push_back({"silhouette edges", double(silhouettes_.countFound())});
    }
    statistics.passes = passTimes(timers_);
    return statistics;
}

}  // namespace penumbra::smoothies
