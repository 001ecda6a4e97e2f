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
/// keep their zero.
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
        const float high = values[values.size() - 1 - values.size() / 100];
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

/// The smallest part of the shape of `shape` around all that is not black, with a margin; black where it
/// reaches out of the picture.
Image cropped(const Image& image, PictureSize shape) {
    int left = image.width_px, top = image.height_px, right = 0, bottom = 0;
    for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
            float largest = 0;
            for (int channel = 0; channel < image.channels; ++channel)
                largest = std::max(largest, image.at(x, y, channel));
            if (largest == 0) continue;
            left = std::min(left, x), right = std::max(right, x + 1);
            top = std::min(top, y), bottom = std::max(bottom, y + 1);
        }
    }
    if (left >= right) return image;
    constexpr float margin = 1.15f;
    const float aspect = float(shape.width_px) / float(shape.height_px);
    const float height = margin * std::max(float(bottom - top), float(right - left) / aspect);
    Image part(std::max(int(height * aspect), 1), std::max(int(height), 1), image.channels);
    const int x0 = (left + right - part.width_px) / 2, y0 = (top + bottom - part.height_px) / 2;
    for (int y = std::max(y0, 0); y < std::min(y0 + part.height_px, image.height_px); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x0 + part.width_px, image.width_px); ++x) {
            for (int channel = 0; channel < image.channels; ++channel)
                part.at(x - x0, y - y0, channel) = image.at(x, y, channel);
        }
    }
    return part;
}

}  // namespace

std::optional<Image> bufferPicture(const Technique& technique, std::string_view name, PictureSize shape) {
    Finder finder(name);
    technique.inspect(finder);
    if (!finder.found || finder.found->texture == 0) return std::nullopt;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    Image image = readLayer(finder.found->texture);
    stretch(image, levelParameter(finder.found->texture, GL_TEXTURE_DEPTH_SIZE) > 0);
    const bool isOfView = image.width_px * shape.height_px == image.height_px * shape.width_px;
    return isOfView ? image : cropped(image, shape);
}

}  // namespace penumbra::studio
