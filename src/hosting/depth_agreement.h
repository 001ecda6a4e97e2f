// SPDX-License-Identifier: Apache-2.0
// How well a host's depths and a picture of its casters agree, in numbers. On the CPU alone.
#pragma once

#include <span>

#include "src/hosting/caster_picture.h"

namespace penumbra {

/// A host's depths, row by row from the bottom.
struct HostDepths {
    std::vector<float> values;
    float background = 0;
    double leastDifference = 0;  ///< that the format can hold, or floats near 1
};

struct Agreement {
    std::size_t surfaces = 0;  ///< pixels that show one, in the depths or by the casters
    std::size_t same = 0;      ///< of these, where both show the same one
    std::size_t missing = 0;   ///< the depths show one that is nearer than every caster, or where is none
    std::size_t extra = 0;     ///< a caster is nearer than the depths, or they show none
    double share() const { return surfaces == 0 ? 0 : double(same) / double(surfaces); }
};

/// Pixels at the edges of things count as the same: there nothing is known.
Agreement compare(const HostDepths& depths, const CasterPicture& picture, const Reading& reading);
/// Of the pixels that show one caster.
Agreement compareCaster(const HostDepths& depths, const CasterPicture& picture, const Reading& reading,
                        std::size_t caster);

/// What may move all depths a little.
enum class SmallDifference {
    offset,  ///< glPolygonOffset's: factor, and units (of 2^-24 at least)
    place,   ///< of what is seen, in pixels to the right and up
};

/// How much of it, by least squares over pixels inside of surfaces, without those that it does not explain.
struct TwoTerms {
    double first = 0, second = 0;
    /// Of the pixels inside of surfaces, those that it explains; 0 too where little is known.
    double share = 0;
};
TwoTerms fitTwoTerms(const HostDepths& depths, const CasterPicture& picture, const Reading& reading,
                     SmallDifference kind);

/// The straight line by which depths follow from the casters' (in perspective that is what another near or
/// far plane, or another convention, does): depth = slope * expected + offset.
struct DepthLine {
    double slope = 1, offset = 0;
    double share = 0;  ///< of the pixels where both show a surface, those on the line
};
DepthLine fitDepthLine(const HostDepths& depths, const CasterPicture& picture);

}  // namespace penumbra
