// SPDX-License-Identifier: Apache-2.0
#include "tests/random_scenes/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"

namespace penumbra::studio {
namespace {

constexpr float roomHeight = 3;
constexpr float illuminance_lux = 1000;

class Dice {
  public:
    Dice(std::uint64_t seed, int index) : engine_(seed * 0x9E3779B97F4A7C15u + std::uint64_t(index)) {}

    float between(float low, float high) {
        // By hand: the standard's distributions differ from library to library.
        return low + (high - low) * float(double(engine_() >> 11) * 0x1p-53);
    }
    /// Each order of magnitude as likely as another.
    float scaleBetween(float low, float high) { return std::exp(between(std::log(low), std::log(high))); }
    int below(int count) { return int(between(0, float(count))); }
    bool chance(float probability) { return between(0, 1) < probability; }

  private:
    std::mt19937_64 engine_;
};

Recipe::Part randomPart(Dice& dice, const Recipe& recipe) {
    constexpr float halfTurn = 3.14159265f;
    const float reach = std::min(0.4f * recipe.extent, 2.0f);
    Recipe::Part part{.shape = Recipe::Shape(dice.below(6)),
                      .place = {dice.between(-reach, reach), 0, dice.between(-reach, reach)},
                      .size = {dice.between(0.1f, 1), dice.between(0.1f, 1), dice.between(0.1f, 1)},
                      .turn_rad = dice.chance(0.5f) ? dice.between(-halfTurn, halfTurn) : 0.0f,
                      .mirrored = dice.chance(0.2f)};
    if (dice.chance(0.2f)) part.size[dice.below(3)] = 0.01f;  // slabs and posts
    if (dice.chance(0.3f)) part.place.y = dice.between(0.05f, 1);
    if (part.place.y > 0 && dice.chance(0.5f)) part.tilt_rad = dice.between(-1, 1);
    // In contact with the one before: on top of it, or side by side.
    if (!recipe.parts.empty() && dice.chance(0.3f)) {
        const Recipe::Part& other = recipe.parts.back();
        part.place = other.place;
        if (dice.chance(0.5f)) {
            part.place.y += other.size.y;
        } else {
            part.place.x += 0.5f * (other.size.x + part.size.x);
        }
    }
    return part;
}

Recipe::Lamp randomLamp(Dice& dice, const Recipe& recipe) {
    constexpr std::array shapes = {LightShape::rect, LightShape::disk, LightShape::sphere,
                                   LightShape::distant, LightShape::cylinder};
    Recipe::Lamp lamp{.shape = shapes[std::size_t(dice.below(int(shapes.size())))],
                      .aspect = dice.scaleBetween(0.25f, 1)};
    lamp.target = {dice.between(-0.5f, 0.5f), 0, dice.between(-0.5f, 0.5f)};
    if (recipe.setting == Recipe::Setting::room) {
        if (lamp.shape == LightShape::distant) lamp.shape = LightShape::rect;
        lamp.size_m = dice.between(0.1f, 1.2f);
        const bool isRound = lamp.shape == LightShape::sphere || lamp.shape == LightShape::cylinder;
        lamp.flush = !isRound && dice.chance(0.4f);
        const float half = 0.25f * recipe.extent;
        lamp.place = {dice.between(-half, half), roomHeight, dice.between(-half, half)};
        if (!lamp.flush) lamp.place.y -= (isRound ? lamp.size_m : 0) + dice.between(0.01f, 0.5f);
        lamp.target = lamp.place - glm::vec3(0, 1, 0);
        return lamp;
    }
    lamp.size_m =
        lamp.shape == LightShape::distant ? dice.scaleBetween(0.005f, 0.5f) : dice.scaleBetween(0.02f, 2);
    const float distance = dice.between(2.5f, 6) + lamp.size_m, angle = dice.between(-3, 3);
    lamp.place = distance * glm::vec3(0.7f * std::sin(angle), dice.between(0.4f, 1), 0.7f * std::cos(angle));
    lamp.place.y += lamp.size_m;
    return lamp;
}

Mesh meshOf(const Recipe::Part& part) {
    switch (part.shape) {
        case Recipe::Shape::box:
            return box(glm::vec3(1));
        case Recipe::Shape::sphere:
            return sphere(0.5f, 24, 12);
        case Recipe::Shape::cylinder:
            return cylinder(0.5f, 1, 24);
        case Recipe::Shape::cone:
            return cone(0.5f, 1, 24);
        case Recipe::Shape::torus:
            return torus(0.35f, 0.15f, 24, 12);
        case Recipe::Shape::sheet:
            return plane(1, 1, 3, 3);
    }
    return {};
}

std::string_view nameOf(Recipe::Shape shape) {
    constexpr std::array<std::string_view, 6> names = {"box", "sphere", "cylinder", "cone", "torus", "sheet"};
    return names[std::size_t(shape)];
}

std::string_view nameOf(LightShape shape) {
    switch (shape) {
        case LightShape::rect:
            return "rect";
        case LightShape::disk:
            return "disk";
        case LightShape::sphere:
            return "sphere";
        case LightShape::distant:
            return "distant";
        case LightShape::cylinder:
            return "cylinder";
    }
    return "";
}

/// Unit shapes are centred; their lowest point comes to rest at `place`.
glm::mat4 worldFromPart(const Recipe::Part& part, float scale) {
    glm::mat4 world = glm::scale(glm::mat4(1), glm::vec3(scale));
    world = glm::translate(world, part.place + glm::vec3(0, 0.5f * part.size.y, 0));
    world = glm::rotate(world, part.turn_rad, glm::vec3(0, 1, 0));
    world = glm::rotate(world, part.tilt_rad, glm::vec3(1, 0, 0));
    return glm::scale(world, part.size * glm::vec3(part.mirrored ? -1 : 1, 1, 1));
}

}  // namespace

Recipe randomRecipe(std::uint64_t seed, int index) {
    Dice dice(seed, index);
    Recipe recipe;
    recipe.setting = dice.chance(0.5f) ? Recipe::Setting::room : Recipe::Setting::ground;
    recipe.scale = dice.scaleBetween(1e-3f, 1e3f);
    recipe.extent = recipe.setting == Recipe::Setting::room ? dice.between(3, 8) : dice.scaleBetween(2, 1000);
    const int parts = 1 + dice.below(6);
    for (int i = 0; i < parts; ++i) recipe.parts.push_back(randomPart(dice, recipe));
    recipe.lamp = randomLamp(dice, recipe);
    const float angle = dice.between(-3, 3);
    const float away =
        recipe.setting == Recipe::Setting::room ? 0.4f * recipe.extent : dice.scaleBetween(1.5f, 20);
    recipe.eye = {away * std::sin(angle), dice.between(0.3f, 0.8f) * std::min(away, roomHeight),
                  away * std::cos(angle)};
    recipe.lookAt = {0, 0.2f, 0};
    return recipe;
}

Scene cook(const Recipe& recipe) {
    SceneBuilder builder("random");
    const float scale = recipe.scale;
    if (recipe.setting == Recipe::Setting::room) {
        const int walls = builder.mesh(
            "room", room(scale * glm::vec3(recipe.extent, roomHeight, recipe.extent)), glm::vec3(0.8f));
        builder.place("room", walls, at(glm::vec3(0, 0.5f * scale * roomHeight, 0)));
    } else {
        // It casts, too, as the grounds of other people's models do.
        const int ground =
            builder.mesh("ground", plane(scale * recipe.extent, scale * recipe.extent), glm::vec3(0.6f));
        builder.place("ground", ground, at(glm::vec3(0)));
    }
    for (const Recipe::Part& part : recipe.parts) {
        const int mesh = builder.mesh(std::string(nameOf(part.shape)), meshOf(part), glm::vec3(0.7f));
        const glm::mat4 world = worldFromPart(part, scale);
        builder.place("part", mesh, [world](double) { return world; });
    }
    const Recipe::Lamp& lamp = recipe.lamp;
    const glm::vec3 place = scale * lamp.place, target = scale * lamp.target;
    const float size_m = scale * lamp.size_m;
    switch (lamp.shape) {
        case LightShape::rect:
            builder.light(rectLight("lamp", size_m, lamp.aspect * size_m, place, target, illuminance_lux));
            break;
        case LightShape::disk:
            builder.light(diskLight("lamp", 0.5f * size_m, place, target, illuminance_lux));
            break;
        case LightShape::sphere:
            builder.light(sphereLight("lamp", 0.5f * size_m, place, target, illuminance_lux));
            break;
        case LightShape::cylinder:
            builder.light(
                tubeLight("lamp", size_m, 0.25f * lamp.aspect * size_m, place, target, illuminance_lux));
            break;
        case LightShape::distant:
            builder.light(
                distantLight("lamp", lamp.size_m, glm::normalize(lamp.target - lamp.place), illuminance_lux));
            break;
    }
    builder.camera(camera("eye", scale * recipe.eye, scale * recipe.lookAt));
    return std::move(builder).build();
}

std::string describe(const Recipe& recipe) {
    const auto triple = [](const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); };
    std::string text = fmt::format(
        "{} of {} units, 1 unit = {} m\n{}{} light of {} (aspect {}) at {} towards {}\neye at {} looks at "
        "{}\n",
        recipe.setting == Recipe::Setting::room ? "room" : "ground", recipe.extent, recipe.scale,
        recipe.lamp.flush ? "flush " : "", nameOf(recipe.lamp.shape), recipe.lamp.size_m, recipe.lamp.aspect,
        triple(recipe.lamp.place), triple(recipe.lamp.target), triple(recipe.eye), triple(recipe.lookAt));
    for (const Recipe::Part& part : recipe.parts) {
        text += fmt::format("{}{} of {} at {}, turned {} and tilted {} rad\n",
                            part.mirrored ? "mirrored " : "", nameOf(part.shape), triple(part.size),
                            triple(part.place), part.turn_rad, part.tilt_rad);
    }
    return text;
}

}  // namespace penumbra::studio
