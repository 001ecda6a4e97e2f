// SPDX-License-Identifier: Apache-2.0
// The part of a luminaire that shines.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "penumbra/light.h"

namespace penumbra::studio {

/// In metres, over all. The luminaire's X lies along C0, its Y along C90.
struct LuminousOpening {
    enum class Shape {
        point,
        rectangle,  ///< a box with luminous sides where it has a height
        circle,     ///< an ellipse where x and y differ, an upright cylinder where it has a height
        sphere,     ///< an ellipsoid where the three differ
        tubeAlongX,
        tubeAlongY,
        standing,  ///< a circle or ellipse in the YZ plane
    };
    Shape shape = Shape::point;
    double x_m = 0, y_m = 0, z_m = 0;

    /// "rectangle", "box", "circle", "ellipse", "upright cylinder", ...
    std::string name() const;
};

/// What numbers in a file mean, and what is odd about them.
struct OpeningReading {
    LuminousOpening opening;
    std::string warning;  ///< empty: nothing
};

/// LM-63 of `year` (1986, 1991, 1995, 2002 or 2019): width lies along C90, length along C0, and negative
/// numbers say that something is round, each version in its own way. Another version's way is understood,
/// with a warning; what is in no version's table is a point, with a warning.
OpeningReading readLm63Opening(int year, double width_m, double length_m, double height_m);

/// A light of the library.
struct NearestLight {
    AreaLight shape;
    glm::mat3 luminaireFromShape{1};  ///< a rotation that puts it where the opening is
    std::string note;                 ///< what is not as in the opening; empty: nothing
};

/// The light nearest to an opening, at the origin; flat ones shine along +Z as well where `up` says so, or
/// where they stand. An upright cylinder higher than wide is a tube where what it sends is `darkAlongAxis`,
/// as tubes' ends are, else a sphere.
NearestLight nearestLight(const LuminousOpening& opening, bool up, bool darkAlongAxis);

}  // namespace penumbra::studio
