// SPDX-License-Identifier: Apache-2.0
// Visibility of the samples of an area light, exactly and without noise, from any triangles: each triangle
// that may be in the way is projected from each receiver onto the light, row by row of a tilted lattice of
// samples. See README.md.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <deque>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "penumbra/promise.h"
#include "penumbra/technique.h"
#include "src/device/device_internals.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/gl/texture.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/exact_visibility/caster_soup.h"
#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/light_answer.h"
#include "src/techniques/exact_visibility/light_lattice.h"
#include "src/techniques/exact_visibility/receiver_tiles.h"
#include "src/techniques/exact_visibility/receiver_watch.h"

namespace penumbra::exact_visibility {

class ExactVisibility final : public Technique {
  public:
    static constexpr std::array withStandIns = {Setting{"stand_ins", "true"}};
    static constexpr std::array withAllTriangles = {Setting{"stand_ins", "false"}};
    /// Calibrated against up to 32,768 rays a pixel: docs/manual/choosing.md. Where few samples leave room
    /// for it, stand-ins' share is in the error.
    static constexpr std::array promises = {
        Promise{"samples", "16", 0.076f, 2.2f, withStandIns},
        Promise{"samples", "32", 0.049f, 2.6f, withStandIns},
        Promise{"samples", "64", 0.029f, 3.6f, withStandIns},
        Promise{"samples", "144", 0.018f, 4.5f, withStandIns},
        Promise{"samples", "256", 0.01f, 6.0f, withAllTriangles},
        Promise{"samples", "512", 0.0066f, 9.0f, withAllTriangles},
        Promise{"samples", "1024", 0.005f, 14.0f, withAllTriangles},
    };

    explicit ExactVisibility(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void renderLights(const FrameInputs& frame) override;
    bool answersAtPoints() const override { return true; }
    bool answersTubes() const override { return true; }
    bool answersPanes() const override { return true; }
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    /// What a program that resolves is made for.
    struct ResolveKind {
        int rows;        ///< of the lattice
        bool isOfParts;  ///< parts of tiles are busy
        bool hasHoles;   ///< casters have alpha masks
        bool isUneven;   ///< samples do not count alike
        int cells;       ///< of a rectangle, along each side, that are answered for, too
        int paneSteps;   ///< in which samples are taken through panes
        auto operator<=>(const ResolveKind&) const = default;
    };

    /// What some of a frame's lights share: where coordinates begin, and what casts.
    struct Stage {
        View view;
        glm::dvec3 originWorld{0};
        ExactFrame frame;
        std::uint64_t casterRevision = 0;
        bool hasCasters = false;
    };

    void prepare(const Stage& stage, const FrameInputs& frame);
    void answer(const Stage& stage, const FrameLight& light, std::size_t place);
    void bindTiles(gl::Pass& pass, const gl::TextureRef& visibility) const;
    void findCandidates(const Stage& stage, const AreaLight& light, const gl::TextureRef& visibility,
                        bool keeps);
    void sift(const gl::TextureRef& visibility);
    void resolve(const Stage& stage, const AreaLight& light, const ExactLight& described,
                 const gl::TextureRef& visibility);

    const gl::Program& resolveFor(const ResolveKind& kind);
    LightAnswer& answerFor(std::size_t place, const View& view);
    void describeKey(const Stage& stage, const FrameLight& asked);
    bool canKeep(const Stage& stage, const FrameLight& asked, const LightAnswer& answer);
    int askedRound(int next, int count) const;
    int cellsFor(const AreaLight& light) const;
    const std::vector<LightLattice>& latticesFor(const AreaLight& light);
    void sendMasks();

    int samples_ = 64;
    int weight_ = 0;
    int cells_ = 1;
    bool usesStandIns_ = false;
    int tileCapacity_ = 512;
    int roundWork_;

    Device::Internals& device_;
    CasterSoup soup_;
    gl::Program candidates_, sift_, weigh_, restore_;
    std::map<ResolveKind, gl::Program> resolve_;
    std::map<std::pair<int, bool>, std::vector<LightLattice>> lattices_;  // by samples, and whether in a disk

    // Of a frame.
    std::uint32_t serial_ = 0;
    bool isSameView_ = false;
    ViewBinding view_;
    gl::ConstantBuffer<ExactFrame> frame_;
    ReceiverWatch receivers_;
    ReceiverTiles tiles_;
    gl::StorageArray<glm::vec4> masks_, panes_;
    std::vector<unsigned> maskTextures_;  ///< each once
    gl::StorageArray<glm::vec4> changedBoxes_;

    // Of one light after the other.
    gl::ConstantBuffer<ExactLight> light_;
    gl::Buffer busy_, parts_, lists_, states_, rounds_;
    std::vector<std::byte> key_;       ///< of the light that is asked for
    std::deque<LightAnswer> answers_;  ///< by the light's place in its frame
    LightAnswer* answer_ = nullptr;    ///< the last
    bool isFirst_ = false;             ///< it is its frame's first, and what all share was made for it
    gl::PassTimers frameTimers_, timers_;
};

}  // namespace penumbra::exact_visibility
