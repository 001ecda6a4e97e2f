// SPDX-License-Identifier: Apache-2.0
// The quadtree over the light and the passes that grow it, level by level, on the device (section 3.3 of the
// paper).
#pragma once

#include <array>
#include <optional>

#include "src/gl/fence.h"
#include "src/techniques/light_sampling/evaluation.h"
#include "src/techniques/light_sampling/subdivision_io.h"

namespace penumbra::light_sampling {

/// When to split.
struct SubdivisionOptions {
    int maxSamples = latticeVertices;  ///< at least 4
    int minDepth = 1;                  ///< every quad above it is split
    int maxDepth = deepestLevel;
    int tolerated = 0;    ///< failing fragments that do not yet split a quad
    float maxError = 0;   ///< 0: the paper's test; else split until the bound of the error is below
    float cellError = 0;  ///< of a quad whose corners disagree, over its area

    /// Down to which the tree is split at its start: what minDepth asks for, as far as the samples allow.
    int baseDepth() const;
    /// Maps and comparisons that a tree may take until all of it is decided.
    int rounds() const { return maxDepth - baseDepth(); }
    /// The most slots that a round can add; that of rounds() are those that are not compared.
    int mostSlots(int round) const;
    /// Samples that may be compared: all but those of the deepest level.
    int mostCompared() const;
    /// Slots for a tree, and for the vertices of the last frame's that it may turn out not to have.
    int mostSlotsInAll() const;

    bool operator==(const SubdivisionOptions&) const = default;
};

class SubdivisionPasses {
  public:
    explicit SubdivisionPasses(Device& device);

    /// Sizes the comparison target.
    void prepare(int width_px, int height_px);

    /// Starts a tree, whose first samples are in the plan's stage 0. `isCoherent`: those of the last tree are
    /// among them; its options must have been the same.
    void start(const SampleMaps& maps, const SubdivisionOptions& options, bool isCoherent);

    /// Adds the shadow values of a batch's samples (its maps must be drawn). Does nothing for a round without
    /// samples; the stage of all that is compared is compared as `redraw` (RedrawGroups) says.
    void compare(const ShadowInputs& inputs, const ViewBinding& view, const SampleCameras& cameras,
                 SampleMaps& maps, const SubdivisionOptions& options, int stage, int batch,
                 const gl::Buffer* redraw);

    /// Tests the quads that are known, and splits those that fail: the plan's stage `round` + 1 are the new
    /// samples to compare, that of the deepest those that are not compared.
    void examine(const SampleMaps& maps, const SubdivisionOptions& options);
    /// Finds the bound of the finished tree's error.
    void examineError(const SubdivisionOptions& options);
    void decide(const SampleMaps& maps, int round, const SubdivisionOptions& options);

    /// Writes the samples' weights and order.
    void weigh(const SampleMaps& maps, bool usesPaperWeights, const LatticeShares& shares, bool isTextured);

    /// The shadow values and the tree, for settled.glsl.
    void bindTo(gl::Pass& pass) const { pass.bind("shadowBits", bits_).bind("SubdivisionBlock", tree_); }

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
    struct Readback {
        gl::Buffer subdivision, plan;
        gl::Fence fence;
    };

    void decide(const SampleMaps& maps, int round, const SubdivisionOptions& options, bool isCoherent);
    /// What the maps' plan says is to be examined; null: everything.
    void examine(const SampleMaps* maps, const SubdivisionOptions& options);

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

}  // namespace penumbra::light_sampling
