// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "studio/errors.h"
#include "studio/reference/embree.h"
#include "studio/reference/occlusion_scene.h"

namespace penumbra::studio {
namespace {

constexpr unsigned packetSize = 16;

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

}  // namespace

void RayFan::resize(std::size_t count) {
    for (std::vector<float>* component : {&directionX, &directionY, &directionZ, &end})
        component->resize(count);
}

/// What the filter needs to know at a hit.
struct OcclusionScene::Mask {
    AlphaTexture texture;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;

    bool blocksAt(unsigned triangle, float u, float v) const {
        if (uvs.empty()) return texture.blocks({0, 0});
        const std::uint32_t* corners = &indices[3 * std::size_t(triangle)];
        return texture.blocks((1 - u - v) * uvs[corners[0]] + u * uvs[corners[1]] + v * uvs[corners[2]]);
    }

    /// Called by Embree for hits of masked casters: lets the rays through holes go on.
    static void filter(const RTCFilterFunctionNArguments* hits) {
        const auto& mask = *static_cast<const Mask*>(hits->geometryUserPtr);
        for (unsigned i = 0; i < hits->N; ++i) {
            if (hits->valid[i] == 0) continue;
            const unsigned triangle = RTCHitN_primID(hits->hit, hits->N, i);
            const float u = RTCHitN_u(hits->hit, hits->N, i), v = RTCHitN_v(hits->hit, hits->N, i);
            if (!mask.blocksAt(triangle, u, v)) hits->valid[i] = 0;
        }
    }
};

struct OcclusionScene::State {
    Device device{rtcNewDevice(nullptr)};
    EmbreeScene scene;
    std::vector<std::unique_ptr<Mask>> masks;  // pointed to by the scene's geometries

    void attach(const TracedCaster& caster) {
        RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t triangles = caster.indices.size() / 3;
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                     RTC_FORMAT_FLOAT3, sizeof(float) * 3,
                                                                     caster.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(std::uint32_t) * 3, triangles));
        if (vertices && indices) {
            const glm::dmat4 worldFromMesh(caster.worldFromMesh);
            for (const glm::vec3& position : caster.positions) {
                const glm::dvec3 posWorld(worldFromMesh * glm::dvec4(position, 1));
                for (int axis = 0; axis < 3; ++axis) *vertices++ = float(posWorld[axis]);
            }
            std::ranges::copy(caster.indices, indices);
            if (caster.alphaMask) {
                masks.push_back(std::make_unique<Mask>(Mask{AlphaTexture(*caster.alphaMask),
                                                            {caster.uvs.begin(), caster.uvs.end()},
                                                            {caster.indices.begin(), caster.indices.end()}}));
                rtcSetGeometryUserData(geometry, masks.back().get());
                rtcSetGeometryOccludedFilterFunction(geometry, Mask::filter);
            }
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene.get(), geometry);
        }
        rtcReleaseGeometry(geometry);
    }

    void check() const {
        if (device && rtcGetDeviceError(device.get()) == RTC_ERROR_NONE) return;
        throw InputError(
            "the scene's triangles cannot be made ready for ray tracing; it may need more memory than there "
            "is");
    }
};

OcclusionScene::OcclusionScene(std::span<const TracedCaster> casters) : state_(std::make_unique<State>()) {
    state_->check();
    state_->scene.reset(rtcNewScene(state_->device.get()));
    // Robust: rays between two triangles that share an edge hit one of them.
    rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(state_->scene.get(), RTC_BUILD_QUALITY_HIGH);
    for (const TracedCaster& caster : casters) {
        if (!caster.indices.empty()) state_->attach(caster);
    }
    rtcCommitScene(state_->scene.get());
    state_->check();
}

OcclusionScene::~OcclusionScene() = default;

void OcclusionScene::trace(const glm::vec3& origin, const RayFan& rays,
                           std::span<std::uint8_t> blocked) const {
    RTCRay16 packet{};
    std::ranges::fill(packet.org_x, origin.x);
    std::ranges::fill(packet.org_y, origin.y);
    std::ranges::fill(packet.org_z, origin.z);
    std::ranges::fill(packet.mask, ~0u);
    alignas(64) int active[packetSize];

    for (std::size_t first = 0; first < rays.size(); first += packetSize) {
        const std::size_t count = std::min<std::size_t>(packetSize, rays.size() - first);
        std::copy_n(&rays.directionX[first], count, packet.dir_x);
        std::copy_n(&rays.directionY[first], count, packet.dir_y);
        std::copy_n(&rays.directionZ[first], count, packet.dir_z);
        std::copy_n(&rays.end[first], count, packet.tfar);
        for (std::size_t i = 0; i < packetSize; ++i) active[i] = i < count ? -1 : 0;
        occludeCoherent(active, state_->scene.get(), packet);
        for (std::size_t i = 0; i < count; ++i) {
            blocked[first + i] = packet.tfar[i] == -std::numeric_limits<float>::infinity();
        }
    }
}

}  // namespace penumbra::studio
