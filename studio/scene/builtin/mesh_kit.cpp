// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/mesh_kit.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace penumbra::studio {
namespace {

/// Point `i` of `count` on the unit circle, counter-clockwise seen from +Y, starting at +Z. Equal arguments
/// give equal bits, so that separately made rings weld.
glm::vec3 onCircle(int i, int count) {
    const double angle = 2 * std::numbers::pi * (i % count) / count;
    return {float(std::sin(angle)), 0, float(std::cos(angle))};
}

std::uint32_t addVertex(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    return std::uint32_t(mesh.positions.size() - 1);
}

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Corners counter-clockwise.
void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    addTriangle(mesh, a, b, c);
    addTriangle(mesh, a, c, d);
}

/// A polygon around the Y axis at height `y_m`, facing up or down.
void addCap(Mesh& mesh, float radius_m, float y_m, int sides, float up) {
    const glm::vec3 normal(0, up, 0);
    const auto center = addVertex(mesh, {0, y_m, 0}, normal);
    for (int i = 0; i < sides; ++i)
        addVertex(mesh, radius_m * onCircle(i, sides) + glm::vec3(0, y_m, 0), normal);
    for (int i = 0; i < sides; ++i) {
        const auto a = center + 1 + i, b = center + 1 + (i + 1) % sides;
        if (up > 0)
            addTriangle(mesh, center, a, b);
        else
            addTriangle(mesh, center, b, a);
    }
}

}  // namespace

Mesh box(const glm::vec3& size_m) {
    Mesh mesh;
    const glm::vec3 half = 0.5f * size_m;
    for (int axis = 0; axis < 3; ++axis)
        for (float side : {-1.0f, 1.0f}) {
            // (u, v, normal) is right-handed, so that u then v runs counter-clockwise seen from outside.
            glm::vec3 normal(0), u(0), v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1;
            const auto corner = [&](float a, float b) {
                return addVertex(mesh, (normal + a * u + b * v) * half, normal);
            };
            const auto a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
            addQuad(mesh, a, b, c, d);
        }
    return mesh;
}

Mesh room(const glm::vec3& size_m) {
    Mesh mesh = box(size_m);
    for (glm::vec3& normal : mesh.normals) normal = -normal;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

Mesh sphere(float radius_m, int slices, int stacks) {
    Mesh mesh;
    const auto add = [&](const glm::vec3& direction) {
        return addVertex(mesh, radius_m * direction, direction);
    };
    const auto top = add({0, 1, 0});
    for (int ring = 1; ring < stacks; ++ring) {
        const double angle = std::numbers::pi * ring / stacks;
        for (int i = 0; i < slices; ++i)
            add(glm::normalize(float(std::sin(angle)) * onCircle(i, slices) +
                               glm::vec3(0, float(std::cos(angle)), 0)));
    }
    const auto bottom = add({0, -1, 0});

    const auto at = [&](int ring, int i) { return std::uint32_t(1 + (ring - 1) * slices + i % slices); };
    for (int i = 0; i < slices; ++i) {
        addTriangle(mesh, top, at(1, i), at(1, i + 1));
        for (int ring = 1; ring + 1 < stacks; ++ring)
            addQuad(mesh, at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1));
        addTriangle(mesh, bottom, at(stacks - 1, i + 1), at(stacks - 1, i));
    }
    return mesh;
}

Mesh torus(float ringRadius_m, float tubeRadius_m, int segments, int sides) {
    Mesh mesh;
    for (int segment = 0; segment < segments; ++segment)
        for (int side = 0; side < sides; ++side) {
            const glm::vec3 outward = onCircle(segment, segments);
            const glm::vec3 across = onCircle(side, sides);  // z: outward, x: up
            const glm::vec3 normal = glm::normalize(across.z * outward + glm::vec3(0, across.x, 0));
            addVertex(mesh, ringRadius_m * outward + tubeRadius_m * normal, normal);
        }
    const auto at = [&](int segment, int side) {
        return std::uint32_t(segment % segments * sides + side % sides);
    };
    for (int segment = 0; segment < segments; ++segment)
        for (int side = 0; side < sides; ++side)
            addQuad(mesh, at(segment, side), at(segment + 1, side), at(segment + 1, side + 1),
                    at(segment, side + 1));
    return mesh;
}

Mesh cylinder(float radius_m, float height_m, int sides, Ends ends) {
    Mesh mesh;
    const float half_m = 0.5f * height_m;
    for (float y_m : {-half_m, half_m})
        for (int i = 0; i < sides; ++i) {
            const glm::vec3 outward = onCircle(i, sides);
            addVertex(mesh, radius_m * outward + glm::vec3(0, y_m, 0), outward);
        }
    for (int i = 0; i < sides; ++i) {
        const std::uint32_t a = i, b = (i + 1) % sides;
        addQuad(mesh, a, b, b + sides, a + sides);
    }
    if (ends == Ends::closed) {
        addCap(mesh, radius_m, -half_m, sides, -1);
        addCap(mesh, radius_m, half_m, sides, 1);
    }
    return mesh;
}

Mesh cone(float radius_m, float height_m, int sides) {
    Mesh mesh;
    const float half_m = 0.5f * height_m;
    // The slope's normal leans up by radius : height. The tip has one vertex a side, each with its side's
    // normal.
    const auto slope = [&](const glm::vec3& outward) {
        return glm::normalize(height_m * outward + glm::vec3(0, radius_m, 0));
    };
    for (int i = 0; i < sides; ++i) {
        const glm::vec3 outward = onCircle(i, sides);
        addVertex(mesh, radius_m * outward + glm::vec3(0, -half_m, 0), slope(outward));
    }
    for (int i = 0; i < sides; ++i) {
        const auto tip = addVertex(mesh, {0, half_m, 0}, slope(onCircle(2 * i + 1, 2 * sides)));
        addTriangle(mesh, i, (i + 1) % sides, tip);
    }
    addCap(mesh, radius_m, -half_m, sides, -1);
    return mesh;
}

Mesh disk(float radius_m, int sides) {
    Mesh mesh;
    addCap(mesh, radius_m, 0, sides, 1);
    return mesh;
}

Mesh plane(float width_m, float depth_m, int columns, int rows) {
    Mesh mesh;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            addVertex(mesh,
                      {width_m * (float(column) / columns - 0.5f), 0, depth_m * (float(row) / rows - 0.5f)},
                      {0, 1, 0});
    const auto at = [&](int column, int row) { return std::uint32_t(row * (columns + 1) + column); };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            addQuad(mesh, at(column, row), at(column, row + 1), at(column + 1, row + 1), at(column + 1, row));
    return mesh;
}

Mesh flag(float size_m, float amplitude_m, float waves, int cells) {
    // The sheet is z = A x/s sin(kx - wt) = cos(wt) f(x) + sin(wt) g(x), with f = A x/s sin kx and g = -A x/s
    // cos kx. The normal of z(x) is along (-dz/dx, 0, 1), which is linear in f and g too, up to its length.
    const float k = 2 * std::numbers::pi_v<float> * waves / size_m;
    const float slope = amplitude_m / size_m;
    Mesh mesh;
    MorphTarget cosine, sine;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const float x = size_m * float(column) / cells, s = std::sin(k * x), c = std::cos(k * x);
            addVertex(mesh, {x, size_m * (float(row) / cells - 0.5f), 0}, {0, 0, 1});
            cosine.positionDeltas.emplace_back(0, 0, slope * x * s);
            cosine.normalDeltas.emplace_back(-slope * (s + k * x * c), 0, 0);
            sine.positionDeltas.emplace_back(0, 0, -slope * x * c);
            sine.normalDeltas.emplace_back(slope * (c - k * x * s), 0, 0);
        }
    const auto at = [&](int column, int row) { return std::uint32_t(row * (cells + 1) + column); };
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column)
            addQuad(mesh, at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1));
    mesh.morphTargets = {std::move(cosine), std::move(sine)};
    mesh.morphWeights = {1, 0};
    return mesh;
}

}  // namespace penumbra::studio
