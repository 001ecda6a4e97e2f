// SPDX-License-Identifier: Apache-2.0
// The referee and `exact` on grounds that are large for what stands on them: positions out of their depth lie
// further off them than rays start.
#include "studio/frame/conversions.h"
#include "tests/support/random_ground.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class GroundTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{64, 40};
    static constexpr std::uint32_t scenes = 60;

    /// No pixel of a ground that casts is darker than it is where it casts nothing, nor lighter.
    static void expectGroundHidesNothing(std::string_view name, const Settings& settings, float tolerance) {
        const std::unique_ptr<Technique> technique = workbench().makeTechnique(name);
        for (const auto& [key, value] : settings) setParameter(*technique, key, value);
        for (std::uint32_t seed = 0; seed < scenes; ++seed) {
            const RandomGround ground = makeRandomGround(seed);
            const Image casting = render(*technique, ground.casting, size).visibility;
            const Image receiving = render(*technique, ground.receiving, size).visibility;
            int darker = 0, lighter = 0;
            for (std::size_t i = 0; i < casting.values.size(); ++i) {
                darker += !(casting.values[i] >= receiving.values[i] - tolerance);
                lighter += !(casting.values[i] <= receiving.values[i] + tolerance);
            }
            EXPECT_EQ(darker, 0) << ground.description;
            EXPECT_EQ(lighter, 0) << ground.description;
        }
    }
};

TEST_F(GroundTest, HidesNothingFromExact) {
    expectGroundHidesNothing("exact", {}, 0);
}

TEST_F(GroundTest, HidesNothingFromTheReference) {
    expectGroundHidesNothing("reference", {{"samples", "32"}, {"cache", "false"}}, 0);
}

/// Techniques that see by maps or edges answer for texels and edges that the ground has and the box has not:
/// single pixels may differ, but no part of the ground.
class GroundOfEveryTechnique : public GroundTest, public ::testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(Catalog, GroundOfEveryTechnique, everyTechnique(), techniqueTestName);

TEST_P(GroundOfEveryTechnique, HidesNothing) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique(GetParam());
    if (GetParam() == "uniform") setParameter(*technique, "samples", "5");
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const RandomGround ground = makeRandomGround(seed);
        const Image casting = render(*technique, ground.casting, size).visibility;
        const Image receiving = render(*technique, ground.receiving, size).visibility;
        int darker = 0;
        for (std::size_t i = 0; i < casting.values.size(); ++i)
            darker += casting.values[i] < receiving.values[i] - 0.1f;
        EXPECT_LE(double(darker), 0.01 * double(casting.values.size())) << ground.description;
    }
}

}  // namespace
}  // namespace penumbra::studio
