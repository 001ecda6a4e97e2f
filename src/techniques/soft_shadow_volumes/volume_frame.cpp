// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/volume_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <string_view>

#include "src/device/glm_types.h"
#include "src/geometry/capping.h"
#include "src/techniques/common/light_camera.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra::soft_shadow_volumes {
namespace {

/// Where all lines of sight meet, in view space: the point that clip space has at (0, 0, infinity). An
/// orthographic camera's is a direction, here the one towards the viewer.
glm::dvec4 eyeView(const View& view) {
    const glm::dvec4 eye = glm::inverse(toGlm(view.clipFromView)) * glm::dvec4(0, 0, 1, 0);
    if (std::abs(eye.w) > 1e-9 * glm::length(glm::dvec3(eye))) return eye / eye.w;
    if (eye.w != 0 && glm::dvec3(eye) == glm::dvec3(0)) return {0, 0, 0, 1};
    return {0, 0, 1, 0};
}

/// Clip space of the V-buffer: stored depths as in the view's depth texture, texel centres on pixel centres.
///
/// Texel i is at ndc' = 2 (i + 1/2) / m - 1, its pixel k i at ndc = 2 (k i + 1/2) / n - 1, hence
/// ndc = (k m / n) ndc' + (k m - k + 1) / n - 1.
glm::dmat4 bufferFromClip(const View& view, const glm::ivec2& size_px, int pixelsPerTexel) {
    glm::dmat4 matrix(1);
    const glm::ivec2 view_px(view.width_px, view.height_px);
    for (int axis = 0; axis < 2; ++axis) {
        const double scale = double(pixelsPerTexel) * size_px[axis] / view_px[axis];
        const double shift = (double(pixelsPerTexel) * (size_px[axis] - 1) + 1) / view_px[axis] - 1;
        matrix[axis][axis] = 1 / scale;
        matrix[3][axis] = -shift / scale;
    }
    if (view.depth.range == DepthConvention::Range::minusOneToOne) matrix[2][2] = matrix[3][2] = 0.5;
    return matrix;
}

/// How far from the eye the near plane reaches; infinite for orthographic views.
double nearReach_m(const View& view) {
    const glm::dmat4 viewFromClip = glm::inverse(toGlm(view.clipFromView));
    const bool zeroToOne = view.depth.range == DepthConvention::Range::zeroToOne;
    const double nearest = view.depth.reversed ? 1 : zeroToOne ? 0 : -1;
    double reach_m = 0;
    for (const glm::dvec2 corner :
         {glm::dvec2(-1, -1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(1, 1)}) {
        const glm::dvec4 posView = viewFromClip * glm::dvec4(corner, nearest, 1);
        reach_m = std::max(reach_m, glm::length(glm::dvec3(posView) / posView.w));
    }
    return eyeView(view).w == 0 ? std::numeric_limits<double>::infinity() : reach_m;
}

struct LightBox {
    glm::dvec3 low, high;
};

/// Around a mesh, in light space.
LightBox boxOf(const Mesh& mesh, const glm::dmat4& lightFromMesh) {
    const Box& box = mesh.bounds();
    LightBox result{glm::dvec3(std::numeric_limits<double>::max()),
                    glm::dvec3(-std::numeric_limits<double>::max())};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 posMesh((corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
                                 (corner & 4) ? box.max.z : box.min.z, 1);
        const glm::dvec3 posLight(lightFromMesh * posMesh);
        result.low = glm::min(result.low, posLight);
        result.high = glm::max(result.high, posLight);
    }
    return result;
}

/// No more than the distance from a point in light space to a mesh. Asked in the mesh's own space, where the
/// box of a floor is flat.
double leastDistance(const Mesh& mesh, const glm::dmat4& lightFromMesh, const glm::dvec4& light) {
    const glm::dmat4 meshFromLight = glm::inverse(lightFromMesh);
    const glm::dvec3 point(meshFromLight * light);
    const Box& box = mesh.bounds();
    const glm::dvec3 low(box.min.x, box.min.y, box.min.z), high(box.max.x, box.max.y, box.max.z);
    // What the way into the mesh's space stretches by at most: the square of the norm is the largest
    // eigenvalue of A^T A, and no eigenvalue is larger than a row's sum (Gershgorin).
    const glm::dmat3 gram = glm::transpose(glm::dmat3(meshFromLight)) * glm::dmat3(meshFromLight);
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        largest = std::max(largest, std::abs(gram[i][0]) + std::abs(gram[i][1]) + std::abs(gram[i][2]));
    return glm::distance(glm::clamp(point, low, high), point) / std::sqrt(largest);
}

}  // namespace

void describeOpenMeshes(ParameterVisitor& visitor, int& openMeshes) {
    static constexpr std::array<std::string_view, 2> choices = {"signed", "capped"};
    visitor.choice(
        {.name = "open_meshes",
         .help =
             "signed: an edge counts for the faces that end there, so that triangles alone block; capped: "
             "as published, holes are closed first, and block as well"},
        openMeshes, choices);
}

void AlphaMaskWarning::check(std::span<const Caster> casters) {
    if (said_) return;
    said_ = std::ranges::any_of(
        casters, [](const Caster& caster) { return caster.casts && caster.alphaMask.texture != 0; });
    if (said_) {
        log_.write(LogLevel::warning,
                   "shadow volumes: alpha-masked casters block light as if their masks had no holes; the "
                   "techniques of "
                   "shadow maps see the holes");
    }
}

VolumeFrame::VolumeFrame(const ShadowInputs& inputs, int pixelsPerTexel, Count count)
    : lightFromWorld(penumbra::lightFromWorld(inputs)) {
    const View& view = inputs.view;
    const AreaLight& light = inputs.light;
    const glm::ivec2 size_px((view.width_px + pixelsPerTexel - 1) / pixelsPerTexel,
                             (view.height_px + pixelsPerTexel - 1) / pixelsPerTexel);

    // A line of light is given a thousandth of its length for a width, so that areas can be divided by.
    glm::dvec2 half(0.5 * light.width_m, 0.5 * light.height_m);
    half = glm::max(half, glm::dvec2(1e-3 * std::max(half.x, half.y)));
    if (light.shape != LightShape::rect) half = glm::dvec2(light.radius_m);
    // What lies in a flat light's plane is not always exactly there.
    const double depth = light.shape == LightShape::sphere ? half.x : inPlane * std::max(half.x, half.y);
    const glm::dvec3 reach(half, depth);
    const auto isCut = [&](const LightBox& box) {
        return light.shape != LightShape::distant && glm::all(glm::lessThanEqual(box.low, reach)) &&
               glm::all(glm::greaterThanEqual(box.high, -reach));
    };
    const auto casts = [](const Caster& caster) { return caster.casts && !caster.mesh->indices().empty(); };

    // Lights are put into walls by their centres, and everything is counted from there: so that it lies
    // clearly on one side, a light that may be cut through is moved by less than a ten-thousandth of its
    // size; and one that may be flush with a face, to where it shines.
    double planeAt_m = 0;
    if (std::ranges::any_of(inputs.casters, [&](const Caster& caster) {
            return casts(caster) && isCut(boxOf(*caster.mesh, lightFromWorld * toGlm(caster.worldFromMesh)));
        })) {
        const bool isFlat = light.shape != LightShape::sphere;
        if (isFlat && count == Count::drawn) planeAt_m = 0.9 * depth;
        const glm::dvec3 off(double(inPlane) * half * glm::dvec2(0.618, 0.755),
                             isFlat ? planeAt_m : 0.211 * double(inPlane) * depth);
        lightFromWorld = glm::translate(glm::dmat4(1), off) * lightFromWorld;
    }

    const glm::dmat4 lightFromView = lightFromWorld * glm::inverse(toGlm(view.viewFromWorld));
    const glm::dvec4 eyeLight = lightFromView * eyeView(view);
    const double reach_m = nearReach_m(view);
    double highest_m = -std::numeric_limits<double>::max();
    for (const Caster& caster : inputs.casters) {
        if (!casts(caster)) continue;
        const SilhouetteSource source{caster.mesh, lightFromWorld * toGlm(caster.worldFromMesh)};
        const LightBox box = boxOf(*caster.mesh, source.lightFromMesh);
        highest_m = std::max(highest_m, box.high.z);
        if (count == Count::asked && caster.alphaMask.texture != 0 && caster.mesh->uvBuffer() != 0) {
            masked.push_back({source, caster.alphaMask});
            continue;
        }
        sources.push_back(source);
        layersEach.push_back(1);
        cutsLight.push_back(isCut(box));
        mayHide = mayHide || !(leastDistance(*caster.mesh, source.lightFromMesh, eyeLight) > reach_m);
    }

    constants.clipFromLight = bufferFromClip(view, size_px, pixelsPerTexel) * toGlm(view.clipFromView) *
                              glm::inverse(lightFromView);
    constants.eyeLight = eyeLight;
    constants.light = lightConstants(light);
    constants.buffer_px = size_px;
    constants.pixelsPerTexel = pixelsPerTexel;
    constants.isReversed = view.depth.reversed;
    constants.highest_m = float(highest_m);
    constants.plane_m = float(planeAt_m);
    if (light.shape != LightShape::distant) constants.light.halfSize = half;
}

void VolumeFrame::capHoles(Device::Internals& device) {
    for (SilhouetteSource& source : sources) {
        const Mesh& capped = cappedOf(device, *source.mesh);
        mayHide = mayHide || &capped != source.mesh;
        source.mesh = &capped;
    }
}

LightPoint VolumeFrame::center() const {
    return constants.light.shape == int(LightShape::distant) ? LightPoint(0, 0, 1, 0)
                                                             : LightPoint(0, 0, 0, 1);
}

void FrameBinding::fill(const View& view, const VolumeFrame& frame) {
    view_.fill(view, frame.lightFromWorld);
    constants_.write(frame.constants);
}

void FrameBinding::bindTo(gl::Pass& pass) const {
    pass.bind("VolumeBlock", constants_);
    if (pass.has("ViewBlock")) pass.bind(view_);
}

MeshConstants meshConstants(const VolumeFrame& frame, std::size_t index, std::size_t count) {
    MeshConstants constants{};
    constants.lightFromMesh = frame.sources[index].lightFromMesh;
    constants.count = uint(count);
    constants.cutsLight = frame.cutsLight[index];
    constants.layersEach = frame.layersEach[index];
    return constants;
}

void bindMesh(gl::Pass& pass, const Mesh& mesh) {
    pass.bind("Positions", gl::HostBuffer{mesh.positionBuffer()});
    pass.bind("Indices", gl::HostBuffer{mesh.indexBuffer()});
}

}  // namespace penumbra::soft_shadow_volumes
