// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/caster_checks.h"

#include <algorithm>
#include <cmath>

#include "src/device/input_checks.h"
#include "src/geometry/mesh_internals.h"

namespace penumbra {
namespace {

/// A mesh is not what it was meant to be where rounding to floats moves its corners by more than this share
/// of its size.
constexpr double largestRounding = 1.0 / 16;

bool floatsHold(const Box& box) {
    double farthest = 0, size = 0;
    for (const auto& [low, high] :
         {std::pair<double, double>{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}}) {
        farthest = std::max({farthest, std::abs(low), std::abs(high)});
        size = std::max(size, high - low);
    }
    // One that has no size at all, a point, is as good as it was.
    return size <= 0 || farthest * std::exp2(-24) <= largestRounding * size;
}

}  // namespace

void checkCasters(std::span<const Caster> casters, const Device::Internals& device) {
    std::uint32_t checkedTexture = 0;
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const Caster& caster = casters[i];
        const Argument argument("ShadowInputs: casters", i, ".mesh");
        if (caster.mesh == nullptr) refuse(argument, "is null: give it a mesh, or leave the caster out");
        const Mesh::Internals* const mesh = Mesh::Internals::ifAny(*caster.mesh);
        if (mesh == nullptr) refuse(argument, "was moved from: point to the mesh that it was moved to");
        if (mesh->device->isDeviceGone || mesh->device->registry->contextLost)
            refuse(argument, "is of a device that is destroyed or abandoned: make it anew");
        if (mesh->device->shareGroup != device.shareGroup) {
            refuse(argument,
                   "is of another device: make it on the technique's, or the device with "
                   "DeviceOptions::shared");
        }
        if (!floatsHold(mesh->bounds)) {
            refuse(argument,
                   "lies so far from its origin that floats cannot hold its positions: give positions about "
                   "its own middle, and the way there in worldFromMesh");
        }
        requireAffine(caster.worldFromMesh, {"ShadowInputs: casters", i, ".worldFromMesh"});
        for (const float share : {caster.transmittance.x, caster.transmittance.y, caster.transmittance.z}) {
            if (!(share >= 0 && share <= 1))  // nor a NaN
                refuse({"ShadowInputs: casters", i, ".transmittance"},
                       "is not from 0 to 1 in each channel: it is the share of the light that passes");
        }
        const AlphaMask& mask = caster.alphaMask;
        if (!std::isfinite(mask.factor) || !std::isfinite(mask.cutoff))
            refuse({"ShadowInputs: casters", i, ".alphaMask"}, "has a factor or cutoff that is not finite");
        if (mask.texture == 0 || mask.texture == checkedTexture) continue;
        requireColorTexture(mask.texture, {"ShadowInputs: casters", i, ".alphaMask.texture"});
        checkedTexture = mask.texture;
    }
}

}  // namespace penumbra
