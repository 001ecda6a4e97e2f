// SPDX-License-Identifier: Apache-2.0
#include "studio/papers/buffer_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/gl/gl.h"

namespace penumbra::studio {
namespace {

class Finder : public InspectionVisitor {
  public:
    explicit Finder(std::string_view name) : name_(name) {}
    void texture(const InspectedTexture& texture) override {
        if (!found && texture.name.find(name_) != std::string_view::npos) found = texture;
    }
    std::optional<InspectedTexture> found;

  private:
    std::string_view name_;
};

GLint levelParameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

bool isInteger(GLuint texture) {
    const GLint type = levelParameter(texture, GL_TEXTURE_RED_TYPE);
    return type == GL_INT || type == GL_UNSIGNED_INT;
}

/// Layer 0, rows from the top: one channel for depths and single values, else three.
Image readLayer(GLuint texture) {
    const GLint width = levelParameter(texture, GL_TEXTURE_WIDTH),
                height = levelParameter(texture, GL_TEXTURE_HEIGHT);
    const bool depth = levelParameter(texture, GL_TEXTURE_DEPTH_SIZE) > 0;
    const bool single = depth || levelParameter(texture, GL_TEXTURE_GREEN_SIZE) == 0;
    Image bottomUp(width, height, single ? 1 : 3);
    const GLenum format = depth                ? GL_DEPTH_COMPONENT
                          : isInteger(texture) ? GLenum(single ? GL_RED_INTEGER : GL_RGB_INTEGER)
                                               : GLenum(single ? GL_RED : GL_RGB);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    const auto bytes = GLsizei(bottomUp.values.size() * sizeof(float));
    if (isInteger(texture)) {
        std::vector<GLint> integers(bottomUp.values.size());
        glGetTextureSubImage(texture, 0, 0, 0, 0, width, height, 1, format, GL_INT, bytes, integers.data());
        std::ranges::transform(integers, bottomUp.values.begin(), [](GLint value) { return float(value); });
    } else {
        glGetTextureSubImage(texture, 0, 0, 0, 0, width, height, 1, format, GL_FLOAT, bytes,
                             bottomUp.values.data());
    }
    Image image(width, height, bottomUp.channels);
    const std::size_t row = std::size_t(width) * std::size_t(image.channels);
    for (std::size_t y = 0; y < std::size_t(height); ++y) {
        std::copy_n(&bottomUp.values[y * row], row, &image.values[(std::size_t(height) - 1 - y) * row]);
    }
    return image;
}

/// 0 and, of depths, 1 are background: black.
bool isBackground(float value, bool isDepth) {
    return value == 0 || (isDepth && value == 1) || !(std::abs(value) < 1e30f);
}

/// Channel by channel. Depths lie close together, far from anything a screen could show as it is; shares of 1
/// are shown as they are.
void stretch(Image& image, bool isDepth) {
    const auto channels = std::size_t(image.channels);
    for (std::size_t channel = 0; channel < channels; ++channel) {
        std::vector<float> values;
        for (std::size_t i = channel; i < image.values.size(); i += channels) {
            if (!isBackground(image.values[i], isDepth)) values.push_back(image.values[i]);
        }
        if (values.empty()) values = {0, 1};
        std::ranges::sort(values);
        const bool isShare = !isDepth && values.front() >= 0 && values.back() <= 1;
        const float low = isShare ? 0 : values[values.size() / 100];
        const float high = isShare ? 1 : values[values.size() - 1 - values.size() / 100];
        const float range = high > low ? high - low : 1;
        // Stretched values start a tenth above black, so that the least is told from the background.
        const float foot = isShare ? 0 : 0.1f;
        for (std::size_t i = channel; i < image.values.size(); i += channels) {
            const float value = image.values[i];
            image.values[i] = isBackground(value, isDepth)
                                  ? 0
                                  : std::clamp(foot + (1 - foot) * (value - low) / range, 0.0f, 1.0f);
        }
    }
}

}  // namespace

std::optional<Image> bufferPicture(const Technique& technique, std::string_view name) {
    Finder finder(name);
    technique.inspect(finder);
    if (!finder.found || finder.found->texture == 0) return std::nullopt;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    Image image = readLayer(finder.found->texture);
    stretch(image, levelParameter(finder.found->texture, GL_TEXTURE_DEPTH_SIZE) > 0);
    return image;
}

}  // namespace penumbra::studio
