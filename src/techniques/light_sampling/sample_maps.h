// SPDX-License-Identifier: Apache-2.0
// Depth maps of many samples: which ones, the device may decide. A stage of the plan is drawn in batches that
// fit the memory; in each, one indirect draw a caster reaches all maps of the batch that see it.
#pragma once

#include <functional>
#include <span>

#include "src/device/device_internals.h"
#include "src/gl/buffer.h"
#include "src/gl/framebuffer.h"
#include "src/gl/pass.h"
#include "src/gl/texture.h"
#include "src/techniques/common/depth_map_io.h"
#include "src/techniques/light_sampling/sample_cameras.h"
#include "src/techniques/light_sampling/sampling_io.h"

namespace penumbra::light_sampling {

class SampleMaps {
  public:
    explicit SampleMaps(Device& device);

    static constexpr double texel_bytes = 4;

    /// What to make room for.
    struct Room {
        int samples = 1;           ///< with maps, at most
        int compared = 1;          ///< of them, which are to stay while others come and go
        double memory_bytes = 0;   ///< that maps may take
        bool staysWithin = false;  ///< the caller takes no more samples than fit: see capacity()
    };

    /// Takes this frame's samples, their cameras and the casters. Makes room for all maps at once if the
    /// memory allows, else for as many as it does. Throws Error::Kind::badArgument for maps that are larger
    /// than the device allows.
    void prepare(std::span<const Caster> casters, const LightSpaceScene& scene,
                 std::span<const LightSample> samples, const SampleCameras& cameras, int mapSize_px,
                 const Room& room);

    /// The plan from the CPU: slots hold these samples, in their order; stage 0 are those from `first` on.
    void plan(std::span<const int> sampleOfSlot, int first);
    /// One stage of all samples, a slot each.
    void planAll() { plan(identity_, 0); }
    /// The same samples as those that were prepared, with other weights.
    void setSamples(std::span<const LightSample> samples) { samples_.write(std::as_bytes(samples)); }

    /// Whether compared samples stay where they are, so that later stages do not overwrite them.
    bool isResident() const { return resident_; }
    /// Whether all do.
    bool isWhole() const { return capacity_ >= room_.samples; }
    /// Slots that have room at once.
    int capacity() const { return capacity_; }
    int batches(int mostSlots) const { return (mostSlots + capacity_ - 1) / capacity_; }
    /// Of samples that are not compared: beside those that are, in what is left.
    int batchesOfDeepest(int mostSlots) const;

    /// The same casters again, wherever the host keeps them now.
    void keep(std::span<const Caster> casters) { casters_ = casters; }

    /// What maps have to show.
    struct Needs {
        const gl::Buffer* tiles = nullptr;  ///< of receivers, see ReceiverTiles; null: everything
        int tileCount = 0;
        bool asksByQuads = false;  ///< tiles say which samples they ask for
        float reach = 0;           ///< of the filter between samples, in sides of the unit square
        const gl::Buffer* redraw =
            nullptr;  ///< RedrawGroups: none if last frame's maps will do; null: they will not
    };

    /// Draws the maps of batch `batch` of a stage, as far as they are needed: elsewhere they are undefined.
    void draw(int stage, int batch, const SampleCameras& cameras, const Needs& needs);

    /// The batch that passes are about from now on.
    void choose(int stage, int batch);
    /// What sample_test.glsl and evaluate.comp.glsl ask for.
    void bindTo(gl::Pass& pass) const;

    const gl::Texture& texture() const { return maps_; }
    const gl::Buffer& plan() const { return plan_; }
    const gl::Buffer& slots() const { return slots_; }
    const gl::Buffer& samples() const { return samples_; }
    /// Slots in the order in which resident maps are evaluated.
    const gl::Buffer& order() const { return order_; }

  private:
    void placeLayers(int stage, const SampleCameras& cameras, const Needs& needs);
    void gather(const Needs& needs);
    gl::RasterState rasterState(gl::Compare depthTest) const;
    void clearCells(std::size_t command_bytes) const;
    bool anyHasHoles() const;
    /// `command_bytes` says where the command of a caster is.
    template <typename CommandOf>
    void drawCasters(bool haveHoles, CommandOf command_bytes) const;

    Device::Internals& device_;
    gl::Program opaque_, masked_, placeLayers_, gather_, clear_;
    gl::Texture maps_;
    gl::Framebuffer framebuffer_;
    gl::ConstantBuffer<BatchConstants> batch_;
    gl::Buffer plan_, slots_, order_, samples_, cameras_;  // as the CPU or the device chose them
    gl::Buffer layerCameras_, layerTaps_, layerMasks_, instances_, commands_;  // of the batch, by layer
    gl::Buffer cullBoxes_, casterConstants_;
    std::vector<CullBox> boxes_;
    std::vector<CasterConstants> constants_;
    std::vector<int> identity_;
    std::span<const Caster> casters_;
    int mapSize_px_ = 0;
    int faces_ = 0;
    Room room_;
    int capacity_ = 1;
    bool resident_ = false;
    LightConstants light_{};
};

}  // namespace penumbra::light_sampling
