// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "src/device/device_internals.h"
#include "src/gl/buffer.h"
#include "src/gl/framebuffer.h"
#include "src/gl/pass.h"
#include "src/gl/texture.h"
#include "src/techniques/common/depth_map_io.h"
#include "src/techniques/common/light_camera.h"

namespace penumbra {

/// The nearest caster as light cameras see it: one layer a camera, reversed 32-bit float depth (Williams
/// 1978). Shaders read it through depth_map.glsl.
class DepthMap {
  public:
    /// Which surface a texel sees.
    enum class Surface {
        nearest,        ///< no caster: depth 0
        farthestFront,  ///< the farthest among those that face the camera; no caster: depth 1
        farthest,       ///< the farthest of all: a back face, where meshes are closed; no caster: depth 1
    };

    explicit DepthMap(Device& device);

    /// Draws every caster that casts into one layer for each camera, leaving out those a camera cannot see.
    /// Throws Error::Kind::badArgument where the device has no room for so many or so large maps.
    void render(std::span<const Caster> casters, const LightSpaceScene& scene,
                std::span<const LightCamera> cameras, int mapSize_px, Surface surface = Surface::nearest);

    /// Gives a pass the maps and their cameras (depth_map.glsl).
    void bindTo(gl::Pass& pass) const;

    const gl::Texture& texture() const { return maps_; }
    int count() const { return count_; }

  private:
    void allocate(int mapSize_px, int layers);
    /// Of a caster, in `instances_`.
    struct Instances {
        std::size_t first, count;
    };
    template <typename InstancesOf>
    void draw(std::span<const Caster> casters, const LightSpaceScene& scene, Surface surface,
              InstancesOf instancesOf) const;

    Device::Internals& device_;
    gl::Program opaque_, masked_;
    gl::Texture maps_;
    gl::Framebuffer framebuffer_;
    gl::StorageArray<LightCameraConstants> cameras_;
    gl::StorageArray<CasterConstants> casters_;
    gl::StorageArray<glm::ivec2> instances_;  ///< layer and caster
    int count_ = 0;
};

}  // namespace penumbra
