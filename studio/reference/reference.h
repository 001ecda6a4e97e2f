// SPDX-License-Identifier: Apache-2.0
// The truth that every technique is measured against: visibility by ray tracing, on the CPU, from the very
// positions that the techniques get. Knows no OpenGL.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "penumbra/light.h"
#include "studio/image/image.h"
#include "studio/reference/alpha_texture.h"
#include "studio/reference/content_hash.h"

namespace penumbra::studio {

/// One surface point a pixel, rows from the top. All vectors hold width_px * height_px elements.
struct ReceiverImage {
    int width_px = 0, height_px = 0;
    std::vector<glm::vec3> posWorld;     ///< as a depth buffer has them: near their surface
    std::vector<glm::vec3> normalWorld;  ///< unit, of the triangle (not interpolated), facing the camera
    std::vector<std::uint8_t> valid;     ///< 0: no surface, or one that receives no shadow; V is 1 there
    /// Where the positions were seen from: their rounding errors grow with the distance from here.
    glm::vec3 eyeWorld{0};
    /// False: the positions are as exact as floats are, and are left where they are.
    bool areFromDepth = true;
};

/// Radiance over a rect light: linear, three channels, row 0 at the light's -Y edge, column 0 at its -X edge.
/// Sampled as a GPU does with GL_LINEAR and GL_CLAMP_TO_EDGE, without mipmaps; what is negative or not finite
/// counts as 0.
struct RadianceTexture {
    Image rgb;
};

/// A surface that blocks light, with both sides of every triangle. The spans are read by ReferenceScene's
/// constructor only. Triangles with a vertex that is not finite block nothing.
struct TracedCaster {
    std::span<const glm::vec3> positions;    ///< mesh space, metres
    std::span<const std::uint32_t> indices;  ///< three a triangle
    std::span<const glm::vec2>
        uvs{};  ///< one a position, or empty (then (0, 0)); read with an alpha mask only
    glm::mat4 worldFromMesh{1};
    std::optional<TracedAlphaMask> alphaMask{};
    /// What it lets through, a channel each, in [0, 1]. However often a ray meets it, it passes it once.
    glm::vec3 transmittance{0};
    bool blocks = true;  ///< false: blocks no light, but receivers may lie on it
};

struct ReferenceOptions {
    int samples = 256;  ///< rays a pixel, 2 to 65536; lights of size zero take one
    std::uint32_t seed = 1;
    enum class Weight {
        area,        ///< the definition: see VisibilityBuffer in penumbra/technique.h
        irradiance,  ///< each part of the light weighted by both cosines and the inverse square of its
                     ///< distance
    };
    Weight weight = Weight::area;
    /// Called with the share that is done, rising to 1, from one thread at a time but not always the same.
    /// What it throws ends the trace and reaches the caller.
    std::function<void(double)> progress = {};
};

struct ReferenceResult {
    Image visibility;  ///< in [0, 1]; one channel, or three for a textured light, or where casters let light
                       ///< pass
    /// Standard error of a pixel: root of the mean square over receiving pixels and channels. Each pixel's
    /// samples are two halves, scrambled independently. Their results Va and Vb have the same variance s^2,
    /// and V = (Va + Vb) / 2 has s^2 / 2, which is what the square of (Va - Vb) / 2 is on average.
    double noise_rms = 0;
    std::uint64_t rays = 0;
    double seconds = 0;
};

/// The casters of one moment, ready for rays. Does not depend on lights or receivers. Const calls may run in
/// parallel.
class ReferenceScene {
  public:
    /// Throws InputError if an index is out of range, or the number of indices is no multiple of three.
    explicit ReferenceScene(std::span<const TracedCaster> casters);
    ReferenceScene(ReferenceScene&&) noexcept;
    ReferenceScene& operator=(ReferenceScene&&) noexcept;
    ~ReferenceScene();

    /// The fraction of `light` that each receiver sees. What counts as the whole:
    /// - rect and disk: the area above the receiver's horizon; a one-sided light is whole only seen from its
    /// -Z side
    /// - sphere: the solid angle of what is seen of it, above the horizon; from inside it, all directions
    /// - distant: the part of its cone above the horizon
    /// - size zero: the centre
    /// Where nothing is left of the whole, V is 0. Where the position or normal is not finite, V is 1.
    ///
    /// Receivers are first moved onto the surface that they show: the plane of the nearest triangle across
    /// their normal, if one lies within 1e-3 of (their distance from the eye + their largest coordinate). A
    /// depth buffer's position of a triangle of 400 m is off by more than what a contact shadow can bear.
    /// (Those that are not from depth are not moved.)
    ///
    /// A blocker exactly in the receiver's plane does not block, nor one in the light's own
    /// (penumbra/light_plane.h): rays start off the surface by 4e-6 of (its distance from the eye + its
    /// largest coordinate) and end 1e-5 of their length before the light.
    ///
    /// `texture` (or nullptr) is for rect lights. The same seed gives the same bits, whatever the number of
    /// threads.
    ReferenceResult trace(const ReceiverImage& receivers, const AreaLight& light,
                          const RadianceTexture* texture, const ReferenceOptions& options = {}) const;

    /// Of everything about the casters that visibility depends on.
    const ContentHash& contentHash() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::studio
