// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/light_points.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <span>
#include <vector>

namespace penumbra::soft_shadow_volumes {
namespace {

/// Points that fill the unit square or disk evenly, none on a line with many others: whatever edge crosses
/// the light meets them one after the other.
std::vector<glm::vec4> spreadPoints(int count, bool onSquare) {
    const double golden = glm::golden_ratio<double>() - 1;
    std::vector<glm::vec4> points;
    for (int i = 0; i < count; ++i) {
        const double along = (i + 0.5) / count;
        const double turn = (i + 0.5) * golden - std::floor((i + 0.5) * golden);
        glm::dvec2 place(2 * along - 1, 2 * turn - 1);
        if (!onSquare) {
            place = std::sqrt(along) * glm::dvec2(std::cos(glm::two_pi<double>() * turn),
                                                  std::sin(glm::two_pi<double>() * turn));
        }
        const double direction = std::atan2(place.y, place.x) / glm::two_pi<double>();
        points.emplace_back(place, along, direction - std::floor(direction));
    }
    // Edges look up the points behind them by direction.
    std::ranges::sort(points, {}, &glm::vec4::w);
    return points;
}

/// What stands for a part of a picture does worse than what stands for a part of an area.
constexpr int texturedFactor = 2;

constexpr int tableColumns = 512, tableRows = 129;  // as light_table.glsl has it

}  // namespace

LightPoints::LightPoints(Device& device)
    : radiance_(internalsOf(device).shaders, {"src/techniques/soft_shadow_volumes/soft_radiance.comp.glsl"}),
      makeTable_(internalsOf(device).shaders, {"src/techniques/soft_shadow_volumes/light_table.comp.glsl"}),
      table_({.width_px = tableColumns,
              .height_px = tableRows,
              .format = gl::Format::rgba32f,
              .filter = gl::Filter::linear,
              .wrap = gl::Wrap::repeat,
              .label = "soft-volumes/light table"}) {}

void LightPoints::place(const AreaLight& light, const FrameBinding& binding, int count) {
    const bool onSquare = light.shape == LightShape::rect, isTextured = light.radianceTexture != 0;
    const int wanted = isTextured ? std::min(texturedFactor * count, most) : count;
    if (count_ != wanted || onSquare_ != onSquare) {
        const std::vector<glm::vec4> places = spreadPoints(wanted, onSquare);
        places_ = gl::Buffer(std::as_bytes(std::span(places)), "soft-volumes/points");
        radiances_ = gl::Buffer(std::as_bytes(std::span(places)), "soft-volumes/radiances");
        count_ = wanted;
        onSquare_ = onSquare;
    }
    if (!isTextured) return;
    const gl::TextureRef picture{.name = light.radianceTexture};
    gl::Pass(radiance_)
        .bind(binding)
        .constants(PointsConstants{.count = count_})
        .bind(binding)
        .bind("Samples", places_)
        .bind("Radiances", radiances_)
        .bind("radiance", picture)
        .dispatch(std::size_t(count_ + 63) / 64);
    gl::Pass pass(makeTable_);
    pass.bind(binding).bind("radiance", picture).bind("table", table_).dispatch(1);
}

void LightPoints::bindTo(gl::Pass& pass) const {
    if (pass.has("Samples")) pass.bind("Samples", places_);
    if (pass.has("Radiances")) pass.bind("Radiances", radiances_);
    if (pass.has("lightTable")) pass.bind("lightTable", table_);
}

}  // namespace penumbra::soft_shadow_volumes
