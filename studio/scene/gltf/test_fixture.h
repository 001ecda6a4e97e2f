// SPDX-License-Identifier: Apache-2.0
// What the tests of known answers share.
#pragma once

#include <gtest/gtest.h>

#include <numbers>

#include "studio/scene/gltf/gltf.h"
#include "studio/scene/gltf/test_gltf.h"

namespace penumbra::studio {

inline constexpr float pi = std::numbers::pi_v<float>;

inline void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Changes `gltf_`, loads it.
class Gltf : public ::testing::Test {
  protected:
    Scene load(const GltfOptions& options = {}) {
        return loadGltf(folder_.write("scene.gltf", gltf_.text()), options);
    }

    TemporaryFolder folder_;
    TestGltf gltf_;
};

}  // namespace penumbra::studio
