// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/host_view.h"

#include <cmath>

#include "src/device/compatibility_state.h"
#include "src/device/glm_types.h"
#include "src/gl/texture_target.h"
#include "src/hosting/readings.h"
#include "src/hosting/stored_depth.h"

namespace penumbra {
namespace {

GLint levelParameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

bool isMultisampled(GLuint texture) {
    return gl::targetOf(texture) == GL_TEXTURE_2D_MULTISAMPLE;
}

glm::ivec2 sizeOf(GLuint texture) {
    return {levelParameter(texture, GL_TEXTURE_WIDTH), levelParameter(texture, GL_TEXTURE_HEIGHT)};
}

/// How far behind its surface a depth may seem to lie: a step of the format, and what floats have lost. That
/// is nothing near 0, where reversed depths are. Near 1, where the others are, each rounding is up to 2^-24
/// of depth, and there are six: of the host's matrix from mesh to clip space, of z there, of its share of w,
/// of its place between a triangle's corners, of the depth as a shader reads it, and of the shifted matrix.
/// (Those that llvmpipe draws are up to 3.8 * 2^-24 from where they should be.)
double depthError(GLuint texture, bool reversed) {
    const double ofFloats = reversed ? 0 : 6 * std::exp2(-24);
    // What is cut off a depth that is not reversed brings it nearer.
    const bool isOnlyNearer = !reversed && levelParameter(texture, GL_TEXTURE_DEPTH_SIZE) > bitsReadWhole;
    return isOnlyNearer ? ofFloats : ofFloats + fixedDepthStep(texture);
}

/// The camera whose clip space lies `shift` (in normalised device coordinates) away: a point that this one
/// sees at `ndc`, the result sees at ndc - shift.
Mat4 shifted(const Mat4& clipFromView, const glm::dvec3& shift) {
    Mat4 result = clipFromView;
    for (auto& column : result.columns) {
        for (std::size_t row = 0; row < 3; ++row)
            column[row] = float(column[row] - shift[int(row)] * column[3]);
    }
    return result;
}

/// Without what points do not have: positions in world space are seen from its origin.
View plainPoints(const View& view) {
    return {.width_px = view.width_px,
            .height_px = view.height_px,
            .depthTexture = view.depthTexture,
            .normalTexture = view.normalTexture,
            .receiverTexture = view.receiverTexture,
            .isOfPoints = true};
}

}  // namespace

ReadableTexture::ReadableTexture(GLuint texture)
    : texture_(texture),
      parameters_{{{GL_DEPTH_STENCIL_TEXTURE_MODE, GL_DEPTH_COMPONENT},
                   {GL_TEXTURE_SWIZZLE_R, GL_RED},
                   {GL_TEXTURE_SWIZZLE_G, GL_GREEN},
                   {GL_TEXTURE_SWIZZLE_B, GL_BLUE},
                   {GL_DEPTH_TEXTURE_MODE, GL_RED, Parameter::Of::compatibilityContexts},
                   {GL_TEXTURE_COMPARE_MODE, GL_NONE, Parameter::Of::singleSamples},
                   {GL_TEXTURE_MIN_FILTER, GL_NEAREST, Parameter::Of::singleSamples},
                   {GL_TEXTURE_BASE_LEVEL, 0, Parameter::Of::singleSamples}}} {
    for (Parameter& parameter : parameters_) parameter.found = parameter.needed;
    if (texture == 0) return;
    const bool multisampled = isMultisampled(texture), compatible = isCompatibilityContext();
    for (Parameter& parameter : parameters_) {
        if (parameter.of == Parameter::Of::singleSamples && multisampled) continue;
        if (parameter.of == Parameter::Of::compatibilityContexts && !compatible) continue;
        glGetTextureParameteriv(texture, parameter.name, &parameter.found);
        if (parameter.found != parameter.needed)
            glTextureParameteri(texture, parameter.name, parameter.needed);
    }
}

ReadableTexture::~ReadableTexture() {
    for (const Parameter& parameter : parameters_) {
        if (parameter.found != parameter.needed)
            glTextureParameteri(texture_, parameter.name, parameter.found);
    }
}

View HostView::prepare(const View& view, std::span<const Caster> casters) {
    if (view.isOfPoints) return plainPoints(view);
    View plain = view;
    glm::dvec3 shift(0);
    if (isMultisampled(view.depthTexture)) {
        // Techniques look at pixels' centres: there the sample is moved.
        shift = glm::dvec3(2.0 * (samplePlace(view) - 0.5) / glm::dvec2(view.width_px, view.height_px), 0);
    }
    // A depth stands for all that may have become it: the one nearest to the viewer is taken, so that no
    // surface lies behind itself. Without this, 24 bits speckle where techniques compare exactly.
    double error = depthError(view.depthTexture, view.depth.reversed);
    const bool hasOffset = view.polygonOffset != PolygonOffset{};
    // The slope that is taken away is the difference of two depths, each with an error of its own.
    if (hasOffset) error *= 1 + 2 * std::abs(double(view.polygonOffset.factor));
    shift.z = error * (view.depth.reversed ? 1 : -1) *
              (view.depth.range == DepthConvention::Range::minusOneToOne ? 2 : 1);
    if (shift != glm::dvec3(0)) plain.clipFromView = shifted(view.clipFromView, shift);
    plain.depthTexture = copied(view.depthTexture, depth_, gl::Format::r32f, view);
    plain.normalTexture = copied(view.normalTexture, normals_, gl::Format::rgba32f, view);
    if (hasOffset) {
        if (!offsetUndoing_) offsetUndoing_.emplace(device_);
        // The normals' copy is read by the same device's next pass.
        device_.shaders.order()->makeAllVisible();
        const bool needsCasters = plain.normalTexture == 0 && !casters.empty();
        const glm::dvec3 beside(shift.x, shift.y, 0);
        offsetUndoing_->run(
            plain, view, needsCasters ? &paint(casters, view, shifted(view.clipFromView, beside)) : nullptr);
    }
    if (view.shadingNormalTexture != 0) {
        if (!smoothSurface_) smoothSurface_.emplace(device_);
        plain.shadingNormalTexture =
            copied(view.shadingNormalTexture, shadingNormals_, gl::Format::rgba32f, view);
        device_.shaders.order()->makeAllVisible();
        smoothSurface_->run(plain);
    }
    plain.receiverTexture = copied(view.receiverTexture, receivers_, gl::Format::r8, view);
    // Techniques bind them by name, as they do a host's.
    if (plain.depthTexture != view.depthTexture || plain.normalTexture != view.normalTexture ||
        plain.receiverTexture != view.receiverTexture) {
        device_.shaders.order()->makeAllVisible();
    }
    plain.x_px = plain.y_px = plain.sample = 0;
    return plain;
}

const CasterPainter& HostView::paint(std::span<const Caster> casters, const View& view,
                                     const Mat4& clipFromView) {
    if (!casterPainter_ || casterPainter_->pixels().width_px() != view.width_px ||
        casterPainter_->pixels().height_px() != view.height_px)
        casterPainter_.emplace(device_, view.width_px, view.height_px);
    Reading reading = readingOf(view, casters);
    reading.clipFromView = toGlm(clipFromView);
    casterPainter_->paint(casters, reading);
    return *casterPainter_;
}

GLuint HostView::copied(GLuint texture, gl::Texture& copy, gl::Format format, const View& view) {
    if (texture == 0) return 0;
    const bool multisampled = isMultisampled(texture);
    const glm::ivec2 corner_px(view.x_px, view.y_px), size_px(view.width_px, view.height_px);
    if (!multisampled && corner_px == glm::ivec2(0) && sizeOf(texture) == size_px) return texture;

    if (!copy_) copy_.emplace(device_);
    if (copy.width_px() != size_px.x || copy.height_px() != size_px.y || copy.name() == 0) {
        copy = {};
        copy = gl::Texture(
            {.width_px = size_px.x, .height_px = size_px.y, .format = format, .label = "host's view"});
    }
    copy_->run({{.name = texture}, corner_px, multisampled, view.sample}, {copy.ref(), glm::ivec2(0)},
               size_px);
    return copy.name();
}

glm::dvec2 HostView::samplePlace(const View& view) {
    if (view.samplePlace) return {view.samplePlace->x, view.samplePlace->y};
    // Places are a framebuffer's to tell.
    if (samples_.name() == 0) {
        GLuint name = 0;
        glCreateFramebuffers(1, &name);
        samples_ = gl::Handle<gl::deleteFramebuffer>(name);
    }
    const bool isDepth = levelParameter(view.depthTexture, GL_TEXTURE_DEPTH_SIZE) > 0;
    const GLenum attachment = isDepth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0;
    glNamedFramebufferTexture(samples_.name(), attachment, view.depthTexture, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, samples_.name());
    std::array<GLfloat, 2> place = {0.5f, 0.5f};
    glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(view.sample), place.data());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glNamedFramebufferTexture(samples_.name(), attachment, 0, 0);  // the host's, not to be kept
    return {place[0], place[1]};
}

}  // namespace penumbra
