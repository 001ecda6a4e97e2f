// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/penumbra.h"
#include "src/gl/framebuffer.h"
#include "src/gl/pass.h"
#include "studio/frame/camera_view.h"
#include "studio/frame/gbuffer_io.h"
#include "studio/frame/gpu_scene.h"

namespace penumbra::studio {

/// What the camera sees: depth, normals and albedo of the nearest surface of each pixel.
class GBuffer {
  public:
    explicit GBuffer(gl::ShaderLibrary& shaders);

    /// Draws the scene at `width_px` x `height_px`.
    void render(const GpuScene& scene, const CameraView& view, int width_px, int height_px);

    /// For techniques, which get the depth, the geometric normals and the receiver mask.
    const View& view() const { return view_; }
    /// Whether techniques get the shading normals, too (View::shadingNormalTexture). At first they do not.
    void setSmoothTerminator(bool isSmooth);
    const gl::Texture& shadingNormals() const { return shadingNormals_; }
    const gl::Texture& albedo() const { return albedo_; }
    const gl::Texture& emission() const { return emission_; }  ///< nits, RGBA32F

  private:
    void resize(int width_px, int height_px);

    InstanceConstants constantsOf(const GpuScene::Drawable& drawable, const CameraView& camera) const;
    void draw(gl::Pass& pass, const GpuScene& scene, const CameraView& camera, bool glass) const;

    gl::Program program_, glass_;
    gl::Texture depth_, geometricNormals_, shadingNormals_, albedo_, receivers_, emission_;
    gl::Framebuffer framebuffer_, glassFramebuffer_;
    View view_;
    bool hasSmoothTerminator_ = false;
};

}  // namespace penumbra::studio
