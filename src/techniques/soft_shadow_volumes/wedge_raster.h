// SPDX-License-Identifier: Apache-2.0
// Penumbra wedges as the thesis draws them (sections 4.2.3 to 4.2.7): the oracle to which counting layers is
// held.
#pragma once

#include "src/gl/pass_timers.h"
#include "src/gl/texture.h"
#include "src/techniques/soft_shadow_volumes/light_points.h"
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

namespace penumbra::soft_shadow_volumes {

class WedgeRaster {
  public:
    explicit WedgeRaster(Device& device);

    enum class Marking {
        none,     ///< wedges are drawn at once, and a pixel outside of one finds that it adds nothing
        stencil,  ///< pixels inside each half wedge are marked first (4.2.7), so that only they pay
    };
    /// What the V-buffer's layers are made of.
    enum class LayerFormat {
        floats,      ///< what the thesis expected of later hardware
        splitBytes,  ///< as published: 12 bits in four bytes (4.2.3), a textured light's in grey
    };
    struct Options {
        Marking marking = Marking::none;
        LayerFormat layerFormat = LayerFormat::floats;
        /// How pixels are marked. Automatic: by Z-pass, but for half wedges that may hold the eye. By Z-pass
        /// alone these come out wrong.
        Counting counting = Counting::automatic;
        bool wireframe = false;  ///< outlines the wedges for inspection
    };

    /// Wedges weigh blockers, not layers: a closed caster hides the light with two layers, an open one with
    /// each. To be called before the frame is counted.
    static void countAsBlockers(VolumeFrame& frame);

    /// Writes visibility into `target`, a texture of the V-buffer's size, from what `counter` has counted.
    void render(const VolumeFrame& frame, const FrameBinding& binding, const AreaLight& light,
                const VolumeCounter& counter, Options options, const gl::TextureRef& target,
                gl::PassTimers& timers);

    /// The V-buffer's additive and subtractive layer; how many (half) wedges each texel was evaluated for;
    /// and the last outlines, where they were asked for.
    void inspect(InspectionVisitor& visitor) const;

  private:
    void allocate(glm::ivec2 size_px, bool isTextured, Options options);
    void makeShaders();
    /// Of the pixels' values, not of what marks them.
    void clearLayers();
    void resolve(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter,
                 const gl::TextureRef& target);
    /// What wedges are made of.
    static void bindEdges(gl::Pass& pass, const FrameBinding& binding, const VolumeCounter& counter);
    void bindEvaluation(gl::Pass& pass, const FrameBinding& binding, const VolumeCounter& counter) const;
    void drawAll(const FrameBinding& binding, const VolumeCounter& counter) const;
    void drawMarked(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter,
                    Counting counting);
    void drawWireframe(const FrameBinding& binding, const VolumeCounter& counter, glm::ivec2 size_px) const;

    Device::Internals& device_;
    gl::Program wedges_, marks_, resolve_;
    LightPoints points_;
    gl::Texture layers_, evaluations_, colors_, depthAndMarks_, wireframe_;
    gl::Texture additiveBytes_, subtractiveBytes_;
    LayerFormat layerFormat_ = LayerFormat::floats;
    gl::Framebuffer framebuffer_, wireframeFramebuffer_;
};

}  // namespace penumbra::soft_shadow_volumes
