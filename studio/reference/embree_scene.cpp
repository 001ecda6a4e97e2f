// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

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

/// A caster's triangles as Embree has them, and its holes. Embree keeps pointers into it.
struct OcclusionScene::Surface {
    std::vector<glm::vec3> positions;  // world space, and one more at the end: Embree reads 16 bytes of each
    std::vector<std::uint32_t> indices;
    std::optional<AlphaTexture> holes;
    std::vector<glm::vec2> uvs;
    glm::vec3 transmittance;
    std::size_t place;  // among those that are traced

    Surface(const TracedCaster& caster, std::size_t given)
        : indices(caster.indices.begin(), caster.indices.end()),
          transmittance(caster.transmittance),
          place(given) {
        const glm::dmat4 worldFromMesh(caster.worldFromMesh);
        positions.reserve(caster.positions.size() + 1);
        for (const glm::vec3& position : caster.positions)
            positions.emplace_back(worldFromMesh * glm::dvec4(position, 1));
        positions.emplace_back(0);
        if (!caster.alphaMask) return;
        holes.emplace(*caster.alphaMask);
        uvs.assign(caster.uvs.begin(), caster.uvs.end());
    }

    TracedTriangle triangle(unsigned number) const {
        const std::uint32_t* corners = &indices[3 * std::size_t(number)];
        return {positions[corners[0]], positions[corners[1]], positions[corners[2]]};
    }

    bool isPane() const { return transmittance != glm::vec3(0); }

    bool isSolidAt(unsigned number, float u, float v) const {
        if (!holes) return true;
        if (uvs.empty()) return holes->blocks({0, 0});
        const std::uint32_t* corners = &indices[3 * std::size_t(number)];
        return holes->blocks((1 - u - v) * uvs[corners[0]] + u * uvs[corners[1]] + v * uvs[corners[2]]);
    }

    /// Called by Embree where something seems to block rays.
    static void filter(const RTCFilterFunctionNArguments* hits) {
        const auto& surface = *static_cast<const Surface*>(hits->geometryUserPtr);
        auto& fan = *reinterpret_cast<FanContext*>(hits->context);
        const unsigned count = hits->N;
        for (unsigned i = 0; i < count; ++i) {
            if (hits->valid[i] == 0) continue;
            RTCRayN* const rays = hits->ray;
            const glm::dvec3 origin(RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i),
                                    RTCRayN_org_z(rays, count, i));
            const glm::dvec3 direction(RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
                                       RTCRayN_dir_z(rays, count, i));
            const unsigned number = RTCHitN_primID(hits->hit, count, i);
            const unsigned ray = RTCRayN_id(rays, count, i);
            const double end = fan.ends[ray];
            const TracedTriangle triangle = surface.triangle(number);
            const bool blocks =
                triangle.isCrossedWithin(origin, direction, end) &&
                !(fan.lightPlane && fan.lightPlane->contains(triangle)) &&
                surface.isSolidAt(number, RTCHitN_u(hits->hit, count, i), RTCHitN_v(hits->hit, count, i));
            if (blocks && surface.isPane()) fan.crossed[ray].push_back(&surface);
            if (!blocks || surface.isPane()) hits->valid[i] = 0;
        }
    }

    /// What a filter is told of the fan that is traced: Embree hands it on.
    struct FanContext {
        RayContext embree;             // first: Embree's pointer to it is one to this
        const float* ends;             // of the rays, by their ids
        const LightPlane* lightPlane;  // or null
        /// The panes that rays pass, by their ids, in any order and some of them several times.
        std::array<std::vector<const Surface*>, packetSize> crossed;

        glm::vec3 passing(unsigned ray) {
            std::vector<const Surface*>& panes = crossed[ray];
            // In the order in which they were given, so that products round alike wherever they lie.
            std::ranges::sort(panes, {}, &Surface::place);
            glm::vec3 share(1);
            const Surface* last = nullptr;
            for (const Surface* pane : panes) {
                if (pane != std::exchange(last, pane)) share *= pane->transmittance;
            }
            panes.clear();
            return share;
        }
    };
};

/// Surfaces with a tree over them; the number of a geometry is the surface's.
struct OcclusionScene::Surfaces {
    std::vector<std::unique_ptr<Surface>> surfaces;
    EmbreeScene scene;

    void make(RTCDevice device) {
        scene.reset(rtcNewScene(device));
        // Robust: rays between two triangles that share an edge hit one of them.
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
        for (const std::unique_ptr<Surface>& surface : surfaces) attach(device, *surface);
        rtcCommitScene(scene.get());
    }

    void attach(RTCDevice device, Surface& surface) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   surface.positions.data(), 0, sizeof(glm::vec3),
                                   surface.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   surface.indices.data(), 0, 3 * sizeof(std::uint32_t),
                                   surface.indices.size() / 3);
        rtcSetGeometryUserData(geometry, &surface);
        rtcSetGeometryOccludedFilterFunction(geometry, Surface::filter);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }

    /// Narrows `nearest` to what is nearer here.
    void find(NearestPlane& nearest) const {
        struct Search {
            const Surfaces& surfaces;
            NearestPlane& nearest;
        } search{*this, nearest};
        const auto look = [](RTCPointQueryFunctionArguments* found) {
            auto& [here, best] = *static_cast<Search*>(found->userPtr);
            if (!best.take(here.surfaces[found->geomID]->triangle(found->primID))) return false;
            found->query->radius = float(best.distance());
            return true;
        };
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        const glm::vec3 place(nearest.place());
        RTCPointQuery query{};
        query.x = place.x, query.y = place.y, query.z = place.z;
        query.radius = float(nearest.distance());
        rtcPointQuery(scene.get(), &query, &context, look, &search);
    }
};

struct OcclusionScene::State {
    Device device{rtcNewDevice(nullptr)};
    Surfaces blocking, other;

    void check() const {
        if (device && rtcGetDeviceError(device.get()) == RTC_ERROR_NONE) return;
        throw InputError(
            "the scene's triangles cannot be made ready for ray tracing; it may need more memory than there "
            "is");
    }
};

OcclusionScene::OcclusionScene(std::span<const TracedCaster> casters) : state_(std::make_unique<State>()) {
    state_->check();
    for (const TracedCaster& caster : casters) {
        if (caster.indices.empty()) continue;
        Surfaces& group = caster.blocks ? state_->blocking : state_->other;
        group.surfaces.push_back(std::make_unique<Surface>(caster, group.surfaces.size()));
    }
    for (Surfaces* group : {&state_->blocking, &state_->other}) group->make(state_->device.get());
    state_->check();
}

OcclusionScene::~OcclusionScene() = default;

glm::dvec3 OcclusionScene::onSurface(const glm::dvec3& posWorld, const glm::dvec3& normalWorld,
                                     double reach_m) const {
    NearestPlane nearest(posWorld, normalWorld, reach_m);
    state_->blocking.find(nearest);
    state_->other.find(nearest);
    return nearest.point();
}

bool OcclusionScene::hasPanes() const {
    return std::ranges::any_of(state_->blocking.surfaces,
                               [](const auto& surface) { return surface->isPane(); });
}

void OcclusionScene::trace(const glm::vec3& origin, const RayFan& rays, std::span<glm::vec3> passing) const {
    Surface::FanContext context{};
    context.lightPlane = rays.lightPlane ? &*rays.lightPlane : nullptr;
    RTCRay16 packet{};
    std::ranges::fill(packet.org_x, origin.x);
    std::ranges::fill(packet.org_y, origin.y);
    std::ranges::fill(packet.org_z, origin.z);
    std::ranges::fill(packet.mask, ~0u);
    std::iota(std::begin(packet.id), std::end(packet.id), 0u);
    alignas(64) int active[packetSize];

    for (std::size_t first = 0; first < rays.size(); first += packetSize) {
        const std::size_t count = std::min<std::size_t>(packetSize, rays.size() - first);
        context.ends = &rays.end[first];
        std::copy_n(&rays.directionX[first], count, packet.dir_x);
        std::copy_n(&rays.directionY[first], count, packet.dir_y);
        std::copy_n(&rays.directionZ[first], count, packet.dir_z);
        std::copy_n(&rays.end[first], count, packet.tfar);
        for (std::size_t i = 0; i < packetSize; ++i) active[i] = i < count ? -1 : 0;
        occludeCoherent(active, state_->blocking.scene.get(), context.embree, packet);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 share = context.passing(unsigned(i));
            const bool isBlocked = packet.tfar[i] == -std::numeric_limits<float>::infinity();
            passing[first + i] = isBlocked ? glm::vec3(0) : share;
        }
    }
}

}  // namespace penumbra::studio
