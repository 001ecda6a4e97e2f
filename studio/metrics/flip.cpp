// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// One channel of a picture.
using Plane = Image;
/// A filter of one dimension: an odd number of weights, the middle one for the pixel itself.
using Kernel = std::vector<float>;

// --- Colour spaces ---

// sRGB's primaries and D65 as in IEC 61966-2-1, in fractions, so that white is exactly (1, 1, 1) in the
// relative XYZ used below.
const glm::mat3 xyzFromRgb =
    glm::transpose(glm::mat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,  //
                             2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,    //
                             1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));

float linearFromSrgb(float value) {
    const float v = std::clamp(value, 0.0f, 1.0f);
    return v > 0.04045f ? std::pow((v + 0.055f) / 1.055f, 2.4f) : v / 12.92f;
}

/// XYZ relative to white, for every conversion of a picture.
struct ColorSpace {
    glm::vec3 white = xyzFromRgb * glm::vec3(1);
    glm::mat3 relativeFromRgb =
        glm::mat3(1 / white.x, 0, 0, 0, 1 / white.y, 0, 0, 0, 1 / white.z) * xyzFromRgb;
    glm::mat3 rgbFromRelative = glm::inverse(relativeFromRgb);
};

/// The linear opponent space in which the eye's contrast sensitivity is applied.
glm::vec3 ycxczFromRelative(const glm::vec3& xyz) {
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}
glm::vec3 relativeFromYcxcz(const glm::vec3& color) {
    const float y = (color.x + 16) / 116;
    return {y + color.y / 500, y, y - color.z / 200};
}

/// CIELAB with Hunt's adjustment: dark colours are less colourful.
glm::vec3 huntLabFromRelative(const glm::vec3& xyz) {
    const auto f = [](float t) {
        constexpr float delta = 6.0f / 29;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29;
    };
    const glm::vec3 root(f(xyz.x), f(xyz.y), f(xyz.z));
    const float lightness = 116 * root.y - 16;
    return {lightness, 0.01f * lightness * 500 * (root.x - root.y),
            0.01f * lightness * 200 * (root.y - root.z)};
}

// --- Filters ---

Kernel sampled(int radius, auto&& weightAt) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(weightAt(float(i)));
    return kernel;
}

float sumOf(const Kernel& kernel) {
    float sum = 0;
    for (const float weight : kernel) sum += weight;
    return sum;
}

/// Positive weights shall sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
    for (float& weight : kernel) weight /= weight > 0 ? positive : negative;
    return kernel;
}

Kernel normalized(Kernel kernel) {
    const float sum = sumOf(kernel);
    for (float& weight : kernel) weight /= sum;
    return kernel;
}

/// Filters rows and columns by one kernel each; the picture's edge pixels continue outside. Both passes go
/// along rows in memory, tap by tap, which compilers vectorise.
Plane filtered(const Plane& plane, const Kernel& alongX, const Kernel& alongY) {
    const int width = plane.width_px, height = plane.height_px;
    const int radiusX = int(alongX.size() / 2), radiusY = int(alongY.size() / 2);
    Plane rows(width, height, 1), result(width, height, 1);
    std::vector<float> padded(std::size_t(width + 2 * radiusX));
    for (int y = 0; y < height; ++y) {
        const float* source = &plane.values[std::size_t(y) * width];
        std::fill_n(padded.begin(), radiusX, source[0]);
        std::copy_n(source, width, padded.begin() + radiusX);
        std::fill_n(padded.begin() + radiusX + width, radiusX, source[width - 1]);
        float* target = &rows.values[std::size_t(y) * width];
        for (std::size_t tap = 0; tap < alongX.size(); ++tap) {
            const float weight = alongX[tap];
            for (int x = 0; x < width; ++x) target[x] += weight * padded[std::size_t(x) + tap];
        }
    }
    for (int y = 0; y < height; ++y) {
        float* target = &result.values[std::size_t(y) * width];
        for (int tap = -radiusY; tap <= radiusY; ++tap) {
            const float weight = alongY[std::size_t(tap + radiusY)];
            const float* source = &rows.values[std::size_t(std::clamp(y + tap, 0, height - 1)) * width];
            for (int x = 0; x < width; ++x) target[x] += weight * source[x];
        }
    }
    return result;
}

// --- Contrast sensitivity: the paper's spatial filtering ---

/// A channel's sensitivity is a sum of Gaussians exp(-b f^2) over the frequency; over x, in degrees, each is
/// a sqrt(pi / b) exp(-pi^2 x^2 / b).
struct Gaussian {
    float a, b;
};
const std::array<std::vector<Gaussian>, 3> sensitivities{{
    {{1, 0.0047f}},                    // achromatic
    {{1, 0.0053f}},                    // red-green
    {{34.1f, 0.04f}, {13.5f, 0.025f}}  // blue-yellow
}};

/// Filters by the sum of two-dimensional Gaussians, normalised as a whole. Each of them separates, their sum
/// does not.
Plane contrastFiltered(const Plane& plane, const std::vector<Gaussian>& gaussians, float pixelsPerDegree) {
    // Three standard deviations, sqrt(b / (2 pi^2)) degrees each, of the widest Gaussian of all.
    const int radius = int(std::ceil(3 * std::sqrt(0.04f / (2 * pi * pi)) * pixelsPerDegree));
    Plane sum(plane.width_px, plane.height_px, 1);
    float weightSum = 0;
    for (const auto& [a, b] : gaussians) {
        const Kernel kernel = sampled(
            radius, [&, b = b](float x) { return std::exp(-std::pow(pi * x / pixelsPerDegree, 2.0f) / b); });
        const float weight = a * std::sqrt(pi / b) * sumOf(kernel) * sumOf(kernel);
        const Plane part = filtered(plane, normalized(kernel), normalized(kernel));
        for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += weight * part.values[i];
        weightSum += weight;
    }
    for (float& value : sum.values) value /= weightSum;
    return sum;
}

/// A picture as the eye resolves it, and what its features are looked for in.
struct Perceived {
    std::vector<glm::vec3> huntLab;
    Plane achromatic;  // unfiltered, 0 (black) to 1 (white)
};

Perceived perceive(const Image& picture, const ColorSpace& space, float pixelsPerDegree) {
    const std::size_t count = picture.pixelCount();
    std::array<Plane, 3> opponent;
    opponent.fill(Plane(picture.width_px, picture.height_px, 1));
    Perceived perceived{std::vector<glm::vec3>(count), opponent[0]};
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 rgb;
        for (int c = 0; c < 3; ++c) {
            rgb[c] = linearFromSrgb(picture.values[i * picture.channels + (picture.channels == 1 ? 0 : c)]);
        }
        const glm::vec3 color = ycxczFromRelative(space.relativeFromRgb * rgb);
        for (int c = 0; c < 3; ++c) opponent[std::size_t(c)].values[i] = color[c];
        perceived.achromatic.values[i] = (color.x + 16) / 116;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        opponent[c] = contrastFiltered(opponent[c], sensitivities[c], pixelsPerDegree);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 color(opponent[0].values[i], opponent[1].values[i], opponent[2].values[i]);
        const glm::vec3 rgb = glm::clamp(space.rgbFromRelative * relativeFromYcxcz(color), 0.0f, 1.0f);
        perceived.huntLab[i] = huntLabFromRelative(space.relativeFromRgb * rgb);
    }
    return perceived;
}

/// City-block in lightness, Euclidean in colour.
float hyab(const glm::vec3& a, const glm::vec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

constexpr float colorExponent = 0.7f;  // q_c

/// The power of the colour difference, spread over [0, 1]: what is below p_c of the largest goes to [0, p_t].
float redistributed(float power, float largestPower) {
    constexpr float pc = 0.4f, pt = 0.95f;
    const float knee = pc * largestPower;
    return power < knee ? pt / knee * power : pt + (power - knee) / (largestPower - knee) * (1 - pt);
}

// --- Features: the paper's feature pipeline ---

struct Features {
    std::vector<float> edges, points;  // strength in each pixel
};

Features detectFeatures(const Plane& achromatic, float pixelsPerDegree) {
    constexpr float width_deg =
        0.082f;  // of the eye's edge detectors, peak to trough: two standard deviations
    const float deviation = 0.5f * width_deg * pixelsPerDegree;
    const int radius = int(std::ceil(3 * deviation));
    const auto gaussian = [&](float x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    const Kernel smooth = normalized(sampled(radius, gaussian));
    const Kernel edge = balanced(sampled(radius, [&](float x) { return -x * gaussian(x); }));
    const Kernel point = balanced(
        sampled(radius, [&](float x) { return (x * x / (deviation * deviation) - 1) * gaussian(x); }));

    const auto strength = [&](const Kernel& kernel) {
        const Plane x = filtered(achromatic, kernel, smooth), y = filtered(achromatic, smooth, kernel);
        std::vector<float> result(x.values.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
        }
        return result;
    };
    return {strength(edge), strength(point)};
}

}  // namespace

Image flipMap(const Image& reference, const Image& test, float pixelsPerDegree) {
    if (reference.width_px != test.width_px || reference.height_px != test.height_px) {
        throw InputError(fmt::format("cannot compare {} x {} pixels with {} x {}; render both at one size",
                                     reference.width_px, reference.height_px, test.width_px, test.height_px));
    }
    if (!(pixelsPerDegree > 0 && pixelsPerDegree <= 1000)) {
        throw InputError(
            fmt::format("{} pixels per degree: use more than 0 and at most 1000", pixelsPerDegree));
    }
    Image map(reference.width_px, reference.height_px, 1);
    if (map.pixelCount() == 0) return map;

    const ColorSpace space;
    const Perceived a = perceive(reference, space, pixelsPerDegree),
                    b = perceive(test, space, pixelsPerDegree);
    const Features featuresA = detectFeatures(a.achromatic, pixelsPerDegree);
    const Features featuresB = detectFeatures(b.achromatic, pixelsPerDegree);
    // No two colours differ more than green and blue.
    const float largestPower = std::pow(hyab(huntLabFromRelative(space.relativeFromRgb * glm::vec3(0, 1, 0)),
                                             huntLabFromRelative(space.relativeFromRgb * glm::vec3(0, 0, 1))),
                                        colorExponent);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const float color =
            redistributed(std::pow(hyab(a.huntLab[i], b.huntLab[i]), colorExponent), largestPower);
        const float feature = std::sqrt(std::numbers::sqrt2_v<float> / 2 *
                                        std::max(std::abs(featuresA.edges[i] - featuresB.edges[i]),
                                                 std::abs(featuresA.points[i] - featuresB.points[i])));
        map.values[i] = std::pow(color, 1 - feature);
    }
    return map;
}

double flip(const Image& reference, const Image& test, float pixelsPerDegree) {
    const Image map = flipMap(reference, test, pixelsPerDegree);
    double sum = 0;
    for (const float value : map.values) sum += value;
    return map.values.empty() ? 0 : sum / double(map.values.size());
}

}  // namespace penumbra::studio
