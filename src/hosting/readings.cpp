// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/readings.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "src/device/glm_types.h"

namespace penumbra {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;

dmat4 withTransposedRotation(const dmat4& matrix) {
    dmat4 result(glm::transpose(dmat3(matrix)));
    result[3] = matrix[3];
    return result;
}

dmat4 scaling(double x, double y, double z) {
    return glm::scale(dmat4(1), dvec3(x, y, z));
}

std::string conventionText(const DepthConvention& depth) {
    return std::string("the depths are of another convention than stated: set View::depth to {") +
           (depth.range == DepthConvention::Range::zeroToOne ? "zeroToOne" : "minusOneToOne") +
           ", reversed = " + (depth.reversed ? "true" : "false") + "}";
}

struct Unit {
    double scale;
    const char* text;
};
/// From the casters' unit to that of the view.
constexpr std::array<Unit, 10> units = {{{1000, "metres, the view's millimetres"},
                                         {0.001, "millimetres, the view's metres"},
                                         {100, "metres, the view's centimetres"},
                                         {0.01, "centimetres, the view's metres"},
                                         {10, "centimetres, the view's millimetres"},
                                         {0.1, "millimetres, the view's centimetres"},
                                         {1 / 0.3048, "metres, the view's feet"},
                                         {0.3048, "feet, the view's metres"},
                                         {1 / 0.0254, "metres, the view's inches"},
                                         {0.0254, "inches, the view's metres"}}};

}  // namespace

Reading readingOf(const View& view, std::span<const Caster> casters) {
    Reading reading{.viewFromWorld = toGlm(view.viewFromWorld),
                    .clipFromView = toGlm(view.clipFromView),
                    .worldFromMesh = {},
                    .depth = view.depth};
    for (const Caster& caster : casters) reading.worldFromMesh.push_back(toGlm(caster.worldFromMesh));
    return reading;
}

std::vector<OtherReading> otherReadings(const Reading& stated, int width_px, int height_px) {
    std::vector<OtherReading> others;
    const auto add = [&](std::string finding, auto change) {
        others.push_back({std::move(finding), stated});
        change(others.back().reading);
    };
    const auto addCasters = [&](std::string finding, auto change) {
        add(std::move(finding), [&](Reading& reading) {
            for (dmat4& matrix : reading.worldFromMesh) matrix = change(matrix);
        });
    };

    using Range = DepthConvention::Range;
    for (const Range range : {Range::zeroToOne, Range::minusOneToOne}) {
        for (const bool reversed : {false, true}) {
            const DepthConvention depth{range, reversed};
            if (depth.range == stated.depth.range && depth.reversed == stated.depth.reversed) continue;
            add(conventionText(depth), [&](Reading& reading) { reading.depth = depth; });
        }
    }
    add("the depths are upside down: their rows start at the top; draw or copy them as OpenGL has them, or "
        "negate the second row of View::clipFromView",
        [](Reading& reading) { reading.isUpsideDown = true; });
    add("the depths are mirrored from left to right: negate the first row of View::clipFromView",
        [](Reading& reading) { reading.clipFromView = scaling(-1, 1, 1) * reading.clipFromView; });
    add("View::viewFromWorld is the wrong way round (worldFromView): give its inverse",
        [](Reading& reading) { reading.viewFromWorld = glm::inverse(reading.viewFromWorld); });
    add("View::viewFromWorld's rotation is transposed: give it column by column (see Mat4::fromRows)",
        [](Reading& reading) { reading.viewFromWorld = withTransposedRotation(reading.viewFromWorld); });
    add("View::viewFromWorld looks along +Z: it must look along -Z; negate its first and third row",
        [](Reading& reading) { reading.viewFromWorld = scaling(-1, 1, -1) * reading.viewFromWorld; });
    add("View::viewFromWorld is left-handed: negate its third row",
        [](Reading& reading) { reading.viewFromWorld = scaling(1, 1, -1) * reading.viewFromWorld; });
    add("View::clipFromView is transposed: give it column by column (see Mat4::fromRows)",
        [](Reading& reading) { reading.clipFromView = glm::transpose(reading.clipFromView); });
    add("View::clipFromView is the wrong way round (viewFromClip): give its inverse",
        [](Reading& reading) { reading.clipFromView = glm::inverse(reading.clipFromView); });
    // A projection alone takes x and y for nothing but x and y.
    const dmat4& given = stated.clipFromView;
    const bool isProjection = given[0][3] == 0 && given[1][3] == 0 && given[0][1] == 0 && given[1][0] == 0;
    if (!isProjection) {
        add("View::clipFromView contains the view's matrix already: give the projection alone",
            [](Reading& reading) { reading.viewFromWorld = dmat4(1); });
    }
    const double aspect = double(width_px) / double(height_px);
    for (const bool ofWidth : {true, false}) {
        add("View::clipFromView is of another shape of picture: its width to height is not the view's",
            [&](Reading& reading) {
                dmat4& clip = reading.clipFromView;
                if (ofWidth) {
                    clip[0][0] = clip[1][1] / aspect;
                } else {
                    clip[1][1] = clip[0][0] * aspect;
                }
            });
    }

    addCasters("the casters' matrices are the wrong way round (meshFromWorld): give their inverses",
               [](const dmat4& matrix) {
                   return std::abs(glm::determinant(matrix)) > 0 ? glm::inverse(matrix) : matrix;
               });
    addCasters(
        "the casters' rotations are transposed: give their matrices column by column (see "
        "Mat4::fromRows)",
        withTransposedRotation);
    addCasters("the meshes are in world space already: leave Caster::worldFromMesh as it is made",
               [](const dmat4&) { return dmat4(1); });
    const dmat4 viewFromWorld = stated.viewFromWorld;
    addCasters("the casters' matrices contain the view's (viewFromMesh): give worldFromMesh",
               [&](const dmat4& matrix) { return glm::inverse(viewFromWorld) * matrix; });
    for (const double quarter : {-1.0, 1.0}) {
        addCasters("the casters have another axis up than the view: turn them or the view by 90 degrees",
                   [&](const dmat4& matrix) {
                       return glm::rotate(dmat4(1), quarter * glm::radians(90.0), dvec3(1, 0, 0)) * matrix;
                   });
    }
    for (const Unit& unit : units) {
        addCasters(std::string("the casters' lengths are ") + unit.text + ": use one unit for both",
                   [&](const dmat4& matrix) { return scaling(unit.scale, unit.scale, unit.scale) * matrix; });
        addCasters(std::string("the meshes' lengths are ") + unit.text +
                       ": put the scale into Caster::worldFromMesh",
                   [&](const dmat4& matrix) { return matrix * scaling(unit.scale, unit.scale, unit.scale); });
    }
    return others;
}

}  // namespace penumbra
