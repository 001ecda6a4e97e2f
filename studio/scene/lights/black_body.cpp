// SPDX-License-Identifier: Apache-2.0
// CIE 1931 colour matching functions as fitted in C. Wyman, P.-P. Sloan, P. Shirley, Simple analytic
// approximations to the CIE XYZ color matching functions, JCGT 2(2), 2013.
#include "studio/scene/lights/black_body.h"

#include <cmath>

namespace penumbra::studio {
namespace {

/// A bell with another width on each side of its peak.
double bell(double wavelength_nm, double peak_nm, double left, double right) {
    const double t = (wavelength_nm - peak_nm) * (wavelength_nm < peak_nm ? left : right);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 matching(double nm) {
    return {0.362 * bell(nm, 442.0, 0.0624, 0.0374) + 1.056 * bell(nm, 599.8, 0.0264, 0.0323) -
                0.065 * bell(nm, 501.1, 0.0490, 0.0382),
            0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
            1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725)};
}

/// Planck's law, up to a factor.
double planck(double wavelength_nm, double temperature_K) {
    constexpr double secondRadiation_nmK = 1.438776877e7;
    return std::pow(wavelength_nm / 560, -5) /
           std::expm1(secondRadiation_nmK / (wavelength_nm * temperature_K));
}

}  // namespace

glm::vec3 blackBodyColor(float temperature_K) {
    glm::dvec3 xyz(0);
    for (int nm = 360; nm <= 830; nm += 5) xyz += planck(nm, temperature_K) * matching(nm);
    xyz /= xyz.y;
    const glm::dmat3 rec709FromXyz(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259,
                                   -0.4985314, 0.0415560, 1.0572252);
    const glm::dvec3 color = glm::max(rec709FromXyz * xyz, glm::dvec3(0));
    return glm::vec3(color / glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)));
}

}  // namespace penumbra::studio
