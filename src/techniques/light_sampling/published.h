// SPDX-License-Identifier: Apache-2.0
// The paper's algorithm alone (M. Schwärzler, O. Mattausch, D. Scherzer, M. Wimmer 2012, sections 3.3
// and 3.4): a level's quads are compared one by one, each with an occlusion query, and the CPU waits for the
// counts before it splits. Nothing here knows of what came later: no shadow bits, no masks of receivers, no
// last frame's tree. The tree has quads or, for a light that shines from all of its inside, octants.
#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "src/gl/pass_timers.h"
#include "src/gl/sample_query.h"
#include "src/techniques/light_sampling/evaluation.h"
#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/tree_counts.h"

namespace penumbra::light_sampling {

class PublishedSampling {
  public:
    explicit PublishedSampling(Device& device);

    struct Options {
        int maxSamples = latticeVertices;
        int minDepth = 0, maxDepth = deepestLevel;
        int tolerated = 0;  ///< failing fragments that do not yet split a quad
        float comparisonScale = 1;
        bool usesPaperWeights = true;  ///< equation 3; else by area
        int dimensions = 2;            ///< 3: octants, down to level 3 at most
        bool hasMargin = false;  ///< the lattice's vertices are middles of cells, not the light's corners
        EvaluationOptions evaluation;
    };

    /// Vertices along a side of the lattice.
    static int side(int dimensions) { return dimensions == 3 ? 9 : latticeSide; }

    /// What a frame is made from. `maps` have been prepared for `samples`, which are those of a whole
    /// lattice.
    struct Frame {
        const ShadowInputs& inputs;
        const ViewBinding& view;
        const SampleCameras& cameras;
        std::span<LightSample> samples;
        SampleMaps& maps;
        RadianceWeights& radiance;
        gl::PassTimers& timers;
        VisibilityBuffer& out;
    };

    /// Throws Error::Kind::badArgument where the memory has no room for the maps of a single quad, or where
    /// the host has an occlusion query under way.
    void render(const Frame& frame, const Options& options);

    const TreeCounts& counts() const { return counts_; }
    /// Figure 6: the root's sums in colours (red 1, green 2, blue 3), fragments that fail, quads on the
    /// light.
    const gl::Texture& sumsPicture() const { return sumsPicture_; }
    const gl::Texture& failingPicture() const { return failingPicture_; }
    const gl::Texture& quadsPicture() const;

  private:
    struct Cell {
        glm::ivec3 low{0};  ///< in steps of the lattice
        int level = 0;
        int side = 1;
    };

    void prepareTargets(const VisibilityBuffer& out, float scale);
    void subdivide(const Frame& frame, const Options& options);
    void count(const Frame& frame, const Options& options, const Cell& cell, gl::SampleQuery& query);
    bool split(const Cell& cell, std::vector<Cell>& finer);
    void drawNewMaps(const Frame& frame, int level);
    void weigh(const Frame& frame, const Options& options);
    void evaluate(const Frame& frame, const Options& options);

    int vertexAt(const glm::ivec3& place) const { return (place.z * side_ + place.y) * side_ + place.x; }
    int corners() const { return 1 << dimensions_; }
    static glm::ivec3 cornerOf(int i) { return {i & 1, i >> 1 & 1, i >> 2}; }

    gl::Program test_, illustrateQuads_;
    SampleLookup sums_;
    SampleEvaluation evaluation_;
    gl::Texture sumsTarget_, sumsPicture_, failingPicture_;
    gl::Framebuffer sumsOfRoot_, sumsOfCell_, failing_;
    mutable gl::Texture quadsPicture_;
    gl::Buffer tree_;
    std::deque<gl::SampleQuery> queries_;

    int dimensions_ = 2, side_ = 1, maxSamples_ = 0;
    std::vector<int> slotOfVertex_, vertexOfSlot_;
    int drawnSlots_ = 0;
    std::vector<Cell> leaves_;
    std::vector<glm::vec4> cells_;
    TreeCounts counts_;
};

}  // namespace penumbra::light_sampling
