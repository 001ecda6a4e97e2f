// SPDX-License-Identifier: Apache-2.0
// What a luminaire sends in each direction, as its maker has measured it.
//
// Conventions: the luminaire hangs and shines down its own -Z. Metres, degrees, candela.
//   Type C: nadir (gamma 0) is -Z, C0 is +X, C90 is +Y: anticlockwise seen from above, as in Radiance and
//           EXT_lights_ies.
//   Type B: V = H = 0 is -Z, V = 90 is +X, H grows towards -Y (the polar axis lies along Y).
//   Type A: V = H = 0 is +X, V = -90 is -Z, H grows towards -Y (the polar axis is Z).
// Between the file's angles values are linear in both angles; outside its vertical range there is no light.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studio/scene/profiles/luminous_opening.h"

namespace penumbra::studio {

/// Candela over two angles. Horizontal angles stand for the C planes of type C and for H of types A and B.
struct CandelaGrid {
    enum class Type { A, B, C };
    Type type = Type::C;

    /// Strictly increasing, at least two. Type C: 0 to 180.
    std::vector<double> verticals_deg;

    /// Type C: angles beyond `firstPlane_deg`, from 0 to the span that the file covers: 0 (one plane: the
    /// same all around), 90 (a quarter, mirrored twice), 180 (a half, mirrored) or 360 (the last plane closes
    /// the circle). Types A and B: H itself; where the first is 0 the other side is its mirror image.
    std::vector<double> horizontals_deg;
    double firstPlane_deg = 0;

    /// One for each pair of angles, [horizontal * verticals + vertical]; at least 0.
    std::vector<float> candela;

    /// In a direction of any length but 0, in the luminaire's space.
    double at(const glm::dvec3& direction) const;

    float largest() const;

    /// Whether any light leaves above the horizontal plane, that of gamma = 90.
    bool shinesUp() const;

    /// Whether next to nothing leaves straight down or up, as from the side of an upright tube: at most a
    /// hundredth of the largest candela.
    bool isDarkAlongAxis() const;

    /// Lumens: the integral over the sphere of what at() gives, in closed form.
    double integral() const;

    /// "rotational", "four quadrants alike", ...
    std::string symmetry() const;
};

/// The direction of type C's angles.
glm::dvec3 directionOf(double gamma_deg, double c_deg);

struct LightProfile {
    std::string fileName;  ///< for messages
    std::string version;   ///< as a person says it: "LM-63-2002", "EULUMDAT"
    CandelaGrid grid;
    LuminousOpening opening;
    /// Of all lamps, as stated; unset where the file says that its candela are absolute. Scales nothing.
    std::optional<double> lampLumens;

    /// Lamps that give less as the luminaire is tilted: by how much, 1 as it hangs. Empty where they do not.
    struct TiltFactor {
        double tilt_deg, factor;
    };
    std::vector<TiltFactor> tiltFactors;  ///< by increasing tilt

    /// By what candela are multiplied where the luminaire's -Z is `tilt_deg` off straight down.
    double tiltFactor(double tilt_deg) const;

    std::string text;                   ///< the file's, for whoever saves the light
    std::vector<std::string> warnings;  ///< each names file and line
};

}  // namespace penumbra::studio
