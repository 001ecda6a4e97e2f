// SPDX-License-Identifier: Apache-2.0
// A luminaire's file, read as LM-63 and as EULUMDAT: candela that are numbers, of which a light can be made,
// or an InputError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "studio/errors.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/scene/profiles/profile_file.h"

namespace {

using namespace penumbra::studio;

void check(const LightProfile& profile) {
    const CandelaGrid& grid = profile.grid;
    if (!std::isfinite(grid.largest()) || !(grid.integral() >= 0)) std::abort();
    for (int gamma = 0; gamma <= 180; gamma += 15) {
        for (int c = 0; c < 360; c += 15) {
            const double candela = grid.at(directionOf(gamma, c));
            if (!(candela >= 0 && candela <= 1.0001 * double(grid.largest()))) std::abort();
        }
    }
    Light light;
    makeLuminaire(std::make_shared<const LightProfile>(profile), 0, glm::vec3(1), light);
    for (const float size :
         {light.shape.width_m, light.shape.height_m, light.shape.length_m, light.shape.radius_m})
        if (!(size >= 0 && std::isfinite(size))) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto noFile = [](const std::string&, int) -> std::string { throw InputError("no such file"); };
    try {
        check(parseLm63(text, "lamp.ies", noFile));
    } catch (const InputError&) {
    }
    try {
        check(parseEulumdat(text, "lamp.ldt"));
    } catch (const InputError&) {
    }
    return 0;
}
