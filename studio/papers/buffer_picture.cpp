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

/// Channel by channel. Depths of a map without a far plane lie close together near 0, far from anything a
/// screen could show as it is; a background (0, or whatever is not finite) must not take part.
void stretch(Image& image) {
    for (int channel = 0; channel < image.channels; ++channel) {
        std::vector<float> values;
        for (std::size_t i = std::size_t(channel); i < image.values.size();
             i += std::size_t(image.channels)) {
            if (image.values[i] != 0 && std::abs(image.values[i]) < 1e30f) values.push_back(image.values[i]);
        }
        if (values.empty()) values = {0, 1};
        std::ranges::sort(values);
        // What lies between 0 and 1 and uses most of it is shown as it is.
        const bool isShare = values.front() >= 0 && values.back() <= 1 && values.back() > 0.5f;
        const float low = isShare ? 0 : values[values.size() / 100];
        const float high = isShare ? 1 : values[values.size() - 1 - values.size() / 100];
        const float range = high > low ? high - low : 1;
        for (std::size_t i = std::size_t(channel); i < image.values.size();
             i += std::size_t(image.channels)) {
            const float value = image.values[i];
            const bool shown = value != 0 && std::abs(value) < 1e30f;
            // A tenth above black, so that the least value is told from the background.
            image.values[i] = shown ? std::clamp(0.1f + 0.9f * (value - low) / range, 0.0f, 1.0f) : 0;
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
    stretch(image);
    return image;
}

}  // namespace penumbra::studio
