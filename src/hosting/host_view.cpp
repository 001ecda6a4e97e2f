// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/host_view.h"

#include <cmath>
#include <string>

#include "src/techniques/common/glm_types.h"

namespace penumbra {
namespace {

[[noreturn]] void refuse(const std::string& message) {
    throw Error(Error::Kind::badArgument, "View: " + message);
}

GLint levelParameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

GLint targetOf(GLuint texture) {
    GLint target = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
    return target;
}

bool isMultisampled(GLuint texture) {
    return targetOf(texture) == GL_TEXTURE_2D_MULTISAMPLE;
}

glm::ivec2 sizeOf(GLuint texture) {
    return {levelParameter(texture, GL_TEXTURE_WIDTH), levelParameter(texture, GL_TEXTURE_HEIGHT)};
}

void checkTexture(const char* name, GLuint texture, const View& view) {
    if (!glIsTexture(texture)) {
        refuse(std::string(name) + " " + std::to_string(texture) + " is no texture of the current context");
    }
    const GLint target = targetOf(texture);
    if (target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_MULTISAMPLE) {
        refuse(std::string(name) + " is neither GL_TEXTURE_2D nor GL_TEXTURE_2D_MULTISAMPLE");
    }
    const glm::ivec2 size_px = sizeOf(texture);
    if (view.x_px < 0 || view.y_px < 0 || view.width_px > size_px.x - view.x_px ||
        view.height_px > size_px.y - view.y_px) {
        refuse(std::string(name) + " is " + std::to_string(size_px.x) + "x" + std::to_string(size_px.y) +
               " and does not contain " + std::to_string(view.width_px) + "x" +
               std::to_string(view.height_px) + " pixels from (" + std::to_string(view.x_px) + ", " +
               std::to_string(view.y_px) + ")");
    }
    if (target == GL_TEXTURE_2D_MULTISAMPLE &&
        (view.sample < 0 || view.sample >= levelParameter(texture, GL_TEXTURE_SAMPLES))) {
        refuse(std::string(name) + " has no sample " + std::to_string(view.sample));
    }
}

/// How far behind its surface a depth may seem to lie: a step of the format, and what floats have lost. That
/// is nothing near 0, where reversed depths are. Near 1, where the others are, each rounding is up to 2^-24
/// of depth, and there are six: of the host's matrix from mesh to clip space, of z there, of its share of w,
/// of its place between a triangle's corners, of the depth as a shader reads it, and of the shifted matrix.
/// (Those that llvmpipe draws are up to 3.8 * 2^-24 from where they should be.)
double depthError(GLuint texture, bool reversed) {
    const double ofFloats = reversed ? 0 : 6 * std::exp2(-24);
    GLint type = GL_NONE;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_TYPE, &type);
    if (type != GL_UNSIGNED_NORMALIZED) return ofFloats;
    return ofFloats + std::exp2(-levelParameter(texture, GL_TEXTURE_DEPTH_SIZE));
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

}  // namespace

ReadableTexture::ReadableTexture(GLuint texture)
    : texture_(texture),
      parameters_{{{GL_DEPTH_STENCIL_TEXTURE_MODE, GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT},
                   {GL_TEXTURE_COMPARE_MODE, GL_NONE, GL_NONE},
                   {GL_TEXTURE_MIN_FILTER, GL_NEAREST, GL_NEAREST},
                   {GL_TEXTURE_BASE_LEVEL, 0, 0}}} {
    if (texture == 0) return;
    const bool hasSampling = !isMultisampled(texture);
    for (Parameter& parameter : parameters_) {
        if (!hasSampling && parameter.name != GL_DEPTH_STENCIL_TEXTURE_MODE) continue;
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

void checkTextures(const View& view) {
    if (view.width_px < 1 || view.height_px < 1) refuse("width_px and height_px must be at least 1");
    if (view.depthTexture == 0) refuse("depthTexture is missing");
    checkTexture("depthTexture", view.depthTexture, view);
    if (view.normalTexture != 0) checkTexture("normalTexture", view.normalTexture, view);
    if (view.receiverTexture != 0) checkTexture("receiverTexture", view.receiverTexture, view);
}

View HostView::prepare(const View& view) {
    View plain = view;
    glm::dvec3 shift(0);
    if (isMultisampled(view.depthTexture)) {
        // Techniques look at pixels' centres: there the sample is moved.
        shift = glm::dvec3(2.0 * (samplePlace(view) - 0.5) / glm::dvec2(view.width_px, view.height_px), 0);
    }
    // A depth stands for all that may have become it: the one nearest to the viewer is taken, so that no
    // surface lies behind itself. Without this, 24 bits speckle where techniques compare exactly.
    const double error = depthError(view.depthTexture, view.depth.reversed);
    shift.z = error * (view.depth.reversed ? 1 : -1) *
              (view.depth.range == DepthConvention::Range::minusOneToOne ? 2 : 1);
    if (shift != glm::dvec3(0)) plain.clipFromView = shifted(view.clipFromView, shift);
    plain.depthTexture = copied(view.depthTexture, depth_, gl::Format::r32f, view);
    plain.normalTexture = copied(view.normalTexture, normals_, gl::Format::rgba32f, view);
    plain.receiverTexture = copied(view.receiverTexture, receivers_, gl::Format::r8, view);
    plain.x_px = plain.y_px = plain.sample = 0;
    return plain;
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
