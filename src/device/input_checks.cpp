// SPDX-License-Identifier: Apache-2.0
#include "src/device/input_checks.h"

#include <cmath>

#include "src/device/device_internals.h"
#include "src/device/glm_types.h"
#include "src/device/visibility_internals.h"
#include "src/gl/texture_target.h"

namespace penumbra {
namespace {

/// How far a rotation's columns may be from orthonormal: what products of float matrices lose, and more.
constexpr double rotationTolerance = 1e-3;

bool isFinite(const Mat4& matrix) {
    for (const auto& column : matrix.columns) {
        for (const auto value : column) {
            if (!std::isfinite(value)) return false;
        }
    }
    return true;
}

void requireRotation(const Mat4& matrix, const Argument& argument) {
    requireAffine(matrix, argument);
    const glm::dmat3 rotation(toGlm(matrix));
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (std::abs(product[column][row] - (row == column ? 1.0 : 0.0)) > rotationTolerance)
                refuse(argument, "is not a rotation and translation: leave scales out of it");
        }
    }
}

GLint levelParameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

bool isDepth(GLuint texture) {
    return levelParameter(texture, GL_TEXTURE_DEPTH_TYPE) != GL_NONE;
}

bool holdsIntegers(GLuint texture) {
    const GLint type = levelParameter(texture, GL_TEXTURE_RED_TYPE);
    return type == GL_INT || type == GL_UNSIGNED_INT;
}

[[noreturn]] void refuseName(GLuint texture, const Argument& argument) {
    refuse(argument, std::to_string(texture) +
                         " is no texture of the current context: give the name of one that exists, or 0");
}

/// A texture of a view's: of the right kind, and the picture lies in it.
void requirePictureTexture(GLuint texture, const Argument& argument, const View& view) {
    const GLenum target = gl::targetOf(texture);
    if (target == GL_NONE) refuseName(texture, argument);
    if (target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_MULTISAMPLE) {
        refuse(argument,
               "is neither GL_TEXTURE_2D nor GL_TEXTURE_2D_MULTISAMPLE: copy what it shows into one");
    }
    const GLint width_px = levelParameter(texture, GL_TEXTURE_WIDTH);
    const GLint height_px = levelParameter(texture, GL_TEXTURE_HEIGHT);
    if (view.x_px < 0 || view.y_px < 0 || view.width_px > width_px - view.x_px ||
        view.height_px > height_px - view.y_px) {
        refuse(argument, "is " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                             " and does not contain " + std::to_string(view.width_px) + "x" +
                             std::to_string(view.height_px) + " pixels from (" + std::to_string(view.x_px) +
                             ", " + std::to_string(view.y_px) +
                             "): set View::width_px, height_px, x_px and y_px to what lies in it");
    }
    if (target == GL_TEXTURE_2D_MULTISAMPLE &&
        (view.sample < 0 || view.sample >= levelParameter(texture, GL_TEXTURE_SAMPLES))) {
        refuse(argument, "has no sample " + std::to_string(view.sample) + ": it has 0 to " +
                             std::to_string(levelParameter(texture, GL_TEXTURE_SAMPLES) - 1));
    }
}

bool isSize(float value) {
    return std::isfinite(value) && value >= 0;
}

void checkLight(const AreaLight& light) {
    requireRotation(light.worldFromLight, "AreaLight: worldFromLight");
    if (!isSize(light.width_m) || !isSize(light.height_m) || !isSize(light.length_m) ||
        !isSize(light.radius_m))
        refuse("AreaLight:", "width_m, height_m, length_m and radius_m must be finite and not negative");
    // Written so that a NaN, which compares false with everything, is refused too.
    if (!(light.angle_rad >= 0 && light.angle_rad <= 3.1415927f))
        refuse("AreaLight:", "angle_rad must lie in [0, pi]: radians, not degrees");
    if (light.radianceTexture == 0) return;
    if (light.shape != LightShape::rect)
        refuse("AreaLight:", "only rect lights may be textured: set radianceTexture to 0");
    requireColorTexture(light.radianceTexture, "AreaLight: radianceTexture");
}

void checkOutput(const VisibilityBuffer& out, const View& view, const AreaLight& light,
                 std::span<const Caster> casters, const Device::Internals& device) {
    const VisibilityBuffer::Internals& internals = internalsOf(out);
    if (internals.device.get() != &device)
        refuse("VisibilityBuffer:",
               "it is of another device than the technique: make one on the same device");
    if (out.width_px() != view.width_px || out.height_px() != view.height_px) {
        refuse("VisibilityBuffer:", "it is " + std::to_string(out.width_px()) + "x" +
                                        std::to_string(out.height_px()) + " and the view " +
                                        std::to_string(view.width_px) + "x" + std::to_string(view.height_px) +
                                        ": call VisibilityBuffer::resize");
    }
    if (!out.colored() && light.radianceTexture != 0)
        refuse("VisibilityBuffer:", "the light has a texture: make the buffer with colored = true");
    if (!out.colored() && needsColor(light, casters))
        refuse("VisibilityBuffer:",
               "a caster lets a share of the light pass: make the buffer with colored = true");
    if (internals.host.texture == 0) return;
    if (gl::targetOf(internals.host.texture) != GL_TEXTURE_2D)
        refuse("VisibilityBuffer:",
               "the texture that it writes into does not exist any more: make another buffer");
    for (const GLuint read : {view.depthTexture, view.normalTexture, view.shadingNormalTexture,
                              view.receiverTexture, light.radianceTexture}) {
        if (read == internals.host.texture)
            refuse("VisibilityBuffer:",
                   "it writes into a texture that the view or the light reads: give it another");
    }
}

class Guard final : public ParameterVisitor {
  public:
    explicit Guard(ParameterVisitor& visitor) : visitor_(visitor) {}

    void boolean(const ParameterInfo& info, bool& value) override { visitor_.boolean(info, value); }
    void integer(const ParameterInfo& info, int& value, Range<int> range) override {
        const int before = value;
        visitor_.integer(info, value, range);
        check(info, value, before, range);
    }
    void real(const ParameterInfo& info, float& value, Range<float> range) override {
        const float before = value;
        visitor_.real(info, value, range);
        check(info, value, before, range);
    }
    void choice(const ParameterInfo& info, int& value, std::span<const std::string_view> names) override {
        const int before = value;
        visitor_.choice(info, value, names);
        check(info, value, before, Range<int>{0, int(names.size()) - 1});
    }

  private:
    template <typename T>
    static void check(const ParameterInfo& info, T& value, T before, const Range<T>& range) {
        if (value >= range.min && value <= range.max) return;  // false for a NaN
        const std::string wrong = std::to_string(value);
        value = before;
        refuse("parameter", "'" + std::string(info.name) + "' cannot be " + wrong +
                                "; it must be a number from " + std::to_string(range.min) + " to " +
                                std::to_string(range.max));
    }

    ParameterVisitor& visitor_;
};

}  // namespace

void refuse(const Argument& argument, const std::string& message) {
    throw Error(Error::Kind::badArgument, argument.text() + " " + message);
}

void requireAffine(const Mat4& matrix, const Argument& argument) {
    if (!isFinite(matrix)) refuse(argument, "is not finite");
    const auto& columns = matrix.columns;
    if (columns[0][3] != 0 || columns[1][3] != 0 || columns[2][3] != 0 || columns[3][3] != 1)
        refuse(argument,
               "has another last row than 0 0 0 1: is it transposed? It is stored column by column");
}

void requireColorTexture(std::uint32_t texture, const Argument& argument) {
    const GLenum target = gl::targetOf(texture);
    if (target == GL_NONE) refuseName(texture, argument);
    if (target != GL_TEXTURE_2D) refuse(argument, "is no GL_TEXTURE_2D: give one, or 0");
    if (isDepth(texture) || holdsIntegers(texture))
        refuse(argument, "holds depths or integers: give a texture with a format of colours, or 0");
}

namespace {

/// One that a shader reads texel by texel, as large as the view.
void requirePointTexture(GLuint texture, const Argument& argument, const View& view, bool isPositions) {
    const GLenum target = gl::targetOf(texture);
    if (target == GL_NONE) refuseName(texture, argument);
    const bool fits = target == GL_TEXTURE_2D && view.x_px == 0 && view.y_px == 0 &&
                      levelParameter(texture, GL_TEXTURE_WIDTH) == view.width_px &&
                      levelParameter(texture, GL_TEXTURE_HEIGHT) == view.height_px;
    if (!fits) refuse(argument, "is no GL_TEXTURE_2D of exactly the view's size, as those of points are");
    if (isPositions && levelParameter(texture, GL_TEXTURE_INTERNAL_FORMAT) != GL_RGBA32F)
        refuse(argument, "has not the format GL_RGBA32F, which points need");
}

void checkPoints(const View& view) {
    if (view.normalTexture == 0) refuse("View: normalTexture", "is missing: points have a normal each");
    requirePointTexture(view.depthTexture, "View: depthTexture", view, true);
    requirePointTexture(view.normalTexture, "View: normalTexture", view, false);
    if (view.receiverTexture != 0)
        requirePointTexture(view.receiverTexture, "View: receiverTexture", view, false);
}

void checkPicture(const View& view) {
    requireRotation(view.viewFromWorld, "View: viewFromWorld");
    if (!isFinite(view.clipFromView))
        refuse("View:", "clipFromView is not finite: give your camera's projection");
    if (glm::determinant(toGlm(view.clipFromView)) == 0)
        refuse("View:", "clipFromView is not invertible: give your camera's projection");

    if (view.depthTexture == 0)
        refuse("View:", "depthTexture is missing: give the texture that depth is drawn to");
    requirePictureTexture(view.depthTexture, "View: depthTexture", view);
    if (!isDepth(view.depthTexture) && levelParameter(view.depthTexture, GL_TEXTURE_RED_TYPE) != GL_FLOAT) {
        refuse("View:",
               "depthTexture has neither a depth format nor floats: colours are not taken for depths");
    }
    if (view.normalTexture != 0) {
        requirePictureTexture(view.normalTexture, "View: normalTexture", view);
        const GLint type = levelParameter(view.normalTexture, GL_TEXTURE_RED_TYPE);
        if ((type != GL_FLOAT && type != GL_SIGNED_NORMALIZED) ||
            levelParameter(view.normalTexture, GL_TEXTURE_BLUE_SIZE) == 0) {
            refuse("View:",
                   "normalTexture has no format of three signed channels, such as GL_RGBA16F or "
                   "GL_RGBA8_SNORM: give world-space normals in one, or 0");
        }
    }
    if (view.shadingNormalTexture != 0) {
        if (view.normalTexture == 0)
            refuse("View:",
                   "shadingNormalTexture needs a normalTexture beside it: give geometric normals, too");
        requirePictureTexture(view.shadingNormalTexture, "View: shadingNormalTexture", view);
        if (levelParameter(view.shadingNormalTexture, GL_TEXTURE_RED_TYPE) != GL_FLOAT ||
            levelParameter(view.shadingNormalTexture, GL_TEXTURE_ALPHA_SIZE) == 0) {
            refuse(
                "View:",
                "shadingNormalTexture has no format of four floats, such as GL_RGBA16F: give normals and, in "
                "alpha, the height of the smooth surface in one, or 0");
        }
    }
    if (view.receiverTexture != 0) {
        requirePictureTexture(view.receiverTexture, "View: receiverTexture", view);
        if (isDepth(view.receiverTexture) || holdsIntegers(view.receiverTexture)) {
            refuse("View:", "receiverTexture has no red channel of fractions: give one such as GL_R8, or 0");
        }
    }
}

}  // namespace

void checkView(const View& view) {
    if (view.width_px < 1 || view.height_px < 1) refuse("View:", "width_px and height_px must be at least 1");
    view.isOfPoints ? checkPoints(view) : checkPicture(view);
}

void checkFrame(const FrameInputs& frame, const Device::Internals& device) {
    checkView(frame.view);
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        const auto& [light, out, castsShadow] = frame.lights[i];
        const Argument argument("FrameInputs: lights", i, ".out");
        if (out == nullptr) refuse(argument, "is null: give each light a VisibilityBuffer");
        for (const FrameLight& before : frame.lights.first(i)) {
            if (before.out == out) refuse(argument, "is another light's, too: give each light its own");
        }
        checkLight(light);
        checkOutput(*out, frame.view, light, castsShadow ? frame.casters : std::span<const Caster>(), device);
    }
}

void describeGuarded(Technique& technique, ParameterVisitor& visitor) {
    Guard guard(visitor);
    technique.describe(guard);
}

}  // namespace penumbra
