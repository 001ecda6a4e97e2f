// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio::gltf {

/// What COLOR_0 means for a mesh: colours of its vertices and, of a material with holes, alpha.
class VertexColors {
  public:
    explicit VertexColors(Scene& scene) : scene_(scene) {}

    /// Gives the mesh its colours, and where alpha matters a material of its own: alpha that is the same all
    /// over multiplies the base colour's, alpha that varies becomes a texture, so that all who look up a mask
    /// find it. Returns false where it varies beside a texture's, which alone then decides.
    bool apply(const std::vector<glm::vec4>& colors, Mesh& mesh);

  private:
    int withAlpha(int material, float alpha);
    int withRamp(int material);
    int rampTexture();

    Scene& scene_;
    std::map<std::pair<int, float>, int> withAlpha_;  ///< materials made, by the one they are like and alpha
    std::map<int, int> withRamp_;
    int rampTexture_ = -1;
};

}  // namespace penumbra::studio::gltf
