// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/view_constants.h"

#include <cmath>
#include <string>

#include "src/techniques/common/glm_types.h"
#include "src/techniques/common/visibility_internals.h"

namespace penumbra {
namespace {

void require(bool condition, const char* message) {
    if (!condition) throw Error(Error::Kind::badArgument, message);
}

bool isFinite(const Mat4& matrix) {
    for (const auto& column : matrix.columns) {
        for (const float value : column) {
            if (!std::isfinite(value)) return false;
        }
    }
    return true;
}

bool isRotation(const Mat4& matrix) {
    const glm::dmat3 rotation(toGlm(matrix));
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (std::abs(product[column][row] - (row == column ? 1.0 : 0.0)) > 1e-3) return false;
        }
    }
    return true;
}

bool isSize(float value) {
    return std::isfinite(value) && value >= 0;
}

}  // namespace

void checkInputs(const ShadowInputs& inputs, const VisibilityBuffer& out) {
    const View& view = inputs.view;
    require(view.width_px >= 1 && view.height_px >= 1, "View: width_px and height_px must be at least 1");
    require(view.depthTexture != 0, "View: depthTexture is missing");
    require(isFinite(view.viewFromWorld) && isFinite(view.clipFromView), "View: a matrix is not finite");
    require(glm::determinant(toGlm(view.clipFromView)) != 0, "View: clipFromView is not invertible");
    require(isRotation(view.viewFromWorld), "View: viewFromWorld is not a rotation and translation");
    require(out.width_px() == view.width_px && out.height_px() == view.height_px,
            "VisibilityBuffer: its size is not the view's");

    const AreaLight& light = inputs.light;
    require(isFinite(light.worldFromLight) && isRotation(light.worldFromLight),
            "AreaLight: worldFromLight is not a rotation and translation");
    require(isSize(light.width_m) && isSize(light.height_m) && isSize(light.radius_m),
            "AreaLight: width_m, height_m and radius_m must be finite and not negative");
    require(light.angle_rad >= 0 && light.angle_rad <= 3.1415927f,
            "AreaLight: angle_rad must lie in [0, pi]");
    require(light.radianceTexture == 0 || light.shape == LightShape::rect,
            "AreaLight: only rect lights may be textured");
    require(out.colored() == (light.radianceTexture != 0),
            "VisibilityBuffer: must be colored for a textured light, and for no other");
}

glm::dmat4 lightFromWorld(const ShadowInputs& inputs) {
    glm::dmat4 worldFromLight = toGlm(inputs.light.worldFromLight);
    if (inputs.light.shape == LightShape::distant) {
        glm::dvec3 sum(0);
        double count = 0;
        for (const Caster& caster : inputs.casters) {
            const Box& box = caster.mesh->bounds();
            if (box.min.x > box.max.x) continue;
            const glm::dvec3 centerMesh = 0.5 * (glm::dvec3(toGlm(box.min)) + glm::dvec3(toGlm(box.max)));
            sum += glm::dvec3(toGlm(caster.worldFromMesh) * glm::dvec4(centerMesh, 1));
            ++count;
        }
        worldFromLight[3] = {count > 0 ? sum / count : sum, 1};
    }
    return glm::inverse(worldFromLight);
}

void ViewBinding::fill(const View& view, const glm::dmat4& lightFromWorldMatrix) {
    const bool zeroToOne = view.depth.range == DepthConvention::Range::zeroToOne;
    const glm::dmat4 clipFromWorld = toGlm(view.clipFromView) * toGlm(view.viewFromWorld);
    // Nearness is depth, or what it lacks to 1; clip-space z is depth as it is, or from -1.
    const float depthScale = view.depth.reversed ? 1 : -1, depthOffset = view.depth.reversed ? 0 : 1;
    const float zScale = zeroToOne ? 1 : 2, zOffset = zeroToOne ? 0 : -1;
    glm::dmat4 clipFromPicture(1);
    clipFromPicture[2][2] = zScale * depthScale;
    clipFromPicture[3][2] = zScale * depthOffset + zOffset;
    constants_.write({
        .lightFromPicture = lightFromWorldMatrix * glm::inverse(clipFromWorld) * clipFromPicture,
        .lightFromWorld = lightFromWorldMatrix,
        .nearnessScale = depthScale,
        .nearnessOffset = depthOffset,
        .backgroundDepth = view.depth.reversed ? 0.0f : 1.0f,
        .hasNormals = view.normalTexture != 0,
        .size_px = {view.width_px, view.height_px},
        .hasReceiverMask = view.receiverTexture != 0,
    });
    depth_ = view.depthTexture;
    normals_ = view.normalTexture;
    receivers_ = view.receiverTexture;
}

void ViewBinding::bindTo(gl::Pass& pass) const {
    pass.bind("ViewBlock", constants_)
        .bind("viewDepth", gl::TextureRef{.name = depth_})
        .bind("viewNormals", gl::TextureRef{.name = normals_})
        .bind("viewReceivers", gl::TextureRef{.name = receivers_});
}

void ViewBinding::bind(const View& view, const glm::dmat4& lightFromWorldMatrix) {
    fill(view, lightFromWorldMatrix);
    constants_.bindUniform(0);
    glBindTextureUnit(0, view.depthTexture);
    glBindTextureUnit(1, view.normalTexture);
    glBindTextureUnit(2, view.receiverTexture);
}

gl::TextureRef imageOf(const VisibilityBuffer& out) {
    VisibilityBuffer::Internals& internals = out.internals();
    return {.name = out.texture(),
            .format = out.colored() ? gl::Format::rgba16f : gl::Format::r32f,
            .isLayered = false,
            .record = &internals.written};
}

void bindVisibility(const VisibilityBuffer& out, unsigned unit) {
    glBindImageTexture(unit, out.texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                       out.colored() ? GL_RGBA16F : GL_R32F);
}

std::vector<PassTime> passTimes(const gl::PassTimers& timers) {
    std::vector<PassTime> times;
    for (const auto& [name, milliseconds] : timers.latest()) times.push_back({name, milliseconds});
    return times;
}

}  // namespace penumbra
