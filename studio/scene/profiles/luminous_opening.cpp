// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/luminous_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace penumbra::studio {
namespace {

using Shape = LuminousOpening::Shape;

/// Of a number in the file.
enum class Sign { minus, none, plus };
using enum Sign;

Sign signOf(double value) {
    return value < 0 ? minus : value > 0 ? plus : none;
}

/// A row of a version's table: the signs of width, length and height, and what they mean. A length of none
/// beside a round width is a second diameter left out.
struct Row {
    Sign width, length, height;
    Shape shape;
};

constexpr Row common[] = {
    {none, none, none, Shape::point},     {plus, plus, none, Shape::rectangle},
    {plus, plus, plus, Shape::rectangle}, {plus, none, plus, Shape::rectangle},
    {none, plus, plus, Shape::rectangle},
};
constexpr Row of1986[] = {
    {minus, none, none, Shape::circle},
    {minus, none, plus, Shape::circle},
    {minus, plus, none, Shape::circle},
    {minus, plus, plus, Shape::circle},
};
constexpr Row of1995[] = {
    {minus, none, none, Shape::circle},     {minus, none, plus, Shape::circle},
    {minus, plus, none, Shape::circle},     {plus, minus, none, Shape::circle},
    {minus, plus, plus, Shape::circle},     {plus, minus, plus, Shape::circle},
    {minus, none, minus, Shape::sphere},    {minus, plus, minus, Shape::sphere},
    {plus, minus, minus, Shape::sphere},    {none, plus, minus, Shape::tubeAlongX},
    {plus, none, minus, Shape::tubeAlongY},
};
constexpr Row of2002[] = {
    {minus, minus, none, Shape::circle},     {minus, minus, plus, Shape::circle},
    {minus, minus, minus, Shape::sphere},    {minus, plus, minus, Shape::tubeAlongX},
    {plus, minus, minus, Shape::tubeAlongY}, {minus, none, minus, Shape::standing},
};

struct Table {
    const char* versions;
    std::span<const Row> rows;
};
constexpr Table oldest{"1986 and 1991", of1986}, middle{"1995", of1995}, newest{"2002 and 2019", of2002};

const Row* find(std::span<const Row> rows, Sign width, Sign length, Sign height) {
    const auto found = std::ranges::find_if(rows, [&](const Row& row) {
        return row.width == width && row.length == length && row.height == height;
    });
    return found == rows.end() ? nullptr : &*found;
}

LuminousOpening sized(Shape shape, double width_m, double length_m, double height_m) {
    LuminousOpening opening{shape, std::abs(length_m), std::abs(width_m), std::abs(height_m)};
    const bool round = shape == Shape::circle || shape == Shape::sphere;
    if (round && opening.x_m == 0) opening.x_m = opening.y_m;
    if (shape == Shape::tubeAlongX && opening.y_m == 0) opening.y_m = opening.z_m;
    if (shape == Shape::tubeAlongY && opening.x_m == 0) opening.x_m = opening.z_m;
    return opening;
}

/// Axes of shapes in the luminaire's space that do not lie in it as they are.
constexpr glm::mat3 alongY({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
constexpr glm::mat3 upright({0, 0, 1}, {0, 1, 0}, {-1, 0, 0});
constexpr glm::mat3 facingX({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
constexpr glm::mat3 facingY({1, 0, 0}, {0, 0, 1}, {0, -1, 0});

/// Half the diameter of the circle of an ellipse's area.
double meanRadius(double a_m, double b_m) {
    return 0.5 * std::sqrt(a_m * b_m);
}

}  // namespace

std::string LuminousOpening::name() const {
    switch (shape) {
        case Shape::point:
            return "point";
        case Shape::rectangle:
            if (x_m == 0 || y_m == 0) return "standing rectangle";
            return z_m > 0 ? "box" : "rectangle";
        case Shape::circle:
            if (z_m > 0) return x_m == y_m ? "upright cylinder" : "upright elliptical cylinder";
            return x_m == y_m ? "circle" : "ellipse";
        case Shape::sphere:
            return x_m == y_m && x_m == z_m ? "sphere" : "ellipsoid";
        case Shape::tubeAlongX:
            return "cylinder along C0";
        case Shape::tubeAlongY:
            return "cylinder along C90";
        case Shape::standing:
            return y_m == z_m ? "standing circle" : "standing ellipse";
    }
    return "";
}

OpeningReading readLm63Opening(int year, double width_m, double length_m, double height_m) {
    const Sign width = signOf(width_m), length = signOf(length_m), height = signOf(height_m);
    const Table& own = year < 1995 ? oldest : year < 2002 ? middle : newest;
    for (const std::span<const Row> rows : {std::span<const Row>(common), own.rows})
        if (const Row* row = find(rows, width, length, height))
            return {sized(row->shape, width_m, length_m, height_m), ""};
    const std::string numbers =
        fmt::format("a luminous opening of {:.4g} x {:.4g} x {:.4g} m (width, length, height)", width_m,
                    length_m, height_m);
    for (const Table& other : {middle, newest, oldest})
        if (const Row* row = find(other.rows, width, length, height)) {
            const LuminousOpening opening = sized(row->shape, width_m, length_m, height_m);
            return {opening, fmt::format("{} is not in LM-63-{}'s table; taken for that of {}: {}", numbers,
                                         year, other.versions, opening.name())};
        }
    return {{}, fmt::format("{} is in no version's table of LM-63; taken for a point", numbers)};
}

NearestLight nearestLight(const LuminousOpening& opening, bool up, bool darkAlongAxis) {
    NearestLight nearest;
    AreaLight& light = nearest.shape;
    const auto flat = [&](double x_m, double y_m, bool twoSided) {
        light.shape = LightShape::rect;
        light.width_m = float(x_m);
        light.height_m = float(y_m);
        light.twoSided = twoSided;
    };
    const auto disk = [&](double radius_m, bool twoSided) {
        light.shape = LightShape::disk;
        light.radius_m = float(radius_m);
        light.twoSided = twoSided;
    };
    const auto sphere = [&](double radius_m) {
        light.shape = LightShape::sphere;
        light.radius_m = float(radius_m);
    };
    const auto say = [&](const std::string& as) {
        nearest.note = fmt::format("its luminous opening, {} {:.4g} x {:.4g} x {:.4g} m, is taken for {}",
                                   opening.name(), opening.x_m, opening.y_m, opening.z_m, as);
    };
    const auto tube = [&](double length_m, double across_m, double high_m) {
        light.shape = LightShape::cylinder;
        light.length_m = float(length_m);
        light.radius_m = float(meanRadius(across_m, high_m));
        if (across_m != high_m) say("a round tube of the same area across");
    };
    switch (opening.shape) {
        case Shape::point:
            sphere(0);
            break;
        case Shape::rectangle:
            if (opening.x_m == 0) {
                flat(opening.y_m, opening.z_m, true);
                nearest.luminaireFromShape = facingX;
            } else if (opening.y_m == 0) {
                flat(opening.x_m, opening.z_m, true);
                nearest.luminaireFromShape = facingY;
            } else {
                flat(opening.x_m, opening.y_m, up);
                if (opening.z_m > 0) say("a rectangle without sides");
            }
            break;
        case Shape::circle: {
            const double radius_m = meanRadius(opening.x_m, opening.y_m);
            if (opening.z_m > 2 * radius_m && darkAlongAxis) {
                tube(opening.z_m, opening.x_m, opening.y_m);
                nearest.luminaireFromShape = upright;
                break;
            }
            if (opening.z_m > 2 * radius_m) {
                // The sphere that on average over all directions shows as much: a quarter of the surface.
                const double surface_m2 = 2 * std::numbers::pi * radius_m * (radius_m + opening.z_m);
                sphere(std::sqrt(0.25 * surface_m2 / std::numbers::pi));
                say("a sphere");
                break;
            }
            disk(radius_m, up);
            if (opening.z_m > 0 || opening.x_m != opening.y_m) say("a disk of the same area");
            break;
        }
        case Shape::sphere:
            sphere(0.5 * std::cbrt(opening.x_m * opening.y_m * opening.z_m));
            if (opening.name() != "sphere") say("a sphere of the same volume");
            break;
        case Shape::tubeAlongX:
            tube(opening.x_m, opening.y_m, opening.z_m);
            break;
        case Shape::tubeAlongY:
            tube(opening.y_m, opening.x_m, opening.z_m);
            nearest.luminaireFromShape = alongY;
            break;
        case Shape::standing:
            disk(meanRadius(opening.y_m, opening.z_m), true);
            nearest.luminaireFromShape = facingX;
            if (opening.y_m != opening.z_m) say("a disk of the same area");
            break;
    }
    return nearest;
}

}  // namespace penumbra::studio
