// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/light_size.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio {
namespace {

class WithSizes : public Scene::Motion {
  public:
    WithSizes(std::shared_ptr<const Scene::Motion> inner, const LightSizes& sizes)
        : inner_(std::move(inner)), sizes_(sizes) {}

    SceneMoment at(const Scene& scene, double time_s) const override {
        SceneMoment moment = inner_->at(scene, time_s);
        for (Light& light : moment.lights) {
            if (effectOf(light.shape) > 0) continue;
            const LightShape shape = light.shape.shape;
            if (shape == LightShape::distant && sizes_.angle_rad > 0)
                setSize(light, &AreaLight::angle_rad, sizes_.angle_rad);
            else if ((shape == LightShape::sphere || shape == LightShape::disk) && sizes_.radius_m > 0)
                setSize(light, &AreaLight::radius_m, sizes_.radius_m);
        }
        return moment;
    }

  private:
    std::shared_ptr<const Scene::Motion> inner_;
    LightSizes sizes_;
};

}  // namespace

float effectOf(const AreaLight& shape) {
    constexpr float pi = std::numbers::pi_v<float>;
    switch (shape.shape) {
        case LightShape::rect:
            return shape.width_m * shape.height_m;
        case LightShape::disk:
        case LightShape::sphere:
            return pi * shape.radius_m * shape.radius_m;
        case LightShape::cylinder:
            return 2 * shape.radius_m * shape.length_m;
        case LightShape::distant: {
            const float sine = std::sin(0.5f * shape.angle_rad);
            return pi * sine * sine;
        }
    }
    return 0;
}

void setEmissionUnit(Light& light) {
    const bool hasSize = effectOf(light.shape) > 0;
    light.emission.unit = hasSize                                    ? Emission::Unit::nits
                          : light.shape.shape == LightShape::distant ? Emission::Unit::lux
                                                                     : Emission::Unit::candela;
}

void setSize(Light& light, float AreaLight::*size, float value) {
    if (light.profile && light.profile->isLuminaire) return;  // its size is its file's
    light.sun.reset();
    const float before = effectOf(light.shape);
    light.shape.*size = value;
    const float now = effectOf(light.shape);
    if ((before > 0) != (now > 0)) light.emission.value *= now > 0 ? 1 / now : before;
    setEmissionUnit(light);
}

std::shared_ptr<const Scene::Motion> withSizes(std::shared_ptr<const Scene::Motion> inner,
                                               const LightSizes& sizes) {
    if (sizes.radius_m <= 0 && sizes.angle_rad <= 0) return inner;
    return std::make_shared<WithSizes>(std::move(inner), sizes);
}

std::optional<std::string> sizelessHint(const SceneMoment& moment) {
    std::vector<std::string> names;
    bool isLamp = false, isSun = false;
    for (const Light& light : moment.lights) {
        if (effectOf(light.shape) > 0) continue;
        names.push_back(fmt::format("'{}'", light.name));
        (light.shape.shape == LightShape::distant ? isSun : isLamp) = true;
    }
    if (names.empty()) return std::nullopt;
    constexpr std::size_t mostNames = 3;
    const std::size_t others = names.size() > mostNames ? names.size() - mostNames : 0;
    names.resize(names.size() - others);
    return fmt::format("{}{} {} no size, so that shadows are hard: {}{}{}", fmt::join(names, ", "),
                       others > 0 ? fmt::format(" and {} more", others) : "",
                       names.size() + others == 1 ? "has" : "have",
                       isLamp ? "--light-radius 0.05 makes lamps of 10 cm" : "", isLamp && isSun ? ", " : "",
                       isSun ? "--sun-angle 0.53 makes distant lights a sun" : "");
}

}  // namespace penumbra::studio
