// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <vector>

#include "penumbra/penumbra.h"
#include "src/gl/program.h"
#include "src/gl/shader_library.h"
#include "src/gl/texture.h"
#include "studio/frame/gpu_scene.h"

namespace penumbra::studio {

/// What one light sends to one point.
struct PointLight {
    float lux = 0;
    float bound_lux = 0;  ///< how far off `lux` may be, as the technique bounds its visibility
    float seen = 0;       ///< of the light that reaches the point without shadows
    float unshadowed_lux = 0;
};

/// Light at points, where the frame has light on a picture.
class PointLighting {
  public:
    explicit PointLighting(Device& device, std::filesystem::path shaderSourceDirectory = {});

    /// What `light` sends to each point, past the scene's casters; cell by cell of a rectangle with a
    /// profile, where the technique says what is seen of each ("cells"). Waits for the device. Throws
    /// Error::Kind::badArgument where the technique does not answer at points, or states no "error bound".
    std::vector<PointLight> measure(const Points& points, const GpuScene& scene, const Light& light,
                                    Technique& technique);

  private:
    /// What a program is made for.
    struct Kind {
        LightShape shape;
        int profileType;  ///< noProfile, ...
        bool hasEvenAngles, isTextured;
        int cells;  ///< along each side of a rectangle, for which the technique has answered
        auto operator<=>(const Kind&) const = default;
    };
    const gl::Program& programFor(const Kind& kind);

    Device& device_;
    gl::ShaderLibrary shaders_;
    std::map<Kind, gl::Program> lighting_;
    gl::Texture measured_;
};

}  // namespace penumbra::studio
