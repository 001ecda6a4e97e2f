// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/weld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace penumbra::studio {
namespace {

TEST(Weld, MakesWhatIsNearEqualAndLeavesTheRest) {
    std::vector<glm::vec3> one = {{0, 0, 0}, {1, 0, 0}, {1.0005f, 0, 0}, {5, 5, 5}},
                           other = {{1, 0.0005f, 0}, {0, 0, 0.002f}};
    const std::vector<std::span<glm::vec3>> surfaces = {one, other};
    weld(surfaces, 0.001f);
    EXPECT_EQ(one, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {5, 5, 5}}));
    EXPECT_EQ(other, (std::vector<glm::vec3>{{1, 0, 0}, {0, 0, 0.002f}}));
    weld(surfaces, 0);
    EXPECT_EQ(other[1], glm::vec3(0, 0, 0.002f));
}

TEST(Weld, FindsNeighboursAcrossCells) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 a(anywhere(random), anywhere(random), anywhere(random));
        const glm::vec3 towards =
            glm::normalize(glm::vec3(anywhere(random), anywhere(random), anywhere(random)));
        std::vector<glm::vec3> pair = {a, a + 0.9e-3f * towards}, apart = {a, a + 1.1e-3f * towards};
        weld(std::vector<std::span<glm::vec3>>{pair}, 1e-3f);
        weld(std::vector<std::span<glm::vec3>>{apart}, 1e-3f);
        EXPECT_EQ(pair[0], pair[1]);
        EXPECT_NE(apart[0], apart[1]);
    }
}

TEST(Weld, IsQuickWhereAllIsInOnePlace) {
    std::vector<glm::vec3> crowd(1 << 18, glm::vec3(0));
    for (std::size_t i = 0; i < crowd.size(); i += 2) crowd[i] = {1e-3f * float(i % 997) / 997, 0, 0};
    weld(std::vector<std::span<glm::vec3>>{crowd}, 1e-3f);
    for (const glm::vec3& position : crowd) ASSERT_EQ(position, crowd[0]);
}

}  // namespace
}  // namespace penumbra::studio
