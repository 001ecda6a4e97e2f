// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "penumbra/penumbra.h"
#include "src/gl/shader_library.h"
#include "studio/frame/gbuffer.h"
#include "studio/frame/gpu_scene.h"
#include "studio/frame/lighting_io.h"
#include "studio/image/image.h"

namespace penumbra::studio {

/// The frame: scene -> G-buffer -> (a technique, all lights) -> lighting -> image. In this order:
///
///     frame.draw(scene, moment, camera, width_px, height_px);
///     std::vector<VisibilityBuffer> visibilities = frame.makeVisibilities(moment.lights);
///     technique.renderLights(frame.frameInputs(frame.frameLights(moment.lights, visibilities)));
///     for (i ...) frame.addLight(moment.lights[i], visibilities[i]);
///     frame.addLuminaires(moment.lights);
///     Image picture = frame.readDisplay();
class FrameRenderer {
  public:
    /// `shaderSourceDirectory` as in DeviceOptions.
    explicit FrameRenderer(Device& device, std::filesystem::path shaderSourceDirectory = {});

    /// Draws what the camera sees and forgets the light of the frame before. `scene` must be at `moment` and
    /// stay alive until the next call. Sizes from 1 to Device::maxTextureSize_px().
    void draw(const GpuScene& scene, const SceneMoment& moment, const Camera& camera, int width_px,
              int height_px);

    /// See View::shadingNormalTexture: on, facets of smoothly shaded meshes do not show in their shadows.
    void setSmoothTerminator(bool isSmooth) { gbuffer_.setSmoothTerminator(isSmooth); }

    /// Forgets the light that was added: the same view again, with other visibility.
    void beginLighting();

    /// What a technique needs to know; without casters for a light that casts no shadow.
    ShadowInputs shadowInputs(const Light& light) const;
    /// Whether its visibility differs by channel: penumbra::needsColor.
    bool needsColor(const Light& light) const;
    VisibilityBuffer makeVisibility(const Light& light) const;

    /// The same for several lights at once.
    std::vector<VisibilityBuffer> makeVisibilities(std::span<const Light> lights) const;
    FrameLight frameLight(const Light& light, VisibilityBuffer& out) const;
    std::vector<FrameLight> frameLights(std::span<const Light> lights, std::span<VisibilityBuffer> out) const;
    FrameInputs frameInputs(std::span<const FrameLight> lights) const;

    /// Adds a light times its visibility.
    void addLight(const Light& light, const VisibilityBuffer& visibility);

    /// Whether the lights themselves are seen: off unless it is asked for.
    void showLuminaires(bool areShown) { showsLuminaires_ = areShown; }
    /// Those that have a size and a place, with their luminance towards the camera, where no surface stands
    /// before them. That changes radiance() and the picture, and not what lights reach, how bright pictures
    /// are, or illuminance(), which are of the surface behind.
    void addLuminaires(std::span<const Light> lights);

    /// How bright pictures are: what shows `1.2 * 2^ev` nits as white (exposure value at ISO 100). Without
    /// one it is chosen anew for each picture, so that the mean of the unshadowed picture is mid-grey,
    /// whatever the technique.
    void setExposure(std::optional<float> ev) { exposureValue_ = ev; }
    /// Of the last toneMap(), chosen or set. Waits for the device.
    float readExposureValue() const;

    /// The picture as shown: exposed, tone mapped, sRGB-encoded RGBA8. Owned by the frame, as are the
    /// textures below; all have the size of the last draw() and are replaced when it changes.
    const gl::Texture& toneMap();
    const gl::Texture& radiance() const { return radiance_; }        ///< nits, RGBA32F
    const gl::Texture& illuminance() const { return illuminance_; }  ///< lux on each surface, R32F
    const gl::Texture& reach() const { return reach_; }              ///< see readReach()
    const GBuffer& gbuffer() const { return gbuffer_; }
    const CameraView& camera() const { return camera_; }

    /// See Device::reloadShaders, which is about the library's.
    void reloadShaders() { shaders_.reload(); }

    /// Reading waits for the device. Rows from the top.
    Image readVisibility(const VisibilityBuffer& visibility) const;  ///< 1 channel, or 3 where it is colored
    Image readReach()
        const;  ///< the last light's unshadowed irradiance for unit emission, 1 channel; 0: not reached
    Image readRadiance() const;  ///< nits, RGB
    Image readDisplay();         ///< sRGB-encoded RGB in [0, 1]

  private:
    void resize(int width_px, int height_px);
    LightingConstants constantsOf(const Light& light) const;

    Device& device_;
    gl::ShaderLibrary shaders_;
    GBuffer gbuffer_;
    gl::Program lighting_, luminaire_, exposureRows_, exposure_, toneMap_;
    gl::Buffer exposureResult_, rowSums_;
    std::optional<float> exposureValue_;
    bool showsLuminaires_ = false;
    gl::Texture radiance_, unshadowed_, illuminance_, reach_, nearness_, display_;
    const GpuScene* scene_ = nullptr;
    CameraView camera_;
};

/// A texture's base level on the CPU, rows from the top. Waits for the device.
Image readTexture(GLuint texture, int width_px, int height_px, int channels);

}  // namespace penumbra::studio
