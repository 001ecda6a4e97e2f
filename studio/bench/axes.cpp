// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/axes.h"

#include <algorithm>
#include <array>

#include "studio/bench/bench_scene.h"

namespace penumbra::studio {
namespace {

/// A frame that takes longer ends an axis for its technique: in a short bench, and in a full one.
constexpr double shortLimit_ms = 1.5e3, fullLimit_ms = 30e3;

struct Situation {
    BenchSceneSpec scene;
    PictureSize size{480, 270};
    int mapSize_px = 0;  ///< 0: each technique's own
};

Situation situationAt(const AxisInfo& axis, int value) {
    Situation situation;
    if (axis.name == "triangles") situation.scene.triangles = value;
    if (axis.name == "lights") situation.scene.lights = value;
    if (axis.name == "light-size") situation.scene.lightSize_m = 0.001f * float(value);
    if (axis.name == "frame") situation.size = {value, value * 9 / 16};
    if (axis.name == "map") situation.mapSize_px = value;
    return situation;
}

}  // namespace

std::span<const AxisInfo> benchAxes() {
    static const std::array axes = {
        AxisInfo{"map", "shadow map size (texels)", {256, 512, 1024, 2048, 4096}, {512, 1024, 2048}},
        AxisInfo{"frame", "frame width (pixels, 16:9)", {320, 640, 960, 1280, 1920}, {320, 640, 1280}},
        AxisInfo{"triangles",
                 "triangles of the casters",
                 {1'000, 4'000, 16'000, 64'000, 256'000, 1'000'000, 2'100'000},
                 {1'000, 16'000, 256'000, 2'100'000}},
        AxisInfo{"lights", "lights", {1, 2, 4, 8, 16, 32}, {1, 4, 32}},
        AxisInfo{
            "light-size", "side of the light (mm)", {50, 100, 250, 500, 1000, 2000, 4000}, {100, 500, 2000}}};
    return axes;
}

AxisResult runAxis(Workbench& workbench, const AxisInfo& axis, std::span<const Contender> contenders,
                   const AxisOptions& options) {
    AxisResult result{.axis = axis, .points = {}, .leftOut = {}};
    const std::vector<int>& values = options.full ? axis.values : axis.small;
    std::vector<Contender> left(contenders.begin(), contenders.end());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Situation situation = situationAt(axis, values[i]);
        const Scene scene = makeBenchScene(situation.scene);
        const SceneMoment moment = scene.at(0);
        workbench.open(scene);
        std::vector<Contender> now = left;
        if (situation.mapSize_px > 0) {
            for (Contender& contender : now)
                contender.settings.emplace_back("map_size", std::to_string(situation.mapSize_px));
        }
        std::vector<ContestResult> measured =
            runContest(workbench, moment, moment.cameras.front(), situation.size, now,
                       {.rounds = options.full ? 9 : 3,
                        .warmUpRounds = options.full ? 2 : 1,
                        .patience_ms = options.full ? 120e3 : 4e3,
                        .progress = [&](double share) {
                            options.progress((double(i) + share) / double(values.size()));
                        }});
        // `hard` stays to the end: it is the yardstick.
        const double limit_ms = options.full ? fullLimit_ms : shortLimit_ms;
        for (const ContestResult& one : measured) {
            const std::string& label = one.contender.label;
            if (label == left.front().label || (one.missing.empty() && one.cost_ms.median <= limit_ms))
                continue;
            if (one.missing.empty() && i + 1 < values.size()) result.leftOut.emplace_back(label, values[i]);
            std::erase_if(left, [&](const Contender& contender) { return contender.label == label; });
        }
        std::erase_if(measured, [](const ContestResult& one) { return !one.missing.empty(); });
        result.points.push_back({.value = values[i], .results = std::move(measured)});
    }
    return result;
}

}  // namespace penumbra::studio
