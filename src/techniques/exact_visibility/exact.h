// SPDX-License-Identifier: Apache-2.0
// Visibility of the samples of an area light, exactly and without noise, from any triangles: each triangle
// that may be in the way is projected from each receiver onto the light, row by row of a tilted lattice of
// samples. See README.md.
#pragma once

#include <array>
#include <compare>
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
#include "src/techniques/exact_visibility/receiver_watch.h"

namespace penumbra::exact_visibility {

class ExactVisibility final : public Technique {
  public:
    /// Calibrated against up to 32,768 rays a pixel: docs/manual/choosing.md.
    static constexpr std::array promises = {
        Promise{"samples", "16", 0.075f, 2.2f},    Promise{"samples", "32", 0.048f, 2.6f},
        Promise{"samples", "64", 0.028f, 3.6f},    Promise{"samples", "144", 0.0175f, 4.5f},
        Promise{"samples", "256", 0.01f, 6.0f},    Promise{"samples", "512", 0.0066f, 9.0f},
        Promise{"samples", "1024", 0.005f, 14.0f},
    };

    explicit ExactVisibility(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    bool answersAtPoints() const override { return true; }
    bool answersTubes() const override { return true; }
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    /// What a program that resolves is made for.
    struct ResolveKind {
        int rows;       ///< of the lattice
        bool hasHoles;  ///< casters have alpha masks
        bool isUneven;  ///< samples do not count alike
        auto operator<=>(const ResolveKind&) const = default;
    };

    const gl::Program& resolveFor(const ResolveKind& kind);
    void allocate(int width_px, int height_px, int rows, int rounds);
    bool canKeep(const AreaLight& light, bool isSameView);
    std::size_t countSpecial(const ExactLight& light, LightShape shape) const;
    int roundsFor(std::span<const LightLattice> lattices, std::size_t special) const;
    const std::vector<LightLattice>& latticesFor(const AreaLight& light);
    ExactLight describeLight(const ShadowInputs& inputs, std::span<const LightLattice> lattices) const;
    std::vector<unsigned> sendMasks();

    int samples_ = 64;
    int weight_ = 0;
    int tileCapacity_ = 512;
    int roundWork_;

    Device::Internals& device_;
    CasterSoup soup_;
    gl::Program candidates_, weigh_, restore_;
    std::map<ResolveKind, gl::Program> resolve_;
    std::map<std::pair<int, bool>, std::vector<LightLattice>> lattices_;  // by samples, and whether in a disk
    ViewBinding view_;
    gl::ConstantBuffer<ExactLight> light_;
    gl::StorageArray<glm::vec4> masks_;
    gl::StorageArray<glm::vec4> changedBoxes_;
    gl::Buffer busy_, lists_, states_, rounds_;
    ReceiverWatch receivers_;
    LightAnswer answer_;
    std::vector<std::byte> key_;  ///< of the light that is asked for
    std::uint32_t serial_ = 0;    ///< of the frame
    gl::PassTimers timers_;
};

}  // namespace penumbra::exact_visibility
