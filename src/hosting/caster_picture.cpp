// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/caster_picture.h"

#include <array>

#include "src/gl/pass.h"
#include "src/hosting/caster_picture_io.h"
#include "src/hosting/stored_depth.h"

namespace penumbra {

CasterPainter::CasterPainter(Device::Internals& device, int width_px, int height_px)
    : program_(device.shaders,
               {"src/hosting/caster_picture.vert.glsl", "src/hosting/caster_picture.frag.glsl"}),
      color_({.width_px = width_px,
              .height_px = height_px,
              .format = gl::Format::rgba32f,
              .label = "casters as the host should see them"}),
      slopes_({.width_px = width_px,
               .height_px = height_px,
               .format = gl::Format::rg32f,
               .label = "slopes of casters' depth"}),
      depth_({.width_px = width_px,
              .height_px = height_px,
              .format = gl::Format::depth32f,
              .label = "casters' depth"}) {
    framebuffer_.fit({&color_, &slopes_}, &depth_, "casters as the host should see them");
}

void CasterPainter::paint(std::span<const Caster> casters, const Reading& reading) {
    // Our clip space is from 0 to 1, in which depths lie as they are stored.
    const glm::dmat4 clipFromWorld =
        glm::inverse(clipFromStored(reading.depth)) * reading.clipFromView * reading.viewFromWorld;
    gl::Pass pass(program_);
    pass.into(framebuffer_, {.width_px = color_.width_px(),
                             .height_px = color_.height_px(),
                             .depthTest = reading.depth.reversed ? gl::Compare::greater : gl::Compare::less,
                             .depthWrite = true});
    pass.clearColor(0, std::array<float, 4>{0, 0, -1, 0})
        .clearColor(1, std::array<float, 4>{})
        .clearDepth(reading.depth.reversed ? 0 : 1);
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const Mesh& mesh = *casters[i].mesh;
        if (mesh.indices().empty()) continue;
        const AlphaMask& mask = casters[i].alphaMask;
        pass.constants(CasterPictureConstants{.clipFromMesh = clipFromWorld * reading.worldFromMesh[i],
                                              .caster = float(i),
                                              .alphaFactor = mask.factor,
                                              .alphaCutoff = mask.cutoff,
                                              .hasMask = mask.texture != 0})
            .bind("alphaTexture", gl::TextureRef{.name = mask.texture})
            .vertices("posMesh", {.buffer = mesh.positionBuffer()})
            .vertices("uvMesh", {.buffer = mesh.uvBuffer()})
            .indices(mesh.indexBuffer());
        pass.drawIndexed(mesh.indices().size());
    }
}

CasterPicture CasterPainter::draw(std::span<const Caster> casters, const Reading& reading) {
    paint(casters, reading);
    CasterPicture picture{color_.width_px(), color_.height_px(), {}};
    picture.pixels.resize(std::size_t(picture.width_px) * std::size_t(picture.height_px));
    color_.read(std::as_writable_bytes(std::span(picture.pixels)));
    return picture;
}

}  // namespace penumbra
