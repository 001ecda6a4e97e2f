// SPDX-License-Identifier: Apache-2.0
// Summing what receivers see of the samples whose maps are at hand (section 3.4.2 of the paper).
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "src/techniques/common/view_constants.h"
#include "src/techniques/light_sampling/sample_maps.h"

namespace penumbra::light_sampling {

/// What the parameters say about it.
struct EvaluationOptions {
    enum Path { array, accumulation };
    int path = array;              ///< all maps of a batch in one pass, or a pass a map
    int filter = 1;                ///< a side of the kernel in texels, 1 to 3
    int weighting = 0;             ///< 0: by area, 1: by irradiance
    bool hasBoxKernel = false;     ///< 3 x 3 texels count alike; else a B-spline weighs them
    bool emitsThroughout = false;  ///< a sphere shines from all of its inside

    void describe(ParameterVisitor& visitor);
};

/// The programs that look receivers up in maps, in the variants that lights need, and what all of them are
/// told.
class SampleLookup {
  public:
    SampleLookup(Device& device, std::vector<std::string> files);

    /// What a caller wants of a program.
    struct Features {
        bool colored = false;  ///< sums a channel each
        bool bits = false;     ///< reads what was compared from shadow bits
        bool smooth = false;   ///< filters between samples that disagree
        bool partial = false;  ///< adds to a sum that takes several passes
        bool kept = false;     ///< the answer is, for frames in which nothing changes
        auto operator<=>(const Features&) const = default;
    };

    /// The variant for this light; passes of it bind this object, for what sample_test.glsl needs.
    const gl::Program& prepare(const AreaLight& light, const SampleCameras& cameras,
                               const EvaluationOptions& options, const Features& features);
    void bindTo(gl::Pass& pass) const { pass.bind("LookupBlock", constants_); }

  private:
    struct Variant {
        Features features;
        int filter = 1;
        bool distant = false, sphere = false, cube = false, box = false, volume = false;
        auto operator<=>(const Variant&) const = default;
        std::vector<std::string> defines() const;
    };

    Device::Internals& device_;
    std::vector<std::string> files_;
    std::map<Variant, gl::Program> programs_;
    gl::ConstantBuffer<LookupConstants> constants_;
};

class SubdivisionPasses;

class SampleEvaluation {
  public:
    explicit SampleEvaluation(Device& device);

    /// A batch of a stage, as one of several that make the sum.
    struct Batch {
        int stage = stageOfAll;
        int batch = 0;
        int mostSlots = 1;                        ///< it can hold
        bool isOnlyOne = true;                    ///< that makes the sum
        const SubdivisionPasses* bits = nullptr;  ///< where all that was compared comes from; or null
        int taps = 0;         ///< of the filter between samples that disagree, a power of two; 0: none
        bool isKept = false;  ///< for restore()
        const gl::Buffer* redraw = nullptr;  ///< RedrawGroups: none if the kept answer will do; or null
    };

    /// The last answer that was kept, of the same size.
    void restore(VisibilityBuffer& out);

    /// Adds a batch to the sums.
    void add(const ShadowInputs& inputs, const ViewBinding& view, const SampleCameras& cameras,
             const EvaluationOptions& options, SampleMaps& maps, const Batch& batch, VisibilityBuffer& out);

  private:
    SampleLookup lookup_;
    gl::Program restore_;
    gl::Texture seen_, whole_, kept_;
};

/// Shares of a textured light's radiance.
class RadianceWeights {
  public:
    explicit RadianceWeights(Device& device);

    /// Sets each sample's colour weight to the radiance over its cell of the unit square (xy: min, zw: max)
    /// times its weight by area.
    void weigh(GLuint radianceTexture, std::span<const glm::vec4> cells, const gl::Buffer& samples);

  private:
    gl::Program program_;
    gl::StorageArray<glm::vec4> cells_;
};

/// The unit square in cells of which each of a sample's four quarters is a whole number, whatever quads there
/// are around it: 34 a side, or 32 where the lattice has the square's corners.
class LatticeShares {
  public:
    void set(bool hasCorners);

    int perSide() const { return perSide_; }
    std::span<const glm::vec4> cells() const { return cells_; }
    /// LightSample by LightSample, in whose weights RadianceWeights leaves the radiance.
    const gl::Buffer& buffer() const { return shares_; }

  private:
    int perSide_ = 0;
    std::vector<glm::vec4> cells_;
    gl::Buffer shares_;
};

}  // namespace penumbra::light_sampling
