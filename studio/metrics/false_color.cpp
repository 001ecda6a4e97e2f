// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/false_color.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "studio/metrics/difference_image.h"

namespace penumbra::studio {
namespace {

/// Linear Rec. 709 from CIE L*C*h (CIE 15:2004, white D65).
glm::vec3 linearFromLch(float lightness, float chroma, float hue_rad) {
    const auto inverse = [](float f) {
        constexpr float delta = 6.0f / 29.0f;
        return f > delta ? f * f * f : 3 * delta * delta * (f - 4.0f / 29.0f);
    };
    const float fy = (lightness + 16) / 116;
    const float fx = fy + chroma * std::cos(hue_rad) / 500;
    const float fz = fy - chroma * std::sin(hue_rad) / 200;
    const glm::vec3 xyz(0.95047f * inverse(fx), inverse(fy), 1.08883f * inverse(fz));
    return {3.2406f * xyz.x - 1.5372f * xyz.y - 0.4986f * xyz.z,
            -0.9689f * xyz.x + 1.8758f * xyz.y + 0.0415f * xyz.z,
            0.0557f * xyz.x - 0.2040f * xyz.y + 1.0570f * xyz.z};
}

bool isShowable(const glm::vec3& linear) {
    return std::min({linear.r, linear.g, linear.b}) >= 0 && std::max({linear.r, linear.g, linear.b}) <= 1;
}

float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

template <typename ColorOf>
ColorTable tableOf(const ColorOf& colorOf) {
    ColorTable table;
    for (std::size_t i = 0; i < 256; ++i) {
        const std::array<float, 3> color = colorOf(float(i) / 255);
        for (std::size_t c = 0; c < 3; ++c) table[4 * i + c] = std::uint8_t(std::lround(255 * color[c]));
        table[4 * i + 3] = 255;
    }
    return table;
}

}  // namespace

std::array<float, 3> orderedColor(float t) {
    t = t >= 0 ? std::min(t, 1.0f) : 0.0f;  // a NaN counts as 0
    const float lightness = 14 + 80 * t;
    const float hue_rad = glm::radians(290 - 190 * t);
    // As colourful as the display allows, up to what keeps neighbours alike.
    float low = 0, high = 62;
    for (int i = 0; i < 20; ++i) {
        const float middle = 0.5f * (low + high);
        (isShowable(linearFromLch(lightness, middle, hue_rad)) ? low : high) = middle;
    }
    const glm::vec3 linear = glm::clamp(linearFromLch(lightness, low, hue_rad), 0.0f, 1.0f);
    return {encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b)};
}

ColorTable orderedColors() {
    return tableOf(orderedColor);
}

ColorTable divergingColors() {
    return tableOf([](float t) { return divergingColor(2 * t - 1); });
}

std::vector<float> niceLevels(float min, float max) {
    std::vector<float> levels;
    if (!(min > 0 && max >= min && std::isfinite(max))) return levels;
    for (int decade = int(std::floor(std::log10(min))); std::pow(10.0, decade) <= max; ++decade) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const float level = float(digit * std::pow(10.0, decade));
            if (level >= min && level <= max) levels.push_back(level);
        }
    }
    return levels;
}

ValueRange niceRange(float largest, bool logarithmic) {
    if (!(largest > 0) || !std::isfinite(largest)) return {logarithmic ? 1e-3f : 0.0f, 1};
    const std::vector<float> above = niceLevels(largest, 10 * largest);
    const float max = above.empty() ? largest : above.front();
    return {logarithmic ? 1e-3f * max : 0, max};
}

}  // namespace penumbra::studio
