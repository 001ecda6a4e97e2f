// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "studio/errors.h"
#include "studio/scene/builtin/scenes.h"
#include "studio/scene/lights/nearest_name.h"

namespace penumbra::studio {
namespace {

struct Entry {
    BuiltinInfo info;
    Scene (*make)();
};

constexpr std::array entries{
    Entry{{"primitives", "boxes, balls, cones, cylinders and tori, 10,000 triangles (smoothies, figure 1)"},
          builtin::primitives},
    Entry{{"torus", "a torus over the ground (Kirsch and Doellner, figure 1)"}, builtin::torus},
    Entry{{"sphere", "a sphere over the ground (Kirsch and Doellner, figure 4)"}, builtin::sphere},
    Entry{{"disk-and-sphere", "a disk light, a thin plate and a sphere in its penumbra"},
          builtin::diskAndSphere},
    Entry{{"overlapping-blockers",
           "blockers at very different heights that overlap as seen from the light (Kirsch and Doellner, "
           "figure 5)"},
          builtin::overlappingBlockers},
    Entry{{"two-boxes", "a box over a box over the ground (smoothies, figure 9)"}, builtin::twoBoxes},
    Entry{{"cylinder", "a tall cylinder and a large light (smoothies, figures 7 and 8)"}, builtin::cylinder},
    Entry{{"columns", "a closed room with columns, lit by a bulb inside"}, builtin::columns},
    Entry{{"moving", "rigid parts and a waving cloth, a loop of 4 s"}, builtin::moving},
    Entry{{"textured-window", "a light with a picture: a stained-glass window"}, builtin::texturedWindow},
    Entry{{"many-lights", "five coloured lights of all four shapes"}, builtin::manyLights},
    Entry{{"office", "a furnished room, its panel flush with the ceiling"}, builtin::office},
    Entry{{"sunny-window", "a room with a window, and the sun through it"}, builtin::sunnyWindow},
    Entry{{"lamp-shade", "a bulb in an open shade, a wall behind it"}, builtin::lampShade},
    Entry{{"half-plane",
           "closed form: 1 x 1 m light in y = 4 over x = z = 0, blocker x < 0 in y = 2, receiver y = 0"},
          builtin::halfPlane},
    Entry{
        {"strip",
         "closed form: 1 x 1 m light in y = 4 over x = z = 0, blocker |x| < 0.2 m in y = 2, receiver y = 0"},
        builtin::strip},
    Entry{{"disk-over-ground",
           "closed form: disk light of radius 0.5 m in y = 4, disk of radius 0.4 m in y = 2, receiver y = 0"},
          builtin::diskOverGround},
};

constexpr auto infos = [] {
    std::array<BuiltinInfo, entries.size()> all;
    std::ranges::transform(entries, all.begin(), &Entry::info);
    return all;
}();

}  // namespace

std::span<const BuiltinInfo> builtinScenes() {
    return infos;
}

bool isBuiltin(std::string_view name) {
    return std::ranges::find(infos, name, &BuiltinInfo::name) != infos.end();
}

Scene makeBuiltin(std::string_view name) {
    const auto found = std::ranges::find(entries, name, [](const Entry& entry) { return entry.info.name; });
    if (found != entries.end()) return found->make();

    std::array<std::string_view, infos.size()> names;
    std::ranges::transform(infos, names.begin(), &BuiltinInfo::name);
    throw InputError(fmt::format("there is no built-in scene '{}'{}", name, didYouMean(name, names)));
}

}  // namespace penumbra::studio
