// SPDX-License-Identifier: Apache-2.0
// Shadow algorithms for computer graphics (F. Crow, SIGGRAPH 1977), counted in floats instead of a stencil
// buffer: for each receiver the number of triangles between it and the light's centre. README.md has the
// derivation.
#pragma once

#include "src/gl/framebuffer.h"
#include "src/gl/pass_timers.h"
#include "src/gl/texture.h"
#include "src/techniques/soft_shadow_volumes/volume_frame.h"

namespace penumbra::soft_shadow_volumes {

/// How crossings of a volume's sides are counted.
enum class Counting {
    automatic,  ///< Z-pass, unless the eye is within rounding of a side
    zPass,      ///< those before the receiver, from the number at the eye
    zFail,      ///< those behind the receiver, and the caps (Carmack 2000)
};

/// The parameter that chooses it: `counting` is a Counting.
void describeCounting(ParameterVisitor& visitor, int& counting);

class VolumeCounter {
  public:
    explicit VolumeCounter(Device& device);

    /// Only finds where receivers are, and forgets what is known about the eye.
    void renderReceivers(const VolumeFrame& frame, const FrameBinding& binding);
    /// Finds the silhouettes and counts.
    void render(const VolumeFrame& frame, const FrameBinding& binding, Counting counting);

    /// `volumeCounts` (R32F), and `Eye` (EyeState), whose `blockers` are to be added to them.
    void bindTo(gl::Pass& pass) const;
    /// How many layers a triangle of each caster counts for.
    const gl::StorageArray<int>& layersEach() const { return layersEach_; }

    /// Draws the receivers' depths into a framebuffer of the V-buffer's size.
    void drawReceiverDepth(const gl::Framebuffer& framebuffer, const FrameBinding& binding,
                           glm::ivec2 size_px) const;

    const gl::Texture& counts() const { return counts_; }
    const gl::Texture& depth() const { return depth_; }
    const SilhouetteExtractor& silhouettes() const { return silhouettes_; }
    const gl::Buffer& eye() const { return eye_; }

  private:
    void allocate(glm::ivec2 size_px);
    void forgetEye();
    void examineEye(const VolumeFrame& frame, const FrameBinding& binding, Counting counting);
    void drawSides(const FrameBinding& binding, const gl::RasterState& state, std::size_t commandOffset,
                   float sign) const;
    void drawCaps(const VolumeFrame& frame, const FrameBinding& binding, const gl::RasterState& state,
                  std::size_t ofPair, float sign) const;

    SilhouetteExtractor silhouettes_;
    gl::Program blockers_, safety_, choose_, depthCopy_, sides_, caps_;
    gl::StorageArray<int> layersEach_;
    gl::Buffer eye_;
    gl::Buffer capCommands_;
    gl::Texture counts_, depth_;
    gl::Framebuffer framebuffer_;
};

}  // namespace penumbra::soft_shadow_volumes
