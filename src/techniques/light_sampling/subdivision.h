// SPDX-License-Identifier: Apache-2.0
// The quadtree over the light and the passes that grow it, level by level, on the device (section 3.3 of the
// paper).
#pragma once

#include <array>
#include <optional>

#include "src/gl/framebuffer.h"
#include "src/techniques/light_sampling/evaluation.h"
#include "src/techniques/light_sampling/subdivision_io.h"

namespace penumbra {

/// When to split.
struct SubdivisionOptions {
    int maxSamples = latticeVertices;
    int minDepth = 1;    ///< every quad above it is split
    int tolerated = 0;   ///< failing fragments that do not yet split a quad
    float maxError = 0;  ///< 0: the paper's test; else split until the error's estimate is below
};

class SubdivisionPasses {
  public:
    explicit SubdivisionPasses(Device& device);

    /// The most slots that a level can add.
    static constexpr std::array<int, deepestLevel + 1> mostSlots = {4, 5, 16, 56, 208};

    /// Sizes the comparison target.
    void prepare(int width_px, int height_px);

    /// Starts a tree with its corners in the plan's stage 0.
    void start(const SampleMaps& maps, const SubdivisionOptions& options);

    /// Adds the shadow values of a batch's samples (its maps must be drawn, the view be bound).
    void compare(const ShadowInputs& inputs, const SampleCameras& cameras, const SampleMaps& maps, int stage,
                 int batch, bool starts);

    /// Tests the quads of a level, and splits those that fail it: the plan's stage `level` + 1 are the new
    /// samples.
    void examine(int level, const SubdivisionOptions& options);
    void decide(const SampleMaps& maps, int level, const SubdivisionOptions& options);

    /// Writes the samples' weights. `cellShares`: the radiance over 34 x 34 cells of a textured light, or
    /// null.
    void weigh(const SampleMaps& maps, bool usesPaperWeights, const gl::Buffer* cellShares);

    void bindBits(GLuint unit) const { bits_.bind(unit); }

    /// Asks for the tree's numbers, and gets those of an earlier frame that have arrived: nobody waits.
    void requestReadback(const SampleMaps& maps);
    struct Snapshot {
        Subdivision subdivision;
        SamplingPlan plan;
    };
    std::optional<Snapshot> latest() const;

    /// Draws the pictures to look at: colour-coded sums of the root's corners (Figure 6: red 1, green 2, blue
    /// 3), fragments that fail at any level, and the quads on the light.
    void illustrate() const;
    const gl::Texture& sumsPicture() const { return sums_; }
    const gl::Texture& failingPicture() const { return failing_; }
    const gl::Texture& quadsPicture() const { return quads_; }

  private:
    class Fence {
      public:
        Fence() = default;
        Fence(const Fence&) = delete;
        Fence& operator=(const Fence&) = delete;
        ~Fence() { set(nullptr); }
        void set(GLsync sync) {
            if (sync_ != nullptr) glDeleteSync(sync_);
            sync_ = sync;
        }
        bool hasPassed() const {
            if (sync_ == nullptr) return false;
            const GLenum state = glClientWaitSync(sync_, 0, 0);
            return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
        }

      private:
        GLsync sync_ = nullptr;
    };
    struct Readback {
        gl::Buffer subdivision, plan;
        Fence fence;
    };

    gl::Program decide_, examine_, weigh_, illustrate_, illustrateQuads_;
    SampleLookup compare_;
    gl::Buffer tree_;
    gl::Texture bits_;
    mutable gl::Texture sums_, failing_, quads_;
    static constexpr int framesInFlight = 3;
    std::array<Readback, framesInFlight> readbacks_;
    int newest_ = 0;
    mutable std::optional<Snapshot> latest_;
};

}  // namespace penumbra
